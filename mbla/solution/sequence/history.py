"""A structure that stands and was followed in time, as a solved load case: judged, and verified."""

from __future__ import annotations

from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.errors import Message
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import judged
from mbla.solution.verification.verify import verify


def with_history(
    assembly: Assembly, stands: SolvedCase, found: TimeHistoryResult, remarks: tuple[Message, ...]
) -> SolvedCase:
    """The load case with what was found of it in time, in the place of its rest alone.

    stands : under its dead load
    """
    status, reason = judged(stands.load_case, found)
    at_rest = stands.solution
    solution = replace(at_rest, status=status, reason=reason, seconds=at_rest.seconds + found.seconds)
    solution = solution.with_further(replace(at_rest.further, time_history=found), remarks)
    return SolvedCase(stands.load_case, solution, verify(assembly, stands.load_case, solution))
