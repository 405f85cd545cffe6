"""The load cases that are solved for one of the deck: itself, or a tilting table at one angle after the other."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import replace

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.settings import SolverSettings
from mbla.solution.settlement import posed
from mbla.solution.tilt import Angles, Answer, tilt_angles
from mbla.solution.verification.verify import verify


class Trials:
    """Load cases to solve and verify in a loop, whose body hands each answer back; the last answer is that of the case.

    ::

        for case in trials:
            trials.answer = Answer(case, solution, checks)
    """

    answer: Answer

    def __init__(self, cases: Angles) -> None:
        self._cases = cases

    def __iter__(self) -> Iterator[LoadCase]:
        try:
            case = next(self._cases)
            while True:
                yield case
                case = self._cases.send(self.answer)
        except StopIteration as end:
            self.answer = end.value


def trials_of(model: Model, contacts: Contacts, load_case: LoadCase, settings: SolverSettings) -> Trials:
    """What is solved for a load case of the deck; of a support that gives way with the reaction that it starts from."""
    if load_case.tilt is not None:
        return Trials(_verified(model, contacts, tilt_angles(model, contacts, load_case)))
    return Trials(_once(posed(model, contacts, load_case, settings)))


def _once(load_case: LoadCase) -> Generator[LoadCase, Answer, Answer]:
    return (yield load_case)


def _verified(model: Model, contacts: Contacts, angles: Angles) -> Angles:
    """The angle found is verified with what was found of the level table, which proves what lies before it."""
    answer = yield from angles
    return replace(answer, checks=verify(model, contacts, answer.load_case, answer.solution))
