"""Modes of vibration about the state at rest, and that state: how stiff its joints are, and which of them press."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.solution.modes.modes import Modes


def _found(scene: Scene) -> Modes | None:
    """Where there are any."""
    found = scene.solved.solution.further.modes
    return found if len(found) else None


MODES = Group[Modes](_found, file="cases/*/vibration", table="modes", part="modes")
TABLE = Group[Modes](_found, table="modes")


@TABLE.quantity("table", dims="mode")
def mode(modes: Modes) -> IntArray:
    """Number of the mode, from 1, by falling period."""
    return np.arange(1, len(modes) + 1)


MODES.fields(
    Modes,
    periods=Field("period", "mode", unit="time", files="table"),
)


@TABLE.quantity("table", dims="mode", unit="frequency")
def frequencies(modes: Modes) -> FloatArray:
    """Oscillations in a second."""
    return modes.frequencies


MODES.fields(
    Modes,
    masses=Field(
        "mass that takes part along each axis, over the whole that moves along it", "mode axis", files="table"
    ),
)


@TABLE.quantity("table", dims="mode axis")
def masses_so_far(modes: Modes) -> FloatArray:
    """The same of this mode and all before it together."""
    return modes.masses.cumsum(axis=0)


MODES.fields(
    Modes,
    shapes=Field(
        "displacement of the centroid of each block and its rotation, so that no corner goes further than 1",
        "mode block component",
        unit="motion",
    ),
    moving=Field("mass that moves along each axis", "axis", unit="mass"),
    default=Field("normal stiffness of joints for which the deck gives none", unit="bedding", attribute="default"),
    stiffness=Field("of each interface across and along, force per volume", "interface pair", unit="bedding"),
    pressed=Field("share of each interface that presses at rest", "interface"),
    settlement=Field(
        "displacements and rotations of the blocks at rest, by which joints give under the dead load",
        "block component",
        unit="displacement",
    ),
    loose=Field("1 for blocks that joints do not hold", "block", unverified="modes"),
    residual=Field("greatest force that a mode leaves without balance, over its inertia"),
    verified=Field("1 where modes, and the state at rest, are verified"),
)


@MODES.quantity(unit="length")
def sag(modes: Modes) -> float:
    """Greatest displacement of a centroid at rest."""
    return modes.sag
