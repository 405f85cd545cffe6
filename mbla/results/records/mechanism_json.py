"""A mechanism as an object of the JSON record: modes, rigid parts, hinges, where the power goes."""

from __future__ import annotations

from functools import cache, partial
from typing import Any

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.collapse.failure import Failure, failure_of, mechanism_class, moving_joints
from mbla.results.collapse.force_freedom import Enough, ForceFreedom, enough_of, force_freedom
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.mechanics import dissipated_by_joint, loads_by_group
from mbla.results.collapse.rigid_parts import moving_share, reach
from mbla.results.records.failure_json import FAILURE_KEYS, failure_json, part_json
from mbla.results.records.numbers import number
from mbla.results.records.on_demand import OnDemand
from mbla.solution.solution import ContactMode, Mechanics

POINT_MODES = {
    mode.name.lower(): mode for mode in (ContactMode.OPEN, ContactMode.SLIDE, ContactMode.CRUSH, ContactMode.STICK)
}

MOST_PARTS = 100
"""parts that the record holds, the heaviest; ``moving_parts`` counts them all, the result file holds them all"""


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
            "parts": lambda: [part_json(model, motion) for motion in collapse().motions[:MOST_PARTS]],
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
