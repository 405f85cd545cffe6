"""A block on the ground that is shaken by a pulse, as a deck: it rocks."""

from __future__ import annotations

SHAKEN = """\
mbla: 1
title: A block that rocks
materials: {stone: {density: 2600}}
joints: {dry: {friction: 0.7, stiffness: {normal: 1.e10}}}
contacts: {joint: dry}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}
supports: [{ground: {z: 0}}]
load_cases:
  quake:
    time_history:
      motion: {pulse: half_sine, amplitude: "0.5 g", duration: 0.2, direction: x}
      step: 0.005
      duration: 0.6
      record:
        points: {top: {on: {group: block}, at: [0.2, 0.25, 1]}}
        interfaces: {foot: {between: [{group: block}, ground]}}
        every: 0.02
output: {vtu: false}
"""
PEAK = 0.0445
"""of its centroid, m, with that step"""
