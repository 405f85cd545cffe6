"""Modes of vibration in the JSON record, at rest as built and after a time history."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.quantities.group import Field
from mbla.results.quantities.modes import MODES as IN_FILE
from mbla.results.quantities.modes import MODES_AFTER as IN_FILE_AFTER
from mbla.results.record.objects import Object
from mbla.solution.modes.modes import Modes

MODES = Object[Modes](owner=IN_FILE.owner)
MODES_AFTER = Object[Modes](owner=IN_FILE_AFTER.owner)


def _declare(group: Object[Modes], since: str) -> None:
    """What there is of modes; ``since``: from where joints give."""
    group.fields(
        Modes,
        period=Field("the longest period", unit="time"),
        periods=Field("of each mode, falling", "mode", unit="time"),
        frequencies=Field("of each mode", "mode", unit="frequency"),
    )

    @group.key("a mode", "along x, y, z")
    def masses(modes: Modes) -> list[list[float]]:
        """Mass of each mode that takes part, over the whole that moves that way."""
        found: list[list[float]] = modes.masses.tolist()
        return found

    @group.key(dims="axis")
    def mass_together(modes: Modes) -> FloatArray:
        """That of all these modes together."""
        return np.asarray(modes.masses.sum(axis=0))

    group.fields(
        Modes,
        moving=Field("mass that moves along x, y, z", "axis", unit="mass"),
        default=Field("normal stiffness of joints for which the deck gives none", unit="bedding", attribute="default"),
        sag=Field(f"greatest displacement of a block at rest{since}", unit="length"),
        residual=Field("greatest force that a mode leaves without balance, over its inertia", rule="open"),
        verified=Field("whether modes, and the state at rest, are verified"),
    )


_declare(MODES, "")
_declare(MODES_AFTER, ", from where the history ends")
