"""Columns of interfaces: where they are, what they carry, and how their bodies move against each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode, relative_motion
from mbla.results.collapse.thrust import Thrust
from mbla.results.record.quantity import Quantity, UnitKind, flag, real, text, whole
from mbla.results.record.scene import FIGURES, FIGURES_TOLD, Column, Scene, Values, as_text, column, figures

EVERYWHERE = "table interfaces thrust hinges"
"""what every file with interfaces has"""
FORCES = "table interfaces thrust"
"""what meshes with forces have"""


def _told(quantity: Quantity) -> Quantity:
    return replace(quantity, place="interfaces")


def _names(scene: Scene) -> Values:
    bodies = range(len(scene.model.blocks) + len(scene.model.grounds))
    return as_text([scene.model.body_name(body) for body in bodies])[scene.contacts.bodies]


def _thrust(
    name: str, words: str, unit: UnitKind, of: Callable[[Thrust], Values], dims: str = "interface", files: str = FORCES
) -> Column:
    """What follows from the forces."""
    values = lambda scene: None if scene.thrust is None else of(scene.thrust)  # noqa: E731
    return column(_told(real(name, words, unit, dims)), values, files)


def _collapse(path: Quantity | str, of: Callable[[Collapse], Values], files: str = "table") -> Column:
    """What follows from the mechanism."""
    return column(path, lambda scene: None if scene.collapse is None else of(scene.collapse), files)


def _certificate(which: int) -> Callable[[Scene], Values | None]:
    def motion(scene: Scene) -> Values | None:
        found = scene.certificate
        return None if found is None else relative_motion(scene.model, scene.contacts, found)[which]

    return motion


INTERFACE_COLUMNS: tuple[Column, ...] = (
    column(
        _told(whole("interface", "number of the interface, from 0", "interface")),
        lambda scene: np.arange(len(scene.contacts)),
        EVERYWHERE,
    ),
    column("contacts/bodies", lambda scene: scene.contacts.bodies, EVERYWHERE),
    column(_told(text("body_names", "names of bodies a and b", "interface pair")), _names),
    column(
        "contacts/joints",
        lambda scene: scene.contacts.joints,
        "table interfaces",
        lambda scene: scene.contacts.joint_names,
    ),
    column(
        _told(whole("point_count", "its contact points", "interface")),
        lambda scene: np.diff(scene.contacts.point_start),
    ),
    column("contacts/areas", lambda scene: scene.contacts.areas, "table interfaces"),
    column("contacts/centroids", lambda scene: scene.contacts.centroids),
    column("contacts/normals", lambda scene: scene.contacts.normals, "table interfaces"),
    column("contacts/gaps", lambda scene: scene.contacts.gaps, "table interfaces"),
    column(
        _told(replace(FIGURES_TOLD, dims=("interface",))),
        figures(lambda scene: len(scene.contacts)),
        EVERYWHERE,
        lambda _: FIGURES,
    ),
    _thrust("resultant_forces", "resultant on body b", "force", lambda t: t.forces, "interface axis"),
    column(
        _told(
            real(
                "resultant_moments", "moment on body b about the centroid of the interface", "moment", "interface axis"
            )
        ),
        lambda scene: scene.moments,
        "table interfaces",
    ),
    _thrust("normal_forces", "normal part of the resultant, compression positive", "force", lambda t: t.normal_forces),
    _thrust("shear_forces", "size of its part along the interface", "force", lambda t: t.shear_forces),
    _thrust("torsions", "moment about the normal through the centroid", "moment", lambda t: t.torsions),
    _thrust(
        "thrust_points",
        "where the resultant acts in the plane of the interface; none where it is not pressed",
        "length",
        lambda t: t.points,
        "interface axis",
        "table interfaces",
    ),
    _thrust("eccentricity", "of it: 0 central, 1 at the edge, more only with tension", "1", lambda t: t.eccentricity),
    _thrust(
        "friction_use",
        "shear over what friction and cohesion allow, without torsion; none where they allow none and none acts",
        "1",
        lambda t: t.friction_use,
    ),
    column(
        _told(
            real("torsion_use", "shear and torsion together over what the interface carries of both", "1", "interface")
        ),
        lambda scene: scene.torsion_use,
        FORCES,
    ),
    column(
        "cases/*/force_ranges",
        lambda scene: None if scene.case is None else scene.case.solution.force_ranges,
    ),
    column(
        "cases/*/interfaces/modes",
        lambda scene: None if scene.interfaces is None else scene.interfaces.modes,
        "table interfaces",
        lambda _: [mode.name.lower() for mode in InterfaceMode],
    ),
    _collapse(
        _told(flag("slides", "1 where closed points slide, whatever the mode", "interface")),
        lambda collapse: collapse.interfaces.slides,
        "interfaces",
    ),
    _collapse(
        _told(flag("crushes", "1 where closed points crush, whatever the mode", "interface")),
        lambda collapse: collapse.interfaces.crushes,
        "interfaces",
    ),
    _collapse("cases/*/interfaces/translations", lambda collapse: collapse.interfaces.translation),
    _collapse("cases/*/interfaces/rotations", lambda collapse: collapse.interfaces.rotation),
    _collapse("cases/*/interfaces/work", lambda collapse: collapse.work.dissipated, "table interfaces"),
    _collapse("cases/*/interfaces/hinge_points", lambda collapse: collapse.interfaces.hinge_points),
    _collapse("cases/*/interfaces/hinge_directions", lambda collapse: collapse.interfaces.hinge_directions),
    column(
        _told(
            real(
                "certificate_translations",
                "no equilibrium: velocity of b relative to a in the motion that proves it",
                "1",
                "interface axis",
            )
        ),
        _certificate(0),
    ),
    column(
        _told(real("certificate_rotations", "no equilibrium: angular velocity in it", "per_length", "interface axis")),
        _certificate(1),
    ),
)
