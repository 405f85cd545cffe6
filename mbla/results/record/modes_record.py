"""Modes of vibration in the JSON record."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.quantities.group import Field
from mbla.results.quantities.modes import MODES as IN_FILE
from mbla.results.record.objects import Object
from mbla.solution.modes.modes import Modes

MODES = Object[Modes](owner=IN_FILE.owner)
MODES.fields(
    Modes,
    period=Field("the longest period", unit="time"),
    periods=Field("of each mode, falling", "mode", unit="time"),
    frequencies=Field("of each mode", "mode", unit="frequency"),
)


@MODES.key("a mode", "along x, y, z")
def masses(modes: Modes) -> list[list[float]]:
    """Mass of each mode that takes part, over the whole that moves that way."""
    found: list[list[float]] = modes.masses.tolist()
    return found


@MODES.key(dims="axis")
def mass_together(modes: Modes) -> FloatArray:
    """That of all these modes together."""
    return np.asarray(modes.masses.sum(axis=0))


MODES.fields(
    Modes,
    moving=Field("mass that moves along x, y, z", "axis", unit="mass"),
    default=Field("normal stiffness of joints for which the deck gives none", unit="bedding", attribute="default"),
    sag=Field("greatest displacement of a block at rest", unit="length"),
    residual=Field("greatest force that a mode leaves without balance, over its inertia", rule="open"),
    verified=Field("whether modes, and the state at rest, are verified"),
)
