"""Columns of tables, JSON and VTU files: what each is and where it is read from a scene, or a row of a list.

They are the rows of ``columns.csv``. A row has the fields of a :class:`Quantity`, or its path alone where the result
file holds it; ``files`` are those that it stands in; ``of`` is a path of attributes of a :class:`Scene`, or one of
``FOUND`` here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.assessment import LIMIT_STATES
from mbla.results.collapse.interface_modes import InterfaceMode, relative_motion
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.rigid_parts import moving_blocks, moving_share
from mbla.results.collapse.thrust import point_friction_use
from mbla.results.outcome import (
    answer_bounds,
    answer_of,
    least_of,
    torsion_of,
    ultimate_displacement,
)
from mbla.results.record.quantity import STORED_BY_PATH, Quantity, quantity_of, rows_of
from mbla.results.record.scene import FIGURES, Scene, Values, as_text
from mbla.results.results import CaseResult
from mbla.solution.solution import ContactMode


@dataclass(frozen=True)
class Column:
    """A quantity and its values in a scene.

    of    : from a scene values of every item, (n_items, ...), None where there are none, integers may be masked;
            from a row of a list its value
    names : what tables say in the place of numbers, one for each
    files : what it stands in: ``table``, ``json``, and VTU files by their kind
    """

    quantity: Quantity
    of: Callable[[Any], Any]
    names: Callable[[Scene], Sequence[str]] | None
    files: tuple[str, ...]


def names_of(texts: tuple[str, ...]) -> list[str]:
    """Names in the order of their numbers, as the result file has them."""
    return sorted(set(texts))


def numbers_of(texts: tuple[str, ...]) -> Values:
    """The number of each item's name."""
    row = {name: number for number, name in enumerate(names_of(texts))}
    return np.array([row[name] for name in texts], dtype=np.int64)


# --- What no attribute of a scene says by itself --------------------------------------------------------------------


def _of_case(of: Callable[[CaseResult], Any]) -> Callable[[Scene, str], Any]:
    return lambda scene, _: None if scene.case is None else of(scene.case)


def _answer(scene: Scene, name: str) -> float | None:
    """The figure that a case asks for, in the column that its question has for it."""
    asked = scene.case is not None and scene.case.load_case.question.column == name
    return answer_of(scene.case) if asked and scene.case is not None else None


def _bounds(scene: Scene, name: str) -> tuple[float, float] | None:
    asked = scene.case is not None and f"{scene.case.load_case.question.column}_bounds" == name
    return answer_bounds(scene.case) if asked and scene.case is not None else None


def _of_parts(of: Callable[..., Any]) -> Callable[[Scene, str], Any]:
    return lambda scene, _: None if scene.collapse is None else of(scene.model, scene.collapse.parts)


def _assessed(scene: Scene, name: str) -> float | None:
    """Capacity over demand at the limit state that a name ends with, the least where it names none."""
    found = None if scene.case is None else scene.case.assessment
    ratios = {} if found is None else {name: each.value for name, each in found.ratios.items()}
    state = name.removeprefix("assessment_ratio").removeprefix("_")
    return ratios.get(state) if state else min(ratios.values(), default=None)


def _modes(scene: Scene, name: str) -> int | None:
    """Interfaces of the mode that ``hinge_interfaces`` names."""
    mode = InterfaceMode[name.removesuffix("_interfaces").upper()]
    return None if scene.interfaces is None else scene.interfaces.count(mode)


def _position(scene: Scene, name: str) -> Values | None:
    """Numbers without the -1 that stand for none."""
    numbers = np.ma.masked_equal(scene.model.blocks.labels.position(name), -1)
    return None if np.ma.getmaskarray(numbers).all() else numbers


