"""The table of contact points: one row for each point and load case."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.thrust import point_friction_use
from mbla.results.tables.case_rows import CaseRows, case_rows
from mbla.results.tables.column import Column, Values, floats, ints, texts, vector
from mbla.results.tables.interface_columns import mode_names
from mbla.results.tables.table import TableKind
from mbla.solution.solution import ContactMode


def _count(rows: CaseRows) -> int:
    return len(rows.contacts.points)


def _forces(rows: CaseRows) -> FloatArray:
    return rows.given(None if rows.mechanics is None else rows.mechanics.contact_forces, _count(rows), 3)


def _velocities(rows: CaseRows) -> FloatArray:
    return rows.given(None if rows.mechanics is None else rows.mechanics.contact_velocities, _count(rows), 3)


def _lock(rows: CaseRows) -> FloatArray:
    return rows.given(rows.lock, _count(rows), 3)


def _use(rows: CaseRows) -> FloatArray:
    mechanics = rows.mechanics
    if mechanics is None or mechanics.resultants is not None:
        return rows.missing(_count(rows))
    return point_friction_use(rows.model, rows.contacts, mechanics.contact_forces)


def _modes(rows: CaseRows) -> Values:
    return mode_names(None if rows.mechanics is None else rows.mechanics.modes, ContactMode, _count(rows))


GEOMETRY: tuple[Column[CaseRows], ...] = (
    texts("case", "load case", lambda rows: rows.same(_count(rows), rows.case.load_case.name)),
    ints("point", "number of the contact point, from 0", lambda rows: np.arange(_count(rows))),
    ints("interface", "number of its interface", lambda rows: rows.contacts.interface_of_point),
    *vector("position", "length", "position", lambda rows: rows.contacts.points),
    *vector("normal", "1", "unit normal from body a to body b", lambda rows: rows.contacts.frames[:, 0]),
    *vector("tangent_1", "1", "first tangent", lambda rows: rows.contacts.frames[:, 1]),
    *vector("tangent_2", "1", "second tangent", lambda rows: rows.contacts.frames[:, 2]),
    floats("area", "area", "share of the area of the interface", lambda rows: rows.contacts.point_areas),
)

CONTACT: tuple[Column[CaseRows], ...] = (
    texts(
        "figures",
        "what forces and velocities of the row are: result; best_iterate where the case has no result; empty: none",
        lambda rows: rows.same(_count(rows), rows.figures),
    ),
    floats("N", "force", "normal force, compression positive", lambda rows: _forces(rows)[:, 0]),
    floats("T1", "force", "force on body b along tangent 1", lambda rows: _forces(rows)[:, 1]),
    floats("T2", "force", "force on body b along tangent 2", lambda rows: _forces(rows)[:, 2]),
    *vector("force", "force", "force on body b", lambda rows: global_forces(rows.contacts, _forces(rows))),
    floats(
        "friction_use",
        "1",
        "shear over what friction and cohesion allow at the point; empty where they allow none and none acts, and "
        "with contact_model convex, whose points only share out the resultants",
        _use,
    ),
    texts("mode", "stick, slide or open", _modes),
    floats("opening", "velocity", "velocity of b from a along the normal", lambda rows: _velocities(rows)[:, 0]),
    floats("slip_1", "velocity", "sliding velocity of b along tangent 1", lambda rows: _velocities(rows)[:, 1]),
    floats("slip_2", "velocity", "sliding velocity of b along tangent 2", lambda rows: _velocities(rows)[:, 2]),
    floats(
        "lock_N",
        "force",
        "unbounded: normal force of those that balance the live load alone",
        lambda rows: _lock(rows)[:, 0],
    ),
    floats("lock_T1", "force", "unbounded: the same along tangent 1", lambda rows: _lock(rows)[:, 1]),
    floats("lock_T2", "force", "unbounded: the same along tangent 2", lambda rows: _lock(rows)[:, 2]),
)

POINTS = TableKind("points", "each contact point, for each load case", (*GEOMETRY, *CONTACT), case_rows)
