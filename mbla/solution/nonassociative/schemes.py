"""Which scheme solves a part by another flow rule than the associative one.

Schemes beside the default one are imported where one is asked for: a run needs one of them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.collapse_state import FlowResult
from mbla.solution.nonassociative.elastic import solve_by_elastic_path
from mbla.solution.settings import SolverSettings

NOT_PUBLISHED = Message(
    "default-for-published",
    "the published procedure starts from associative forces, of which there are none here: the path of elastic joints "
    "was followed instead",
)


def solve_nonassociative(
    program: Program,
    associative: AssociativeResult,
    settings: SolverSettings,
    log: Log,
    interfaces: Interfaces = NONE,
) -> FlowResult:
    """The sequence that the flow rule and the scheme of the analysis ask for.

    interfaces : of the model that have a law of their own in the path of elastic joints
    """
    analysis = settings.analysis
    if analysis.flow_rule == "livesley":
        from mbla.solution.nonassociative.livesley import solve_livesley

        return solve_livesley(program, associative, settings, log)
    if settings.by_elastic_path:
        slope = slope_of(program, analysis.flow_rule)
        return solve_by_elastic_path(program, associative, slope, settings, log, interfaces)
    return _published(program, associative, settings, log, interfaces)


def slope_of(program: Program, flow_rule: str) -> FloatArray:
    """Tangent of the dilatancy angle, (n_points,): of the joints, or 0 without."""
    return program.limits.dilatancy if flow_rule == "dilatancy" else np.zeros(program.n_points)


def _published(
    program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log, interfaces: Interfaces
) -> FlowResult:
    """The published procedure starts from associative forces; where there are none the path has to do."""
    none = np.zeros(program.n_points)
    if associative.state is None:
        sequence = solve_by_elastic_path(program, associative, none, settings, log, interfaces)
        return replace(sequence, remarks=(*sequence.remarks, NOT_PUBLISHED))
    from mbla.solution.nonassociative.published import solve_published

    return solve_published(program, associative, settings.analysis.published, none, settings, log)
