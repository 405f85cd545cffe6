"""Arches at their least thickness, a little above and a little below.

The least thickness and the load factors beside it come from hinges alone: with much friction a semicircular arch falls
by hinges, and the least kinematic value over all ways to place four of them is its load factor.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
from scipy.optimize import brentq

from tests.analytic.planar import polygon_arch
from tests.extremes.decks import FLOW_RULES, ruled, smoothed
from tests.extremes.outcome import Scene

VOUSSOIRS = 20
"""An even number: there is a joint at the crown."""


@cache
def hinge_factor(thickness: float, voussoirs: int = VOUSSOIRS) -> float:
    """Least load factor of a push along +x over all compatible mechanisms of four hinges; mean radius 1.

    The hinges lie in turn on the inner and the outer edge of four joints; the parts between them turn by ω1, ω2, ω3
    with ω1 (b − a) + ω2 (c − b) + ω3 (d − c) = 0. A hinge on the inner edge opens outside: the next part turns against
    the last one with the clock, and the other way about on the outer edge.
    """
    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    arch = polygon_arch(inner, outer, np.pi, voussoirs)
    rays = np.column_stack([np.sin(arch.angles), np.cos(arch.angles)])
    joints = np.array(list(combinations(range(voussoirs + 1), 4)))
    count, best = np.arange(voussoirs), np.inf
    for radii in ((inner, outer, inner, outer), (outer, inner, outer, inner)):
        hinges = np.stack([radius * rays[joints[:, k]] for k, radius in enumerate(radii)])
        legs = np.diff(hinges, axis=0)
        det = legs[1, :, 0] * legs[2, :, 1] - legs[1, :, 1] * legs[2, :, 0]
        turns = np.stack(
            [
                np.zeros_like(det),
                det,
                -(legs[0, :, 0] * legs[2, :, 1] - legs[0, :, 1] * legs[2, :, 0]),
                -(legs[1, :, 0] * legs[0, :, 1] - legs[1, :, 1] * legs[0, :, 0]),
                np.zeros_like(det),
            ]
        )
        opening = np.diff(turns, axis=0) * np.where(np.array(radii) == inner, -1.0, 1.0)[:, None]
        speed, power = np.zeros((len(joints), 2)), np.zeros((2, len(joints)))
        for part in range(3):
            turn = turns[part + 1][:, None]
            within = (count >= joints[:, [part]]) & (count < joints[:, [part + 1]])
            load, moment = within @ arch.weights, within @ (arch.weights[:, None] * arch.points)
            arms = moment - load[:, None] * hinges[part]
            moved = load[:, None] * speed + turn * np.column_stack([-arms[:, 1], arms[:, 0]])
            power += np.stack([moved[:, 0], -moved[:, 1]])
            leg = legs[part]
            speed = speed + turn * np.column_stack([-leg[:, 1], leg[:, 0]])
        for sign in (1.0, -1.0):
            compatible = (sign * opening > 0).all(axis=0) & (sign * power[0] > 1e-9 * np.abs(det))
            if compatible.any():
                best = min(best, float((-power[1] / power[0])[compatible].min()))
    return best


@cache
def least_thickness(voussoirs: int = VOUSSOIRS) -> float:
    """Where the load factor of the push is zero, mean radius 1."""
    return float(brentq(lambda t: hinge_factor(t, voussoirs), 0.08, 0.3, xtol=1e-16, rtol=1e-15))


DECK = """\
mbla: 1
parameters: {n: 20, t: 0.15, mu: 0.65}
materials: {stone: {density: 2000}}
joints: {dry: {friction: "=mu"}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: "=2 - t", thickness: "=t", width: 0.3,
           voussoirs: "=n", springers: ground}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
OFFSETS = (1e-4, 1e-6, 1e-8, -1e-8, -1e-6, -1e-4)
FALLS, UNDECIDED = "no_equilibrium", "not_verified"
NEAR = 1e-7
"""Within this of the least thickness the program may say that it cannot tell."""


def _arch(offset: float, voussoirs: int, flow_rule: str) -> Scene:
    """An arch thicker than the least by ``offset`` of the mean radius, thinner where that is negative."""
    thickness = least_thickness(voussoirs) + offset
    tell = (UNDECIDED,) if abs(offset) <= NEAR else ()
    expected = hinge_factor(thickness, voussoirs) if offset > 0 else None
    return Scene(
        name=f"{voussoirs} voussoirs, {offset:+.0e}, {flow_rule}",
        family="arches at the least thickness",
        deck=DECK,
        overrides=(
            f"parameters.n={voussoirs}",
            f"parameters.t={thickness!r}",
            ruled(flow_rule),
        ),
        expected=expected,
        tolerance=smoothed(max(1e-6, 1e-10 / offset), expected, flow_rule) if offset > 0 else 0.0,
        diagnosis=tell if offset > 0 else (FALLS, *tell),
        long=voussoirs != VOUSSOIRS or abs(offset) > 1e-6 or (offset == 1e-8 and flow_rule != "associative"),
    )


SCENES = tuple(
    _arch(offset, voussoirs, rule) for voussoirs in (10, 20, 40) for offset in OFFSETS for rule in FLOW_RULES
)
