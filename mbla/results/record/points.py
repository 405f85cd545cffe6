"""Columns of contact points: where they are, their forces and velocities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.thrust import point_friction_use
from mbla.results.record.quantity import Quantity, real, whole
from mbla.results.record.scene import FIGURES, FIGURES_TOLD, Column, Scene, Values, column, figures
from mbla.solution.solution import ContactMode

BOTH = "table contacts"
"""the table and the mesh of contact points"""


def _told(quantity: Quantity) -> Quantity:
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
        _told(whole("point", "number of the contact point, from 0", "point")),
        lambda scene: np.arange(len(scene.contacts.points)),
    ),
    column(
        _told(whole("interface", "number of its interface", "point")),
        lambda scene: scene.contacts.interface_of_point,
        BOTH,
    ),
    column(
        _told(whole("bodies", "bodies a and b of the interface", "point pair")),
        lambda scene: scene.contacts.bodies[scene.contacts.interface_of_point],
        "contacts",
    ),
    column("contacts/points", lambda scene: scene.contacts.points),
    column("contacts/frames", lambda scene: scene.contacts.frames),
    column("contacts/point_areas", lambda scene: scene.contacts.point_areas),
    column(
        _told(replace(FIGURES_TOLD, dims=("point",))),
        figures(lambda scene: len(scene.contacts.points)),
        BOTH,
        lambda _: FIGURES,
    ),
    column("cases/*/contact_forces", _forces(lambda scene, forces: forces)),
    column(
        _told(real("global_forces", "contact force on body b in the axes of the deck", "force", "point axis")),
        _forces(lambda scene, forces: global_forces(scene.contacts, forces)),
        BOTH,
    ),
    column(
        _told(real("normal_forces", "compression positive", "force", "point")),
        _forces(lambda scene, forces: forces[:, 0]),
        "contacts",
    ),
    column(
        _told(real("shear_forces", "size of the force along the interface", "force", "point")),
        _forces(lambda scene, forces: np.hypot(forces[:, 1], forces[:, 2])),
        "contacts",
    ),
    column(
        _told(
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
        _told(real("global_velocities", "velocity of b relative to a in the deck's axes", "velocity", "point axis")),
        _velocities(lambda scene, velocities: global_forces(scene.contacts, velocities)),
        "contacts",
    ),
    column(
        _told(real("opening", "normal part of the contact velocity, opening positive", "velocity", "point")),
        _velocities(lambda scene, velocities: velocities[:, 0]),
        "contacts",
    ),
    column(
        _told(real("sliding", "size of its part along the interface", "velocity", "point")),
        _velocities(lambda scene, velocities: np.hypot(velocities[:, 1], velocities[:, 2])),
        "contacts",
    ),
)
