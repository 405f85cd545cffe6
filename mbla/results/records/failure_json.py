"""The failure as it is told, as objects of the JSON record: clusters, main parts, and the lines between them."""

from __future__ import annotations

from collections import Counter
from typing import Any

from mbla.model.model import Model
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.failure import Failure
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import PartMotion
from mbla.results.records.numbers import number, numbers

FAILURE_KEYS = (
    "clusters_merged",
    "clusters",
    "hinge_lines",
    "sliding_planes",
    "cracks",
    "main_parts",
    "main_parts_explain",
    "yield_lines",
)
"""of ``failure_json``"""

MOST = 100
"""objects of each kind that the record holds, those that move most"""


def failure_json(model: Model, failure: Failure) -> dict[str, Any]:
    """Each with the clusters or main parts that meet: that which moves, then against which; 0 is at rest."""
    return {
        "clusters_merged": number(failure.merged),
        "clusters": [part_json(model, motion) for motion in failure.motions[:MOST]],
        "hinge_lines": [_hinge_line(line) for line in failure.hinge_lines[:MOST]],
        "sliding_planes": [_sliding_plane(plane) for plane in failure.sliding_planes[:MOST]],
        "cracks": [_crack(crack) for crack in failure.cracks[:MOST]],
        "main_parts": [part_json(model, motion) for motion in failure.main.motions],
        "main_parts_explain": number(failure.main.explained),
        "yield_lines": [_yield_line(line) for line in failure.yield_lines],
    }


def part_json(model: Model, part: PartMotion) -> dict[str, Any]:
    """Blocks by group, and how they move: ``turns`` about an axis or ``moves`` along a direction."""
    groups = Counter(model.blocks.groups[block] for block in part.blocks.tolist())
    return {
        "part": part.number,
        "blocks": len(part.blocks),
        "groups": dict(sorted(groups.items())),
        "weight": number(part.weight),
        "motion": "turns" if part.turns else "moves",
        "axis_point": numbers(part.axis_point) if part.turns else None,
        "direction": numbers(part.direction),
    }


def _hinge_line(line: HingeLine) -> dict[str, Any]:
    return {
        "clusters": list(line.clusters),
        "interfaces": line.interfaces.tolist(),
        "start": numbers(line.start),
        "end": numbers(line.end),
        "length": number(line.length),
        "direction": numbers(line.direction),
        "rotation": number(line.rotation),
        "share": number(line.share),
        "slides": line.slides,
        "crushes": line.crushes,
        "shear_power_share": number(line.shear),
    }


def _sliding_plane(plane: SlidingPlane) -> dict[str, Any]:
    return {
        "clusters": list(plane.clusters),
        "interfaces": plane.interfaces.tolist(),
        "area": number(plane.area),
        "centroid": numbers(plane.centroid),
        "normal": numbers(plane.normal),
        "direction": numbers(plane.direction),
        "twists": plane.twists,
        "power_share": number(plane.share),
        "shear_power_share": number(plane.shear),
        "share": number(plane.speed),
    }


def _crack(crack: Crack) -> dict[str, Any]:
    return {
        "clusters": list(crack.clusters),
        "interfaces": crack.interfaces.tolist(),
        "start": numbers(crack.start),
        "end": numbers(crack.end),
        "length": number(crack.length),
        "area": number(crack.area),
        "widest": numbers(crack.widest),
        "share": number(crack.share),
    }


def _yield_line(line: YieldLine) -> dict[str, Any]:
    return {
        "parts": list(line.parts),
        "interfaces": line.interfaces.tolist(),
        "points": [numbers(point) for point in line.points],
        "length": number(line.length),
        "inclination": number(line.inclination),
        "off": number(line.off),
    }
