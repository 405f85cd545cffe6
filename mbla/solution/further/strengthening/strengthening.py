"""What may be added to a structure to carry given load factors, and the cheapest of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import Status

if TYPE_CHECKING:  # the verification sees this record
    from mbla.solution.cone_solvers.cone_solution import Log
    from mbla.solution.settings import SolverSettings


@dataclass(frozen=True)
class Requirement:
    """A load case and the load factor that it has to carry."""

    load_case: LoadCase
    load_factor: float


@dataclass(frozen=True)
class Cheapest:
    """Answer of the program.

    status     : SOLVED, or why there are no capacities: NO_EQUILIBRIUM where none suffice
    capacities : (k,) N
    use        : (k,) worth of a candidate over its cost: 1 of those that are used
    cost       : of the capacities
    least_cost : proved by the mechanisms: no capacities cost less by associative flow; nan where they prove nothing
    """

    status: Status
    capacities: FloatArray
    use: FloatArray
    cost: float
    least_cost: float
    reason: str = ""


@dataclass(frozen=True)
class Strengthening:
    """What may be added to a structure.

    assembly : with candidates behind its own ties, whose number is ``first``
    costs : (k,) of a unit of capacity; most : (k,) greatest capacity, N
    """

    assembly: Assembly
    first: int
    costs: FloatArray
    most: FloatArray
    requirements: tuple[Requirement, ...]
    settings: SolverSettings
    log: Log

    @property
    def model(self) -> Model:
        """With its candidates."""
        return self.assembly.model

    def _with_ties(self, rows: IntArray) -> Assembly:
        """Some of its ties alone, (n,)."""
        return replace(self.assembly, model=replace(self.model, ties=self.model.ties.take(rows)))

    def asking(self, factors: Mapping[str, float]) -> Strengthening:
        """The same with other load factors required, by load case."""
        return replace(
            self,
            requirements=tuple(replace(each, load_factor=factors[each.load_case.name]) for each in self.requirements),
        )

    def take(self, rows: IntArray) -> Strengthening:
        """The same with some of the candidates, (n,)."""
        chosen = self._with_ties(np.concatenate([np.arange(self.first), self.first + rows]))
        return replace(self, assembly=chosen, costs=self.costs[rows], most=self.most[rows])

    @property
    def without_candidates(self) -> Assembly:
        """As it is."""
        return self._with_ties(np.arange(self.first))

    @property
    def unit(self) -> float:
        """Of force: mean dead load of a free block of the first case, or live load where there is none."""
        case = self.requirements[0].load_case
        for load in (case.dead_load, case.live_load):
            sizes = np.linalg.norm(load[self.model.free, :3], axis=1)
            if sizes.any():
                return float(sizes[sizes > 0].mean())
        return 1.0
