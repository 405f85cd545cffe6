"""Contact points: where they are, their forces and velocities."""

from __future__ import annotations

from collections.abc import Callable, Sized

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.mechanics import global_forces as in_axes_of_deck
from mbla.results.collapse.thrust import point_friction_use
from mbla.results.quantities.answers import OWN
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import FIGURES, Scene
from mbla.solution.solution import ContactMode, Mechanics

POINTS = Group[Scene](lambda scene: scene, table="points")
"""under a load case"""
_CONTACTS = Group[Contacts](lambda scene: scene.contacts, file="contacts", table="points")
_MECHANICS = Group[Mechanics](lambda scene: scene.mechanics, table="points")


def figure_names(_: Scene) -> tuple[str, ...]:
    """What numbers of ``figures`` stand for."""
    return FIGURES


FIGURES_WORDS = (
    "what forces and velocities are: 1 result, 2 best_iterate: no result, 3 lock: balance the live load, 0 none"
)


def declare_figures(group: Group[Scene], files: str, dims: str, rows: Callable[[Scene], Sized]) -> None:
    """What forces and velocities are, in every row."""

    @group.quantity(files, words=FIGURES_WORDS, dims=dims, names=figure_names)
    def figures(scene: Scene) -> IntArray:
        """The same in all of them."""
        return np.full(len(rows(scene)), FIGURES.index(scene.figures))


def mode_names(_: Scene) -> list[str]:
    """What numbers of modes stand for."""
    return [mode.name.lower() for mode in ContactMode]


@POINTS.quantity("table", dims="point")
def point(scene: Scene) -> IntArray:
    """Number of the contact point, from 0."""
    return np.arange(len(scene.contacts.points))


@POINTS.quantity("table contacts", dims="point")
def interface(scene: Scene) -> IntArray:
    """Number of its interface."""
    return scene.contacts.interface_of_point


@POINTS.quantity("contacts", dims="point pair")
def bodies(scene: Scene) -> IntArray:
    """Bodies a and b of the interface."""
    return scene.contacts.bodies[scene.contacts.interface_of_point]


_CONTACTS.fields(
    Contacts,
    points=Field("contact points", "point axis", unit="length", files="table"),
    frames=Field("normal, tangent 1, tangent 2 as rows", "point direction axis", files="table"),
    point_areas=Field("share of the area of the interface", "point", unit="area", files="table"),
)


declare_figures(POINTS, "table contacts", "point", lambda scene: scene.contacts.points)


@POINTS.quantity("table", like=OWN["contact_forces"])
def contact_forces(scene: Scene) -> FloatArray | None:
    """Forces of the result, of the best iterate, or of the lock."""
    return scene.forces


@POINTS.quantity("table contacts", dims="point axis", unit="force")
def global_forces(scene: Scene) -> FloatArray | None:
    """Contact force on body b in the axes of the deck."""
    return None if scene.forces is None else in_axes_of_deck(scene.contacts, scene.forces)


@POINTS.quantity("contacts", dims="point", unit="force")
def normal_forces(scene: Scene) -> FloatArray | None:
    """Compression positive."""
    return None if scene.forces is None else scene.forces[:, 0]


@POINTS.quantity("contacts", dims="point", unit="force")
def shear_forces(scene: Scene) -> FloatArray | None:
    """Size of the force along the interface."""
    return None if scene.forces is None else np.hypot(scene.forces[:, 1], scene.forces[:, 2])


@POINTS.quantity("table contacts", dims="point")
def friction_use(scene: Scene) -> FloatArray | None:
    """Shear over what friction and cohesion allow; not with contact_model convex."""
    mechanics = scene.mechanics
    if mechanics is None or mechanics.resultants is not None:
        return None
    return point_friction_use(scene.model, scene.contacts, mechanics.contact_forces)


@_MECHANICS.quantity("table contacts", like=OWN["modes"], names=mode_names)
def modes(mechanics: Mechanics) -> IntArray:
    """Of the result or the best iterate."""
    return mechanics.modes


@_MECHANICS.quantity("table", like=OWN["contact_velocities"])
def contact_velocities(mechanics: Mechanics) -> FloatArray:
    """Of the result or the best iterate."""
    return mechanics.contact_velocities


@POINTS.quantity("contacts", dims="point axis", unit="velocity")
def global_velocities(scene: Scene) -> FloatArray | None:
    """Velocity of b relative to a in the deck's axes."""
    mechanics = scene.mechanics
    return None if mechanics is None else in_axes_of_deck(scene.contacts, mechanics.contact_velocities)


@_MECHANICS.quantity("contacts", dims="point", unit="velocity")
def opening(mechanics: Mechanics) -> FloatArray:
    """Normal part of the contact velocity, opening positive."""
    return mechanics.contact_velocities[:, 0]


@_MECHANICS.quantity("contacts", dims="point", unit="velocity")
def sliding(mechanics: Mechanics) -> FloatArray:
    """Size of its part along the interface."""
    return np.hypot(mechanics.contact_velocities[:, 1], mechanics.contact_velocities[:, 2])
