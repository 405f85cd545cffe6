"""A structure that stands is followed in time: what that gives as a solved load case, judged and verified."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from mbla.assembly.assembly import Assembly
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Message
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.time_history.checkpoint import Unfinished
from mbla.solution.time_history.follow import Followed, follow
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import judged
from mbla.solution.time_history.progress import TimeProgress
from mbla.solution.time_history.why_not_followed import why_not_followed
from mbla.solution.verification.verify import verify

Part: TypeAlias = tuple[SolvedCase, Unfinished | None]
"""A load case as far as it has come, and with what it goes on."""


def followed(
    assembly: Assembly,
    section: ContactsSection,
    stands: SolvedCase,
    settings: SolverSettings,
    watch: Callable[[TimeProgress], None],
    tell: Callable[[Callable[[], Part]], None],
    begin: Unfinished | None = None,
) -> SolvedCase:
    """The load case with its time history in the place of its rest alone; not verified where it cannot be followed.

    stands : under its dead load
    watch  : told of every step
    tell   : told how to make the same with the steps that are done by then
    begin  : what there is of the same time history, with which it goes on
    """
    model = assembly.model.of_case(stands.load_case)
    if against := why_not_followed(model, assembly.contacts, stands.solution):
        words = f"there is no time history: {against}"
        return replace(stands, solution=replace(stands.solution, status=Status.NOT_VERIFIED, reason=words))

    def so_far(make: Callable[[], Followed]) -> None:
        def part() -> Part:
            found, remarks, state = make()
            goes_on = None if state is None else Unfinished(found, state)
            return _with_history(assembly, stands, found, remarks), goes_on

        tell(part)

    found, remarks = follow(assembly, section, stands.load_case, settings, watch, so_far, begin)
    return _with_history(assembly, stands, found, remarks)


def _with_history(
    assembly: Assembly, stands: SolvedCase, found: TimeHistoryResult, remarks: tuple[Message, ...]
) -> SolvedCase:
    status, reason = judged(stands.load_case, found)
    at_rest = stands.solution
    solution = replace(at_rest, status=status, reason=reason, seconds=at_rest.seconds + found.seconds)
    solution = solution.with_further(replace(at_rest.further, time_history=found), remarks)
    return SolvedCase(stands.load_case, solution, verify(assembly, stands.load_case, solution))