def _largest(scene: Scene, name: str) -> Values | None:
    """Largest value over the interfaces of each block, (n_blocks,); nan where none has one."""
    thrust = scene.thrust
    if thrust is None or scene.torsion_use is None:
        return None
    found = scene.torsion_use if name == "largest_torsion_use" else getattr(thrust, name.removeprefix("largest_"))
    largest = np.full(len(scene.model.blocks) + len(scene.model.grounds), -np.inf)
    known = ~np.isnan(found)
    for side in (0, 1):
        np.maximum.at(largest, scene.contacts.bodies[known, side], found[known])
    return np.where(np.isneginf(largest), np.nan, largest)[: len(scene.model.blocks)]


def _members(scene: Scene, _: str) -> Values | None:
    members = scene.model.blocks.labels.members
    return numbers_of(members) if any(members) else None


def _settles(scene: Scene, _: str) -> Values:
    settlement = None if scene.case is None else scene.case.load_case.settlement
    return np.isin(np.arange(len(scene.model.blocks)), [] if settlement is None else settlement.blocks)


def _body_names(scene: Scene, _: str) -> Values:
    bodies = range(len(scene.model.blocks) + len(scene.model.grounds))
    return as_text([scene.model.body_name(body) for body in bodies])[scene.contacts.bodies]


def _certificate(which: int) -> Callable[[Scene, str], Values | None]:
    def motion(scene: Scene, _: str) -> Values | None:
        found = scene.certificate
        return None if found is None else relative_motion(scene.model, scene.contacts, found)[which]

    return motion


def _forces(of: Callable[[Scene, FloatArray], Values]) -> Callable[[Scene, str], Values | None]:
    """From the contact forces, (n_points, 3) N, T1, T2."""
    return lambda scene, _: None if scene.forces is None else of(scene, scene.forces)


def _velocities(of: Callable[[Scene, FloatArray], Values]) -> Callable[[Scene, str], Values | None]:
    """From the contact velocities, (n_points, 3)."""
    return lambda scene, _: None if scene.mechanics is None else of(scene, scene.mechanics.contact_velocities)


def _friction_use(scene: Scene, _: str) -> Values | None:
    mechanics = scene.mechanics
    if mechanics is None or mechanics.resultants is not None:
        return None
    return point_friction_use(scene.model, scene.contacts, mechanics.contact_forces)


FOUND: dict[str, Callable[[Scene, str], Any]] = {
    "least": _of_case(least_of),
    "torsion": _of_case(torsion_of),
    **dict.fromkeys(("angle", "reaction_force", "reaction_moment"), _answer),
    "angle_bounds": _bounds,
    "ultimate_displacement": _of_case(ultimate_displacement),
    **dict.fromkeys(("assessment_ratio", *(f"assessment_ratio_{name}" for name in LIMIT_STATES)), _assessed),
    "figures": lambda scene, _: FIGURES.index(scene.figures),
    "moving_weight_share": _of_parts(moving_share),
    "moving_blocks": _of_parts(moving_blocks),
    "moving_parts": lambda scene, _: None if scene.collapse is None else len(scene.collapse.motions),
    "modes": _modes,
    "programs": _of_case(lambda case: len(case.solution.programs)),
    "iterations": _of_case(lambda case: sum(program.iterations for program in case.solution.programs)),
    "solver_seconds": _of_case(lambda case: float(sum(program.seconds for program in case.solution.programs))),
    "block": lambda scene, _: np.arange(len(scene.model.blocks)),
    "block_name": lambda scene, _: as_text([scene.model.blocks.name(b) for b in range(len(scene.model.blocks))]),
    "groups": lambda scene, _: numbers_of(scene.model.blocks.groups),
    "members": _members,
    "position": _position,
    "guided": lambda scene, _: np.isin(np.arange(len(scene.model.blocks)), scene.model.guides.blocks),
    "settles": _settles,
    "figures_of_blocks": lambda scene, _: np.full(len(scene.model.blocks), FIGURES.index(scene.figures)),
    "parts": lambda scene, _: scene.parts if scene.case is None or scene.moves else None,
    "drawn_displacements": lambda scene, _: scene.motion[:, :3],
    "drawn_rotations": lambda scene, _: scene.motion[:, 3:],
    "largest": _largest,
    "interface": lambda scene, _: np.arange(len(scene.contacts)),
    "body_names": _body_names,
    "point_count": lambda scene, _: np.diff(scene.contacts.point_start),
    "figures_of_interfaces": lambda scene, _: np.full(len(scene.contacts), FIGURES.index(scene.figures)),
    "certificate_translations": _certificate(0),
    "certificate_rotations": _certificate(1),
    "point": lambda scene, _: np.arange(len(scene.contacts.points)),
    "bodies_of_points": lambda scene, _: scene.contacts.bodies[scene.contacts.interface_of_point],
    "figures_of_points": lambda scene, _: np.full(len(scene.contacts.points), FIGURES.index(scene.figures)),
    "global_forces": _forces(lambda scene, forces: global_forces(scene.contacts, forces)),
    "normal_forces": _forces(lambda _, forces: forces[:, 0]),
    "shear_forces": _forces(lambda _, forces: np.hypot(forces[:, 1], forces[:, 2])),
    "friction_use": _friction_use,
    "global_velocities": _velocities(lambda scene, velocities: global_forces(scene.contacts, velocities)),
    "opening": _velocities(lambda _, velocities: velocities[:, 0]),
    "sliding": _velocities(lambda _, velocities: np.hypot(velocities[:, 1], velocities[:, 2])),
}
"""from a scene and the name of the quantity"""


