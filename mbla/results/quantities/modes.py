"""Modes of vibration about a state at rest, and that state: how stiff its joints are, and which of them press.

There are those at rest as built, and those after a time history: each is a group and a table of its own.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.solution.modes.modes import Modes


def _before(scene: Scene) -> Modes | None:
    """Where there are any."""
    found = scene.solved.solution.further.modes
    return found if len(found) else None


def _after(scene: Scene) -> Modes | None:
    """Where there are any."""
    found = scene.solved.solution.further.modes_after
    return found if len(found) else None


MODES = Group[Modes](_before, file="cases/*/vibration", table="modes", part="modes")
MODES_AFTER = Group[Modes](_after, file="cases/*/vibration_after", table="modes_after", part="modes after")
TABLE = Group[Modes](_before, table="modes")
TABLE_AFTER = Group[Modes](_after, table="modes_after")


def _declare(group: Group[Modes], table: Group[Modes], interface: str, since: str) -> None:
    """What there is of modes.

    interface : what is along arrays of the interfaces of their state
    since     : from where joints give
    """

    @table.quantity("table", dims="mode")
    def mode(modes: Modes) -> IntArray:
        """Number of the mode, from 1, by falling period."""
        return np.arange(1, len(modes) + 1)

    group.fields(
        Modes,
        periods=Field("period", "mode", unit="time", files="table"),
    )

    @table.quantity("table", dims="mode", unit="frequency")
    def frequencies(modes: Modes) -> FloatArray:
        """Oscillations in a second."""
        return modes.frequencies

    group.fields(
        Modes,
        masses=Field(
            "mass that takes part along each axis, over the whole that moves along it", "mode axis", files="table"
        ),
    )

    @table.quantity("table", dims="mode axis")
    def masses_so_far(modes: Modes) -> FloatArray:
        """The same of this mode and all before it together."""
        return modes.masses.cumsum(axis=0)

    group.fields(
        Modes,
        shapes=Field(
            "displacement of the centroid of each block and its rotation, so that no corner goes further than 1",
            "mode block component",
            unit="motion",
        ),
        moving=Field("mass that moves along each axis", "axis", unit="mass"),
        default=Field("normal stiffness of joints for which the deck gives none", unit="bedding", attribute="default"),
        stiffness=Field("of each interface across and along, force per volume", f"{interface} pair", unit="bedding"),
        pressed=Field("share of each interface that presses at rest", interface),
        settlement=Field(
            f"displacements and rotations of the blocks at rest, by which joints give under the dead load{since}",
            "block component",
            unit="displacement",
        ),
        loose=Field("1 for blocks that joints do not hold", "block", unverified="modes"),
        slack=Field("ties that carry nothing at rest and hold no mode"),
        residual=Field("greatest force that a mode leaves without balance, over its inertia"),
        verified=Field("1 where modes, and the state at rest, are verified"),
    )

    @group.quantity(unit="length", words=f"greatest displacement of a centroid at rest{since}")
    def sag(modes: Modes) -> float:
        return modes.sag


_declare(MODES, TABLE, "interface", "")
_declare(MODES_AFTER, TABLE_AFTER, "interface_after", ", from where the history ends")
