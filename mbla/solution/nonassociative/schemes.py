"""Which scheme solves a part by another flow rule than the associative one.

Schemes beside the default one are imported where one is asked for: a run needs one of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.default_scheme import solve_by_default
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.nonassociative.refine_equilibrium import sharpened
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.thresholds import EXACT_RESIDUAL

NOT_REACHED = Message(
    "law-missed", "forces and velocities violate the joint law: residual {:.2g}; the requested {:g} was not reached"
)
NOT_PUBLISHED = Message(
    "default-for-published",
    "the published procedure starts from associative forces, of which there are none here: the default scheme was "
    "used instead",
)


Scheme = Callable[[Program, AssociativeResult, SolverSettings, Log], SequenceResult]


def solve_nonassociative(
    program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log
) -> SequenceResult:
    """The sequence that the flow rule and the scheme of the analysis ask for."""
    analysis = settings.analysis
    by_rule: Mapping[str, Scheme] = {"livesley": _livesley, "dilatancy": _dilatancy}
    sequence = by_rule.get(analysis.flow_rule, SCHEMES[analysis.scheme])(program, associative, settings, log)
    if analysis.flow_rule == "livesley" or (analysis.flow_rule == "non_associative" and analysis.scheme != "auto"):
        return sequence
    if settings.residual <= EXACT_RESIDUAL:  # with a state that light blocks fit too, unless a rough one was asked for
        slope = program.limits.dilatancy if analysis.flow_rule == "dilatancy" else 0.0
        sequence = sharpened(program, associative, slope, sequence)
    state, wanted = sequence.state, settings.residual
    if state is None or sequence.status is not Status.SOLVED or state.residual <= wanted:
        return sequence
    return replace(sequence, remarks=(*sequence.remarks, NOT_REACHED.format(state.residual, wanted)))


def _default(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> SequenceResult:
    return solve_by_default(program, associative, np.zeros(program.n_points), settings, log)


def _published(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> SequenceResult:
    """The published procedure starts from associative forces; where there are none the default scheme has to do."""
    from mbla.solution.nonassociative.published import solve_published

    if associative.state is None:
        sequence = _default(program, associative, settings, log)
        return replace(sequence, remarks=(*sequence.remarks, NOT_PUBLISHED))
    none = np.zeros(program.n_points)
    return solve_published(program, associative, settings.analysis.published, none, settings, log)


def _dilatancy(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> SequenceResult:
    return solve_by_default(program, associative, program.limits.dilatancy, settings, log)


def _livesley(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> SequenceResult:
    from mbla.solution.nonassociative.livesley import solve_livesley

    return solve_livesley(program, associative, settings, log)


def _elastic(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> SequenceResult:
    from mbla.solution.nonassociative.elastic import solve_by_elastic_path

    return solve_by_elastic_path(program, associative, settings, log)


SCHEMES: Mapping[str, Scheme] = {"auto": _default, "published": _published, "elastic": _elastic}
"""By the deck's word."""
