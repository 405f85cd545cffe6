"""One part of a structure, whose blocks can interact, through the flow rule and the scheme of the analysis."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.deck.analysis import AnalysisSection
from mbla.program.program import Program
from mbla.solution.associative import AssociativeResult, solve_associative
from mbla.solution.clarabel_adapter import Log
from mbla.solution.law_state import LawState, SequenceResult
from mbla.solution.proximal import solve_proximal
from mbla.solution.published import solve_published
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status


@dataclass(frozen=True)
class PartResult:
    """What was found for one part.

    associative : by the associative flow rule
    sequence    : by the flow rule of the analysis where that is another one, None where it did not come to it
    loaded      : false where no live load acts on the part; then it only has to carry its dead load
    """

    program: Program
    associative: AssociativeResult
    sequence: SequenceResult | None
    loaded: bool

    @property
    def state(self) -> LawState | None:
        """Of the flow rule of the analysis."""
        return self.associative.state if self.sequence is None else self.sequence.state

    @property
    def status(self) -> Status:
        """Of the flow rule of the analysis; never better than that of the associative program it started from."""
        if self.sequence is None or (self.sequence.status is Status.SOLVED and self.associative.state is not None):
            return self.associative.status
        return self.sequence.status

    @property
    def reason(self) -> str:
        """Why the part is not plainly solved."""
        return self.associative.reason if self.sequence is None else self.sequence.reason or self.associative.reason

    @property
    def programs(self) -> tuple[ProgramRecord, ...]:
        """All cone programs that were solved for it."""
        return self.associative.programs if self.sequence is None else self.sequence.programs


def solve_part(program: Program, analysis: AnalysisSection, settings: SolverSettings, log: Log) -> PartResult:
    """Associative first, then the sequence that the flow rule asks for."""
    if not np.any(program.live_load):
        return _unloaded_part(program, settings, log)
    associative = solve_associative(program, settings, log)
    if analysis.flow_rule == "associative" or associative.state is None:
        return PartResult(program, associative, None, loaded=True)
    if analysis.flow_rule == "non_associative" and analysis.scheme != "published":
        sequence = solve_proximal(program, associative, analysis.proximal.max_programs, settings, log)
    else:
        dilatancy = program.limits.dilatancy if analysis.flow_rule == "dilatancy" else np.zeros(program.n_points)
        sequence = solve_published(program, associative, analysis.published, dilatancy, settings, log)
    return PartResult(program, associative, sequence, loaded=True)


def _unloaded_part(program: Program, settings: SolverSettings, log: Log) -> PartResult:
    """A part without live load: whether it carries its dead load shows when that is taken away step by step."""
    relieved = replace(program, live_load=-program.dead_load)
    result = solve_associative(relieved, settings, log) if np.any(program.dead_load) else None
    if result is None:
        result = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    carried = result.status in (Status.SOLVED, Status.APPROXIMATE)
    if carried:
        result = replace(result, status=Status.UNBOUNDED, state=None, reason="no live load acts on it")
    return PartResult(program, result, None, loaded=False)
