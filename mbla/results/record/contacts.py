"""Columns of interfaces and contact points: where they are, what they carry, how bodies move against each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode, relative_motion
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.thrust import Thrust, point_friction_use
from mbla.results.record.quantity import Quantity, UnitKind, flag, real, text, whole
from mbla.results.record.scene import FIGURES, FIGURES_TOLD, Column, Scene, Values, as_text, column, figures
from mbla.solution.solution import ContactMode

EVERYWHERE = "table interfaces thrust hinges"
"""what every file with interfaces has"""
FORCES = "table interfaces thrust"
"""what meshes with forces have"""


def _of_interfaces(quantity: Quantity) -> Quantity:
    return replace(quantity, place="interfaces")


def _names(scene: Scene) -> Values:
    bodies = range(len(scene.model.blocks) + len(scene.model.grounds))
    return as_text([scene.model.body_name(body) for body in bodies])[scene.contacts.bodies]


def _thrust(
    name: str, words: str, unit: UnitKind, of: Callable[[Thrust], Values], dims: str = "interface", files: str = FORCES
) -> Column:
    """What follows from the forces."""
    values = lambda scene: None if scene.thrust is None else of(scene.thrust)  # noqa: E731
    return column(_of_interfaces(real(name, words, unit, dims)), values, files)


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
        _of_interfaces(whole("interface", "number of the interface, from 0", "interface")),
        lambda scene: np.arange(len(scene.contacts)),
        EVERYWHERE,
    ),
    column("contacts/bodies", lambda scene: scene.contacts.bodies, EVERYWHERE),
    column(_of_interfaces(text("body_names", "names of bodies a and b", "interface pair")), _names),
    column(
        "contacts/joints",
        lambda scene: scene.contacts.joints,
        "table interfaces",
        lambda scene: scene.contacts.joint_names,
    ),
    column(
        _of_interfaces(whole("point_count", "its contact points", "interface")),
        lambda scene: np.diff(scene.contacts.point_start),
    ),
    column("contacts/areas", lambda scene: scene.contacts.areas, "table interfaces"),
    column("contacts/centroids", lambda scene: scene.contacts.centroids),
    column("contacts/normals", lambda scene: scene.contacts.normals, "table interfaces"),
    column("contacts/gaps", lambda scene: scene.contacts.gaps, "table interfaces"),
    column(
        _of_interfaces(replace(FIGURES_TOLD, dims=("interface",))),
        figures(lambda scene: len(scene.contacts)),
        EVERYWHERE,
        lambda _: FIGURES,
    ),
    _thrust("resultant_forces", "resultant on body b", "force", lambda t: t.forces, "interface axis"),
    column(
        _of_interfaces(
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
        _of_interfaces(
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
        _of_interfaces(flag("slides", "1 where closed points slide, whatever the mode", "interface")),
        lambda collapse: collapse.interfaces.slides,
        "interfaces",
    ),
    _collapse(
        _of_interfaces(flag("crushes", "1 where closed points crush, whatever the mode", "interface")),
        lambda collapse: collapse.interfaces.crushes,
        "interfaces",
    ),
    _collapse("cases/*/interfaces/translations", lambda collapse: collapse.interfaces.translation),
    _collapse("cases/*/interfaces/rotations", lambda collapse: collapse.interfaces.rotation),
    _collapse("cases/*/interfaces/work", lambda collapse: collapse.work.dissipated, "table interfaces"),
    _collapse("cases/*/interfaces/hinge_points", lambda collapse: collapse.interfaces.hinge_points),
    _collapse("cases/*/interfaces/hinge_directions", lambda collapse: collapse.interfaces.hinge_directions),
    column(
        _of_interfaces(
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
        _of_interfaces(
            real("certificate_rotations", "no equilibrium: angular velocity in it", "per_length", "interface axis")
        ),
        _certificate(1),
    ),
)


BOTH = "table contacts"
"""the table and the mesh of contact points"""


def _of_points(quantity: Quantity) -> Quantity:
    return replace(quantity, place="points")


def _forces(of: Callable[[Scene, FloatArray], Values]) -> Callable[[Scene], Values | None]:
    """From the contact forces, (n_points, 3) N, T1, T2."""
    return lambda scene: None if scene.forces is None else of(scene, scene.forces)


def _velocities(of: Callable[[Scene, FloatArray], Values]) -> Callable[[Scene], Values | None]:
    """From the contact velocities, (n_points, 3)."""
    return lambda scene: None if scene.mechanics is None else of(scene, scene.mechanics.contact_velocities)


def _use(scene: Scene) -> Values | None:
    mechanics = scene.mechanics
    if mechanics is None or mechanics.resultants is not None:
        return None
    return point_friction_use(scene.model, scene.contacts, mechanics.contact_forces)


POINT_COLUMNS: tuple[Column, ...] = (
    column(
        _of_points(whole("point", "number of the contact point, from 0", "point")),
        lambda scene: np.arange(len(scene.contacts.points)),
    ),
    column(
        _of_points(whole("interface", "number of its interface", "point")),
        lambda scene: scene.contacts.interface_of_point,
        BOTH,
    ),
    column(
        _of_points(whole("bodies", "bodies a and b of the interface", "point pair")),
        lambda scene: scene.contacts.bodies[scene.contacts.interface_of_point],
        "contacts",
    ),
    column("contacts/points", lambda scene: scene.contacts.points),
    column("contacts/frames", lambda scene: scene.contacts.frames),
    column("contacts/point_areas", lambda scene: scene.contacts.point_areas),
    column(
        _of_points(replace(FIGURES_TOLD, dims=("point",))),
        figures(lambda scene: len(scene.contacts.points)),
        BOTH,
        lambda _: FIGURES,
    ),
    column("cases/*/contact_forces", _forces(lambda scene, forces: forces)),
    column(
        _of_points(real("global_forces", "contact force on body b in the axes of the deck", "force", "point axis")),
        _forces(lambda scene, forces: global_forces(scene.contacts, forces)),
        BOTH,
    ),
    column(
        _of_points(real("normal_forces", "compression positive", "force", "point")),
        _forces(lambda scene, forces: forces[:, 0]),
        "contacts",
    ),
    column(
        _of_points(real("shear_forces", "size of the force along the interface", "force", "point")),
        _forces(lambda scene, forces: np.hypot(forces[:, 1], forces[:, 2])),
        "contacts",
    ),
    column(
        _of_points(
            real(
                "friction_use",
                "shear over what friction and cohesion allow; not with contact_model convex",
                "1",
                "point",
            )
        ),
        _use,
        BOTH,
    ),
    column(
        "cases/*/modes",
        lambda scene: None if scene.mechanics is None else scene.mechanics.modes,
        BOTH,
        lambda _: [mode.name.lower() for mode in ContactMode],
    ),
    column("cases/*/contact_velocities", _velocities(lambda scene, velocities: velocities)),
    column(
        _of_points(
            real("global_velocities", "velocity of b relative to a in the deck's axes", "velocity", "point axis")
        ),
        _velocities(lambda scene, velocities: global_forces(scene.contacts, velocities)),
        "contacts",
    ),
    column(
        _of_points(real("opening", "normal part of the contact velocity, opening positive", "velocity", "point")),
        _velocities(lambda scene, velocities: velocities[:, 0]),
        "contacts",
    ),
    column(
        _of_points(real("sliding", "size of its part along the interface", "velocity", "point")),
        _velocities(lambda scene, velocities: np.hypot(velocities[:, 1], velocities[:, 2])),
        "contacts",
    ),
)
