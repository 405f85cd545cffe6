"""Rows of a structure in time, one for each step of the deck."""

from __future__ import annotations

from dataclasses import astuple, dataclass, field, fields

import numpy as np

from mbla.arrays import IntArray
from mbla.solution.time_history.step.march import DeckStep
from mbla.solution.time_history.step.time_state import TimeState
from mbla.solution.time_history.step_rows import StepRows


@dataclass
class RowKeeper:
    """So far: time, energies, e, counts and pressing points of each."""

    rows: list[tuple[float, ...]] = field(default_factory=list)
    searches: int = 0
    largest: float = 0.0

    @staticmethod
    def of(state: TimeState) -> RowKeeper:
        """Before the first step."""
        keeper = RowKeeper()
        keeper._add(state, 0.0, int((state.at.offsets[0] < 0.0).sum()))
        return keeper

    @staticmethod
    def resumed(rows: StepRows, searches: int) -> RowKeeper:
        """After rows that are on record."""
        columns = [getattr(rows, each.name) for each in fields(rows)]
        keeper = RowKeeper([tuple(row) for row in np.column_stack(columns).tolist()], searches)
        keeper.largest = float(np.abs(np.column_stack(columns[1:10])).max(initial=0.0))
        return keeper

    def add(self, step: DeckStep) -> None:
        """A step of the deck."""
        self._add(step.after, step.error, int((step.first.forces.normal > 0.0).sum()))

    def _add(self, state: TimeState, error: float, pressing: int) -> None:
        counts = state.counts
        own = (counts.factorisations, counts.small, counts.halved, counts.missed, pressing)
        energies = astuple(state.energies)
        self.rows.append((state.time, *energies, error, *own))
        self.largest = max(self.largest, *(abs(each) for each in energies))
        self.searches = counts.searches

    @property
    def balance(self) -> float:
        """Energy that is not accounted for at the last row, over the greatest energy so far."""
        kinetic, potential, _, friction, contacts, ties, base, forces, numerical = self.rows[-1][1:10]
        left = kinetic + potential + friction + contacts + ties - base - forces - numerical
        return abs(left) / self.largest if self.largest > 0.0 else 0.0

    def result(self) -> StepRows:
        """All rows."""
        columns = np.array(self.rows).T
        whole: list[IntArray] = [each.astype(np.int64) for each in columns[11:]]
        return StepRows(*columns[:11], *whole)
