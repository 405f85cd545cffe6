"""What solving a load case needs, as ``mbla check`` counts it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mbla.program.reductions.steps import ReductionStep


@dataclass(frozen=True)
class CaseNeeds:
    """Of one load case.

    counts     : what reaches the solver, by name; ``solver``: which takes its associative programs
    reductions : what each reduction left out, in the order in which they are applied
    """

    counts: Mapping[str, int | str]
    reductions: tuple[ReductionStep, ...] = ()