def _lower_names(modes: Iterable[InterfaceMode | ContactMode]) -> list[str]:
    return [mode.name.lower() for mode in modes]


NAMES: dict[tuple[str, str], Callable[[Scene], Sequence[str]]] = {
    **{(table, "figures"): lambda _: FIGURES for table in ("cases", "blocks", "interfaces", "points")},
    ("blocks", "groups"): lambda scene: names_of(scene.model.blocks.groups),
    ("blocks", "members"): lambda scene: names_of(scene.model.blocks.labels.members),
    ("interfaces", "joints"): lambda scene: scene.contacts.joint_names,
    ("interfaces", "modes"): lambda _: _lower_names(InterfaceMode),
    ("points", "modes"): lambda _: _lower_names(ContactMode),
}
"""by table and name, what numbers stand for"""


# --- The tables -----------------------------------------------------------------------------------------------------


def columns_of(table: str) -> tuple[Column, ...]:
    """Of a table, from a scene, or one row of a table that is a list."""
    return tuple(_column(row) for row in rows_of("columns.csv") if row["table"] == table)


def _column(row: dict[str, str]) -> Column:
    stored = "/" in row["quantity"]
    quantity = STORED_BY_PATH[row["quantity"]] if stored else quantity_of(row | {"name": row["quantity"]})
    of, table = FOUND.get(row["of"]) or _at(row["of"]), row["table"]

    def values(scene: Scene) -> Values | None:
        value = of(scene, quantity.name)
        if table != "cases" or value is None:
            found: Values | None = value
            return found
        if quantity.dims == ("sentence",):
            return as_text(value)
        return as_text([value]) if isinstance(value, str) else np.array([value])

    return Column(quantity, values, NAMES.get((table, quantity.name)), tuple(row["files"].split()))


def _at(path: str) -> Callable[[Scene, str], Any]:
    """What a path of attributes leads to, ``thrust.forces``; None where something on it is."""

    def value(scene: Scene, _: str) -> Any:
        found: Any = scene
        for name in path.split("."):
            found = None if found is None else getattr(found, name)
        return found

    return value


CASE_COLUMNS, BLOCK_COLUMNS = columns_of("cases"), columns_of("blocks")
INTERFACE_COLUMNS, POINT_COLUMNS = columns_of("interfaces"), columns_of("points")
