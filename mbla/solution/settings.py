"""Settings of the solver stage as one record: what ``accuracy`` and the single knobs of the deck come to."""

from __future__ import annotations

import time
from dataclasses import dataclass

from mbla.deck.sections.accuracy import PRESETS, knobs_of
from mbla.deck.sections.analysis import AnalysisSection

MAX_ITERATIONS = 300
"""Iterations of one program; walls of 10,000 blocks need about 70."""


@dataclass(frozen=True)
class SolverSettings:
    """One run of the cone solver.

    tolerance      : relative, on gap and feasibility of the scaled program
    max_iterations : for one program
    regularization : static regularisation of clarabel's KKT matrix; None: by kind and size of the program
    solver         : of cone programs: auto, mbla, clarabel, or highs for linear ones
    deadline       : time.monotonic() at which to stop, or None
    cholesky       : of the condensed method, qdldl, superlu or cholmod; None: by size and by what is installed
    gap            : relative distance of the proved bounds that an associative load factor should have
    residual       : of the joint law without normality at which a scheme has found its state
    """

    tolerance: float
    max_iterations: int = MAX_ITERATIONS
    regularization: float | None = None
    deadline: float | None = None
    solver: str = "auto"
    gap: float = PRESETS["standard"].gap
    residual: float = PRESETS["standard"].residual
    cholesky: str | None = None


def solver_settings(analysis: AnalysisSection) -> SolverSettings:
    """Settings that a deck asks for; the time limit starts now."""
    knobs = knobs_of(analysis)
    return SolverSettings(
        tolerance=knobs.tolerance,
        max_iterations=analysis.max_iterations or MAX_ITERATIONS,
        deadline=None if analysis.time_limit is None else time.monotonic() + analysis.time_limit,
        solver=analysis.solver,
        gap=knobs.gap,
        residual=knobs.residual,
    )
