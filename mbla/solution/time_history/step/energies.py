"""Energies of a structure in time, as sums over its steps."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class Energies:
    """J since the structure was at rest; see :mod:`mbla.solution.time_history.step_rows`."""

    kinetic: float = 0.0
    potential: float = 0.0
    elastic: float = 0.0
    friction: float = 0.0
    contacts: float = 0.0
    ties: float = 0.0
    base: float = 0.0
    forces: float = 0.0
    numerical: float = 0.0

    def plus(self, other: Energies) -> Energies:
        """The sum of both; kinetic and elastic energies are those of the other."""
        sums = np.add(astuple(self), astuple(other)).tolist()
        return Energies(other.kinetic, sums[1], other.elastic, *sums[3:])


def powers(first: FloatArray, second: FloatArray) -> float:
    """Work of impulses (n, 6) on velocities (n, 6), or of momenta."""
    return float(np.vdot(first, second))
