"""A mechanism as an object of the JSON record: modes, rigid parts, lines between them, where the power goes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, collapse_of, failure_of, mechanism_class
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.force_freedom import ForceFreedom, enough_of, force_freedom
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine
from mbla.results.collapse.mechanics import dissipated_by_joint, loads_by_group
from mbla.results.collapse.rigid_parts import PartMotion, moving_blocks, moving_share, reach
from mbla.results.record.json_values import as_json, number
from mbla.solution.solution import ContactMode, Mechanics

POINT_MODES = (ContactMode.OPEN, ContactMode.SLIDE, ContactMode.CRUSH, ContactMode.STICK)

MOST = 100
"""objects of each kind that the record holds, those that move most"""


class OnDemand(Mapping[str, Any]):
    """Keys are known, each value is worked out where it is asked for."""

    def __init__(self, makers: Mapping[str, Callable[[], Any]]) -> None:
        self._makers = dict(makers)

    def __getitem__(self, key: str) -> Any:
        """The value; KeyError where there is no such key."""
        return self._makers[key]()

    def __contains__(self, key: object) -> bool:
        return key in self._makers

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


def mechanism_json(assembly: Assembly, load_case: LoadCase, mechanics: Mechanics, dimension: int) -> OnDemand:
    """Contact points by mode, interfaces by mode, parts and work; ``dimension``: in which the case was solved.

    A value is found when it is asked for: all of them take as long as to verify a small model.
    """
    model, contacts = assembly.model.of_case(load_case), assembly.contacts

    def collapse() -> Collapse:
        return collapse_of(assembly, load_case, mechanics)

    def failure() -> Any:
        return failure_of(model, contacts, collapse(), mechanics)

    def lines(name: str) -> list[dict[str, Any]]:
        return [line_json(line) for line in getattr(failure(), name)[:MOST]]

    def parts(motions: Sequence[PartMotion]) -> list[dict[str, Any]]:
        return [part_json(model, motion) for motion in motions[:MOST]]

    def share() -> float:
        return moving_share(model, collapse().parts)

    return OnDemand(
        {"class": lambda: mechanism_class(failure()).value}
        | {mode.name.lower(): partial(lambda mode: int((mechanics.modes == mode).sum()), mode) for mode in POINT_MODES}
        | {
            "interfaces": lambda: {mode.name.lower(): collapse().interfaces.count(mode) for mode in InterfaceMode},
            "hinges": lambda: collapse().interfaces.count(InterfaceMode.HINGE),
            "reach": lambda: reach(share()),
            "moving_blocks": lambda: moving_blocks(model, collapse().parts),
            "moving_weight_share": lambda: number(share()),
            "moving_parts": lambda: len(collapse().motions),
            "parts": lambda: parts(collapse().motions),
            "clusters_merged": lambda: number(1.0 - failure().explained),
            "clusters": lambda: parts(failure().motions),
            "hinge_lines": lambda: lines("hinge_lines"),
            "sliding_planes": lambda: lines("sliding_planes"),
            "cracks": lambda: lines("cracks"),
            "main_parts": lambda: parts(failure().motions),
            "main_parts_explain": lambda: number(failure().explained),
            "yield_lines": lambda: lines("yield_lines"),
            "force_freedom": lambda: _force_freedom(force_freedom(assembly.glued(load_case), mechanics, dimension)),
            "enough": lambda: _enough(model, contacts, collapse()),
            "work": lambda: _work(model, contacts, load_case, mechanics, collapse()),
        }
    )


def line_json(found: Any) -> dict[str, Any]:
    """A hinge line, sliding plane, crack or yield line with its length and inclination."""
    record: dict[str, Any] = as_json(found)
    if isinstance(found, (HingeLine, Crack, YieldLine)):
        record["length"] = number(found.length)
    if isinstance(found, YieldLine):
        record["inclination"] = number(found.inclination)
    return record


def part_json(model: Model, part: PartMotion) -> dict[str, Any]:
    """Blocks by group, and how they move: ``turns`` about an axis or ``moves`` along a direction."""
    groups = Counter(model.blocks.groups[block] for block in part.blocks.tolist())
    return {
        "part": part.number,
        "blocks": len(part.blocks),
        "groups": dict(sorted(groups.items())),
        "weight": number(part.weight),
        "motion": "turns" if part.turns else "moves",
        "axis_point": as_json(part.axis_point) if part.turns else None,
        "direction": as_json(part.direction),
    }


def _force_freedom(freedom: ForceFreedom | str) -> dict[str, int] | None:
    """Counts of how unique the forces are: see :mod:`mbla.results.collapse.force_freedom`."""
    if isinstance(freedom, str):
        return None
    return {"ways": freedom.degree, "determined": int(freedom.determined.sum())}


def _enough(model: Model, contacts: Contacts, collapse: Collapse) -> dict[str, int]:
    """Counts of the part relevant to the load factor: see :mod:`mbla.results.collapse.force_freedom`."""
    enough = enough_of(model, contacts, collapse.parts)
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
        **{name: number(float(getattr(work, name).sum())) for name in ("friction", "cohesion", "normal")},
        "joints": {name: number(sum(powers)) for name, powers in dissipated_by_joint(contacts, work).items()},
        "groups": {
            name: {"live": number(live), "dead": number(dead)}
            for name, (live, dead) in loads_by_group(model, load_case, mechanics).items()
        },
    }
