"""A load case that was solved and verified, and a sequence of analyses that asks for such."""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass
from typing import TypeAlias

from mbla.model.model import LoadCase
from mbla.solution.solution import WITH_VALUE, Checks, Solution, Status
from mbla.solution.verification.verify_points import verified_status


@dataclass(frozen=True)
class SolvedCase:
    """A load case with its solution and what verification found of that."""

    load_case: LoadCase
    solution: Solution
    checks: Checks

    @property
    def status(self) -> Status:
        """Never better than verification confirms."""
        return verified_status(self.solution, self.checks)

    @property
    def load_factor(self) -> float:
        """By the flow rule of the analysis; inf where no multiple brings it down, nan where there is none."""
        if self.solution.status is Status.UNBOUNDED:
            return math.inf
        own = self.solution.mechanics
        return own.load_factor if own is not None and self.solution.status in WITH_VALUE else math.nan


AnalysisSequence: TypeAlias = Generator[LoadCase, SolvedCase, SolvedCase]
"""Load cases to be solved and verified one after the other; each comes back solved, and the answer is returned."""
