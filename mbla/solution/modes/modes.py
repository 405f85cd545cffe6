"""Modes of vibration of a structure at rest: periods, shapes and participating masses, and the state they belong to."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import BoolArray, FloatArray


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes by falling period, n of them, and the structure at rest that vibrates.

    periods    : (n,) s
    shapes     : (n, n_blocks, 6) displacement of the centroid and rotation of each block, so that no corner goes
                 further than 1 of the unit of length
    masses     : (n, 3) mass that takes part along x, y and z, over the whole that moves that way
    moving     : (3,) kg, that whole
    default    : normal stiffness of joints for which the deck gives none, force per volume
    stiffness  : (n_interfaces, 2) of joints across and along, force per volume
    pressed    : (n_interfaces,) share of the interface that presses at rest
    settlement : (n_blocks, 6) m, rad, by which the joints give under the dead load
    loose      : (n_blocks,) blocks that joints do not hold: they move at no frequency, which is no mode
    slack      : ties that carry nothing at rest and hold no mode
    reason     : why there are none; empty where there are
    residual   : by code that did not find them: greatest ‖K φ − ω² M φ‖ over ‖ω² M φ‖; nan before that
    verified   : whether modes, and the state they belong to, are what they are said to be
    """

    periods: FloatArray = field(default_factory=lambda: np.zeros(0))
    shapes: FloatArray = field(default_factory=lambda: np.zeros((0, 0, 6)))
    masses: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    moving: FloatArray = field(default_factory=lambda: np.zeros(3))
    default: float = math.nan
    stiffness: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    pressed: FloatArray = field(default_factory=lambda: np.zeros(0))
    settlement: FloatArray = field(default_factory=lambda: np.zeros((0, 6)))
    loose: BoolArray = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    slack: int = 0
    reason: str = ""
    residual: float = math.nan
    verified: bool = False

    def __len__(self) -> int:
        return len(self.periods)

    @property
    def frequencies(self) -> FloatArray:
        """(n,) Hz."""
        return 1.0 / self.periods

    @property
    def period(self) -> float:
        """The longest, s; nan without."""
        return float(self.periods[0]) if len(self.periods) else math.nan

    @property
    def sag(self) -> float:
        """Greatest displacement of a centroid at rest, m; nan where there is none."""
        own = np.linalg.norm(self.settlement[:, :3], axis=1)
        return float(own.max()) if len(own) else math.nan


NO_MODES = Modes()
