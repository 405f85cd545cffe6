"""The table of interfaces: one row for each interface and load case."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.thrust import Thrust
from mbla.results.tables.case_rows import CaseRows, case_rows
from mbla.results.tables.column import Column, Values, as_text, floats, ints, texts, vector
from mbla.results.tables.table import TableKind


def _count(rows: CaseRows) -> int:
    return len(rows.contacts)


def _names(side: int) -> Callable[[CaseRows], Values]:
    def names(rows: CaseRows) -> Values:
        n_bodies = len(rows.model.blocks) + len(rows.model.grounds)
        return as_text([rows.model.body_name(body) for body in range(n_bodies)])[rows.contacts.bodies[:, side]]

    return names


def mode_names(modes: IntArray | None, kinds: type[Any], count: int) -> Values:
    """Modes in lower case; empty where there are none."""
    if modes is None:
        return as_text([""] * count)
    return as_text([mode.name.lower() for mode in kinds])[modes]


def _modes(rows: CaseRows) -> Values:
    modes = None if rows.collapse is None else rows.collapse.interfaces.modes
    return mode_names(modes, InterfaceMode, _count(rows))


def _thrust(of: Callable[[Thrust], FloatArray], *shape: int) -> Callable[[CaseRows], FloatArray]:
    """What thrust says, nan where there are no forces."""
    return lambda rows: rows.given(None if rows.thrust is None else of(rows.thrust), _count(rows), *shape)


def _collapse(of: Callable[[Collapse], FloatArray], *shape: int) -> Callable[[CaseRows], FloatArray]:
    """What the mechanism says, nan where there is none."""
    return lambda rows: rows.given(None if rows.collapse is None else of(rows.collapse), _count(rows), *shape)


def _certificate(which: int) -> Callable[[CaseRows], FloatArray]:
    def motion(rows: CaseRows) -> FloatArray:
        motions = rows.certificate_motion
        return rows.given(None if motions is None else motions[which], _count(rows), 3)

    return motion


def _force_range(end: int) -> Callable[[CaseRows], FloatArray]:
    return lambda rows: rows.given(rows.case.solution.force_ranges, _count(rows), 2)[:, end]


GEOMETRY: tuple[Column[CaseRows], ...] = (
    texts("case", "load case", lambda rows: rows.same(_count(rows), rows.case.load_case.name)),
    ints("interface", "number of the interface, from 0", lambda rows: np.arange(_count(rows))),
    ints(
        "body_a", "body a: number of a block; ground planes follow the blocks", lambda rows: rows.contacts.bodies[:, 0]
    ),
    ints("body_b", "body b", lambda rows: rows.contacts.bodies[:, 1]),
    texts("name_a", "name of body a", _names(0)),
    texts("name_b", "name of body b", _names(1)),
    texts("joint", "joint law", lambda rows: as_text(rows.contacts.joint_names)[rows.contacts.joints]),
    ints("points", "its contact points", lambda rows: np.diff(rows.contacts.point_start)),
    floats("area", "area", "area", lambda rows: rows.contacts.areas),
    *vector("centroid", "length", "centroid", lambda rows: rows.contacts.centroids),
    *vector("normal", "1", "unit normal from a to b", lambda rows: rows.contacts.normals),
    floats("gap", "length", "greatest distance of the faces, negative: overlap", lambda rows: rows.contacts.gaps),
)

FORCES: tuple[Column[CaseRows], ...] = (
    texts(
        "figures",
        "what forces and velocities of the row are: result; best_iterate where the case has no result; empty: none",
        lambda rows: rows.same(_count(rows), rows.figures),
    ),
    *vector("force", "force", "resultant on body b", _thrust(lambda thrust: thrust.forces, 3)),
    *vector("moment", "moment", "its moment about the centroid", lambda rows: rows.moments),
    floats("normal_force", "force", "its normal part, compression positive", _thrust(lambda t: t.normal_forces)),
    floats("shear_force", "force", "size of its part along the interface", _thrust(lambda t: t.shear_forces)),
    floats("torsion", "moment", "moment about the normal through the centroid", _thrust(lambda t: t.torsions)),
    *vector(
        "application",
        "length",
        "point of application in the plane of the interface; empty where it is not pressed",
        _thrust(lambda thrust: thrust.points, 3),
    ),
    floats(
        "eccentricity",
        "1",
        "of that point: 0 central, 1 at the edge, more only with tension",
        _thrust(lambda t: t.eccentricity),
    ),
    floats(
        "friction_use",
        "1",
        "shear force over what friction and cohesion allow; empty where they allow none and none acts",
        _thrust(lambda thrust: thrust.friction_use),
    ),
    floats(
        "torsion_use",
        "1",
        "shear force and torsion together over what the interface carries of both; 1 where it can carry no more",
        lambda rows: rows.torsion_use,
    ),
    floats(
        "normal_force_min", "force", "least normal force at the load factor, where it was asked for", _force_range(0)
    ),
    floats("normal_force_max", "force", "greatest normal force there; inf: unlimited", _force_range(1)),
)

MOTION: tuple[Column[CaseRows], ...] = (
    texts("mode", "stick, slide, open, hinge or twist", _modes),
    *vector(
        "translation",
        "velocity",
        "velocity of b relative to a at the centroid, power of the live load 1",
        _collapse(lambda collapse: collapse.interfaces.translation, 3),
    ),
    *vector(
        "rotation",
        "rotation",
        "angular velocity of b relative to a",
        _collapse(lambda collapse: collapse.interfaces.rotation, 3),
    ),
    floats(
        "work",
        "1",
        "power dissipated, that of the live load being the load factor",
        _collapse(lambda collapse: collapse.work.dissipated),
    ),
    *vector(
        "hinge_point",
        "length",
        "a point on the axis of a hinge; empty for other modes",
        _collapse(lambda collapse: collapse.interfaces.hinge_points, 3),
    ),
    *vector(
        "hinge_direction",
        "1",
        "direction of that axis, by the right hand for b against a",
        _collapse(lambda collapse: collapse.interfaces.hinge_directions, 3),
    ),
    *vector(
        "certificate_translation",
        "1",
        "no equilibrium: velocity of b relative to a in the motion that proves it, to a scale of its own",
        _certificate(0),
    ),
    *vector("certificate_rotation", "per_length", "no equilibrium: angular velocity in that motion", _certificate(1)),
)

INTERFACES = TableKind("interfaces", "each interface, for each load case", (*GEOMETRY, *FORCES, *MOTION), case_rows)
