"""Flow rules other than the associative one, and the schemes that solve them: from the deck's words to a sequence.

A scheme is imported where it is asked for: a run needs one of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.program.kinematic import friction_polygon
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.proximal import SOLVED, is_rough_enough, solve_proximal
from mbla.solution.nonassociative.refine_equilibrium import sharpened
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status

NOT_REACHED = Message(
    "law-missed", "forces and velocities violate the joint law: residual {:.2g}; the requested {:g} was not reached"
)

LARGE = 4000
"""Unknowns of the motion above which no interior path is followed unless it is asked for. On a planar wall of 30 by 30
units, 2,745 unknowns, one took 1,018 factorisations, twice the time of the steps; on one of 40 by 40, 4,860 unknowns,
one took 1,319 in 70 s and ended at 4e-3, where the steps had come to 3e-5 in half of that."""

NOT_FOLLOWED = Message(
    "interior-not-followed",
    "interior paths of the exact law were not followed: on a structure of this size they take longer than the steps "
    "and mostly end with a larger residual; analysis.scheme: interior follows them",
)

NOT_PUBLISHED = Message(
    "proximal-for-published",
    "the published procedure starts from associative forces, of which there are none here: the proximal scheme was "
    "used instead",
)


@dataclass(frozen=True)
class Flow:
    """What every scheme gets."""

    program: Program
    associative: AssociativeResult
    analysis: AnalysisSection
    settings: SolverSettings
    log: Log

    @property
    def locked(self) -> bool:
        """No associative load factor: friction with normality carries every multiple."""
        return self.associative.state is None


Scheme = Callable[[Flow], SequenceResult]


def solve_flow(flow: Flow) -> SequenceResult:
    """The sequence that the flow rule and the scheme of the analysis ask for."""
    if flow.analysis.flow_rule == "livesley":
        return _livesley(flow)
    if flow.analysis.flow_rule == "dilatancy":
        return _with_shortfall(flow, _sharpened(flow, flow.program.limits.dilatancy, _dilatancy(flow)))
    sequence = SCHEMES[flow.analysis.scheme](flow)
    if flow.analysis.scheme == "published":
        return sequence
    return _with_shortfall(flow, _sharpened(flow, 0.0, sequence))


def _sharpened(flow: Flow, slope: FloatArray | float, sequence: SequenceResult) -> SequenceResult:
    """With a state that light blocks fit too, unless a rough one was asked for."""
    if flow.settings.residual > SOLVED:
        return sequence
    return sharpened(flow.program, flow.associative, slope, sequence)


def _with_shortfall(flow: Flow, sequence: SequenceResult) -> SequenceResult:
    """The same, with a remark where it is solved, but not as sharply as was asked for."""
    state, wanted = sequence.state, flow.settings.residual
    if state is None or sequence.status is not Status.SOLVED or state.residual <= wanted:
        return sequence
    return replace(sequence, remarks=(*sequence.remarks, NOT_REACHED.format(state.residual, wanted)))


def _proximal(flow: Flow) -> SequenceResult:
    return solve_proximal(flow.program, flow.associative, flow.analysis.proximal.max_programs, flow.settings, flow.log)


def _interior(flow: Flow, start: SequenceResult | None = None) -> SequenceResult:
    from mbla.solution.nonassociative.interior_path.solve_interior import solve_interior

    wanted = flow.analysis.interior
    return solve_interior(flow.program, flow.associative, wanted, flow.settings, flow.log, start=start)


def _auto(flow: Flow) -> SequenceResult:
    """The proximal scheme, and the interior path where that stalls above the residual of a state of the exact law.

    A sharper one is asked of what was found: the other scheme would end in another state, and costs many times more.
    """
    sequence = _proximal(flow)
    if sequence.state is not None and _is_enough(flow, sequence.state):
        return sequence
    if sequence.status is Status.TIME_LIMIT:
        return sequence
    if sequence.state is not None and len(flow.program.dead_load) > LARGE:
        return replace(sequence, remarks=(*sequence.remarks, NOT_FOLLOWED))
    return _interior(flow, start=sequence)


def _is_enough(flow: Flow, state: LawState) -> bool:
    """Whether a state is one of the exact law, or as rough as asked for."""
    wanted = flow.settings.residual
    return is_rough_enough(flow.program, 0.0, state, wanted) if wanted > SOLVED else state.residual <= SOLVED


def _lowest(flow: Flow) -> SequenceResult:
    from mbla.solution.nonassociative.search_lower_factor import search_lower_factor

    return search_lower_factor(flow.program, _auto(flow), flow.analysis.lowest, flow.settings, flow.log)


def _path(flow: Flow) -> SequenceResult:
    from mbla.solution.nonassociative.load_path import solve_path

    return solve_path(flow.program, flow.associative, flow.analysis.path, flow.settings, flow.log)


def _published(flow: Flow) -> SequenceResult:
    """The published procedure starts from associative forces; where there are none the proximal scheme has to do."""
    from mbla.solution.nonassociative.published import solve_published

    if flow.locked:
        sequence = _proximal(flow)
        return replace(sequence, remarks=(*sequence.remarks, NOT_PUBLISHED))
    none = np.zeros(flow.program.n_points)
    return solve_published(flow.program, flow.associative, flow.analysis.published, none, flow.settings, flow.log)


def _dilatancy(flow: Flow) -> SequenceResult:
    from mbla.solution.nonassociative.dilatancy import solve_dilatancy

    return solve_dilatancy(flow.program, flow.associative, flow.analysis.proximal, flow.settings, flow.log)


def _livesley(flow: Flow) -> SequenceResult:
    from mbla.solution.nonassociative.livesley import solve_livesley

    facets = None
    if flow.analysis.friction_cone == "polyhedral" and flow.program.components == 3:
        facets = friction_polygon(flow.analysis.sides, circumscribed=False)
    return solve_livesley(flow.program, flow.associative, flow.settings, flow.log, facets=facets)


SCHEMES: Mapping[str, Scheme] = {
    "auto": _auto,
    "proximal": _proximal,
    "interior": _interior,
    "path": _path,
    "lowest": _lowest,
    "published": _published,
}
"""By the deck's word."""
