"""A mechanism as an object of the JSON record: modes, rigid parts, lines between them, where the power goes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import cache, partial
from typing import Any

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.failure import Failure, failure_of, mechanism_class, moving_joints
from mbla.results.collapse.force_freedom import Enough, ForceFreedom, enough_of, force_freedom
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.mechanics import dissipated_by_joint, loads_by_group
from mbla.results.collapse.rigid_parts import PartMotion, moving_share, reach
from mbla.results.records.numbers import number, numbers
from mbla.solution.solution import ContactMode, Mechanics

POINT_MODES = {
    mode.name.lower(): mode for mode in (ContactMode.OPEN, ContactMode.SLIDE, ContactMode.CRUSH, ContactMode.STICK)
}

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


class OnDemand(Mapping[str, Any]):
    """Keys are known, each value is worked out at its first use and kept."""

    def __init__(self, makers: Mapping[str, Callable[[], Any]]) -> None:
        self._makers = dict(makers)
        self._found: dict[str, Any] = {}

    def __getitem__(self, key: str) -> Any:
        """The value; KeyError where there is no such key."""
        if key not in self._found:
            self._found[key] = self._makers[key]()
        return self._found[key]

    def __contains__(self, key: object) -> bool:
        return key in self._makers

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


def mechanism_json(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, dimension: int
) -> dict[str, Any]:
    """Contact points by mode, interfaces by mode, parts and work; ``dimension``: in which the case was solved."""
    return dict(mechanism_on_demand(model, contacts, load_case, mechanics, dimension))


def mechanism_on_demand(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, dimension: int
) -> OnDemand:
    """The same, each value found when it is asked for: all of them take as long as to verify a small model."""

    @cache
    def collapse() -> Collapse:
        return collapse_of(model, contacts, load_case, mechanics)

    @cache
    def failure() -> Failure:
        return failure_of(model, contacts, collapse(), mechanics)

    @cache
    def failure_keys() -> dict[str, Any]:
        return failure_json(model, failure())

    @cache
    def points() -> dict[str, int]:
        return _points(mechanics)

    @cache
    def share() -> float:
        return moving_share(model, collapse().parts)

    return OnDemand(
        {"class": lambda: mechanism_class(moving_joints(model, contacts, collapse(), mechanics)).value}
        | {mode: partial(lambda mode: points()[mode], mode) for mode in POINT_MODES}
        | {
            "interfaces": lambda: {mode.name.lower(): collapse().interfaces.count(mode) for mode in InterfaceMode},
            "hinges": lambda: collapse().interfaces.count(InterfaceMode.HINGE),
            "reach": lambda: reach(share()),
            "moving_blocks": lambda: int(np.sum(~model.fixed & (collapse().parts > 0))),
            "moving_weight_share": lambda: number(share()),
            "moving_parts": lambda: len(collapse().motions),
            "parts": lambda: [part_json(model, motion) for motion in collapse().motions[:MOST]],
        }
        | {key: partial(lambda key: failure_keys()[key], key) for key in FAILURE_KEYS}
        | {
            "force_freedom": lambda: _force_freedom(force_freedom(model, contacts, mechanics, dimension)),
            "enough": lambda: _enough(enough_of(model, contacts, collapse().parts)),
            "work": lambda: _work(model, contacts, load_case, mechanics, collapse()),
        }
    )


def _points(mechanics: Mechanics) -> dict[str, int]:
    """Contact points by mode."""
    return {name: int((mechanics.modes == mode).sum()) for name, mode in POINT_MODES.items()}


def _force_freedom(freedom: ForceFreedom | None) -> dict[str, int] | None:
    """Counts of how unique the forces are: see :mod:`mbla.results.collapse.force_freedom`."""
    return None if freedom is None else {"ways": freedom.degree, "determined": int(freedom.determined.sum())}


def _enough(enough: Enough) -> dict[str, int]:
    """Counts of what is enough for the load factor: see :mod:`mbla.results.collapse.force_freedom`."""
    return {
        "moving_blocks": len(enough.moving),
        "interfaces": len(enough.interfaces),
        "bearing_blocks": len(enough.bearing),
        "left_out_blocks": len(enough.left_out),
    }


def _work(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, collapse: Collapse
) -> dict[str, Any]:
    """Powers, with unit power of the live load: ``live`` is the load factor, ``dead`` negative where weights rise."""
    work = collapse.work
    return {
        "live": number(work.live),
        "dead": number(work.dead),
        "friction": number(float(work.friction.sum())),
        "cohesion": number(float(work.cohesion.sum())),
        "normal": number(float(work.normal.sum())),
        "joints": {name: number(sum(powers)) for name, powers in dissipated_by_joint(contacts, work).items()},
        "groups": {
            name: {"live": number(live), "dead": number(dead)}
            for name, (live, dead) in loads_by_group(model, load_case, mechanics).items()
        },
    }


# --- the failure as it is told -----------------------------------------------------------------------------------


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
