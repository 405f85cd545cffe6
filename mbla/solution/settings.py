"""Settings of the solver stage as one record: the analysis section, and what ``accuracy`` and single knobs set."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

from mbla.deck.sections.accuracy import PRESETS, knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.model.model import LoadCase
from mbla.solution.associative.settings import AssociativeSettings

MAX_ITERATIONS = 300
"""Iterations of one program."""


@dataclass(frozen=True)
class SolverSettings:
    """What the deck asks of the solver stage, passed down to the solvers.

    tolerance      : relative, on gap and feasibility of the scaled program
    max_iterations : for one program
    regularization : static regularisation of clarabel's KKT matrix; None: by kind and size of the program
    solver         : of cone programs: auto, mbla or clarabel
    deadline       : time.monotonic() at which to stop, or None
    cholesky       : of the condensed method, qdldl, superlu or cholmod; None: by size and by what is installed
    gap            : relative distance of the proved bounds that an associative load factor should have
    residual       : of the joint law without normality at which a scheme has found its state
    search         : iterations spent on lower load factors, over those of the first state found
    torsion        : whether the load factor with torsion of uniform pressure is wanted beside that of contact points
    standing       : whether it is assessed in addition to the load factor
    steps          : length of those of a path of elastic joints, over the usual
    proof          : how an associative load factor is proved
    analysis       : flow rule, scheme with its parameters
    """

    tolerance: float
    max_iterations: int = MAX_ITERATIONS
    regularization: float | None = None
    deadline: float | None = None
    solver: str = "auto"
    gap: float = PRESETS["standard"].gap
    residual: float = PRESETS["standard"].residual
    cholesky: str | None = None
    search: float = PRESETS["standard"].search
    torsion: bool = PRESETS["standard"].torsion
    standing: bool = PRESETS["standard"].standing
    steps: float = 1.0
    proof: AssociativeSettings = field(default_factory=AssociativeSettings, repr=False)
    analysis: AnalysisSection = field(default_factory=AnalysisSection, compare=False, repr=False)

    @property
    def by_elastic_path(self) -> bool:
        """Whether the analysis asks for the path of elastic joints."""
        rule = self.analysis.flow_rule
        return rule == "dilatancy" or (rule == "non_associative" and self.analysis.scheme == "auto")

    @property
    def by_torsion(self) -> bool:
        """Whether a second path is followed, with torsion of uniform pressure."""
        own = self.analysis
        by_points = own.flow_rule == "non_associative" and own.contact_model == "concave"
        return self.torsion and self.by_elastic_path and by_points


def solver_settings(analysis: AnalysisSection) -> SolverSettings:
    """Settings that a deck asks for; the time limit starts now."""
    return SolverSettings(
        **vars(knobs_of(analysis)),
        max_iterations=analysis.max_iterations or MAX_ITERATIONS,
        deadline=None if analysis.time_limit is None else time.monotonic() + analysis.time_limit,
        solver=analysis.solver,
        analysis=analysis,
    )


def settings_for(load_case: LoadCase, settings: SolverSettings) -> SolverSettings:
    """The settings of one load case: an objective is a static question, and its bounds are those of normality."""
    if load_case.question.collapses or not load_case.has_load_factor:
        return settings
    analysis = settings.analysis.model_copy(update={"flow_rule": "associative"})
    return replace(settings, standing=False, analysis=analysis)
