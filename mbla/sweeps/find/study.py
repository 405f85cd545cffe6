"""``mbla find``: ask, look, and say what was found: table, sentences, JSON."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mbla import __version__
from mbla.deck import Deck
from mbla.process.sharing import Memory, sharing
from mbla.results.listing.text import counted, full_sentence, number, sentence, small, table
from mbla.results.record.json_values import as_json
from mbla.solution.limits.zeros import Zero, changes, find_zero, scan
from mbla.sweeps.find.answer import Answer, answer_at
from mbla.sweeps.find.question import TARGETS, Question, question_of

FOUND, IN_DOUBT, NOTHING = 0, 4, 5
"""exit status: every value verified; one that is not, or nothing known at all; no change of sign between the bounds"""


@dataclass(frozen=True)
class Finding:
    """What was found.

    answers : in the order in which they were looked for
    zeros   : values at which the result is the target, from the least on
    """

    question: Question
    answers: tuple[Answer, ...]
    zeros: tuple[Zero[Answer], ...]

    @property
    def solves(self) -> int:
        """Programs with a load factor that were solved."""
        return sum(each.solves for each in self.answers)

    @property
    def exit_code(self) -> int:
        """See ``FOUND``."""
        if not self.zeros:
            return IN_DOUBT if all(math.isnan(each.y) for each in self.answers) else NOTHING
        sound = all(zero.complete and _sure(zero) for zero in self.zeros)
        return FOUND if sound else IN_DOUBT

    @property
    def record(self) -> dict[str, Any]:
        """The JSON object."""
        question = self.question
        return {
            "mbla": __version__,
            "parameter": question.parameter,
            "unit": question.unit,
            "load_case": question.load_case,
            "target": {question.kind: True if question.kind == "stands" else question.target},
            "bounds": list(question.bounds),
            "tolerance": question.tolerance,
            "found": [
                {
                    "value": zero.best.x,
                    "error": zero.error,
                    "bracket": sorted(each.x for each in zero.bracket),
                    "rises": zero.bracket[0].x < zero.bracket[1].x,
                    "complete": zero.complete,
                    "jumps": zero.jumps,
                    **_answer_json(zero.best),
                }
                for zero in self.zeros
            ],
            "evaluations": [{"value": each.x, **_answer_json(each)} for each in self.answers],
            "solves": self.solves,
            "exit_code": self.exit_code,
        }

    @property
    def lines(self) -> list[str]:
        """The same in words."""
        question, what = self.question, TARGETS[self.question.kind]
        asked = "the dead load is just carried" if question.kind == "stands" else f"{what} {number(question.target)}"
        least, greatest = (f"{each:g}" for each in question.bounds)
        unit = f" {question.unit}" if question.unit else ""
        lines = [
            f"{question.parameter} from {least} to {greatest}{unit}, load case {question.load_case}: where {asked}"
        ]
        rows = [
            [
                f"{each.x:.9g}",
                *("-" if math.isnan(value) else f"{value:.7g}" for value in (each.result, each.slope)),
                each.status,
                "" if each.verified or not each.solves else "not verified",
            ]
            for each in self.answers
        ]
        head = ["value", what, "slope", "", ""]
        lines += table(head, rows, left=0)
        for words in dict.fromkeys(each.words for each in self.answers if each.words):
            lines += sentence(full_sentence(words))
        if question.kind == "stands":
            lines += sentence(PRESSURE)
        for zero in self.zeros:
            lines += sentence(_found_words(question, zero))
        if not self.zeros:
            lines += sentence(NO_CHANGE.format(question.scan))
        return [*lines, f"  {counted(len(self.answers), 'value')}, {counted(self.solves, 'solve')}"]


PRESSURE = (
    "Pressure in all joints that is carried with the dead load, over the weight per area of joints; where it is "
    "negative, the dead load alone is not carried."
)
NO_CHANGE = (
    "Nothing was found: the result is on one side of the target at both ends of every step ({} from bound to bound). "
    "Other bounds or a finer --scan may find it."
)


def _sure(zero: Zero[Answer]) -> bool:
    """Whether the answer that counts is verified: of a jump those on both sides."""
    return all(each.verified for each in zero.bracket) if zero.jumps else zero.best.verified


def _answer_json(answer: Answer) -> dict[str, Any]:
    names = ("result", "slope", "status", "verified", "words", "bounds")
    return {name: as_json(getattr(answer, name)) for name in names}


def _found_words(question: Question, zero: Zero[Answer]) -> str:
    """Value, error, which way the result goes, and how sure it is."""
    below, above = zero.bracket
    unit = f" {question.unit}" if question.unit else ""
    name, rises = question.parameter, below.x < above.x
    between = f"between {min(below.x, above.x):.9g} and {max(below.x, above.x):.9g}{unit}"
    if zero.jumps:
        says = f"{name} {between}: there the result jumps from {_side(below)} to {_side(above)}"
    else:
        says = f"{name} = {zero.best.x:.9g}{unit}, within {small(zero.error)} by "
        says += "the values around it" if math.isnan(zero.best.slope) else "the slope there"
    if question.kind == "stands":
        says += f"; it stands {'above' if rises else 'below'}"
    else:
        says += f"; the result {'rises' if rises else 'falls'} with it"
    if not zero.complete:
        says += "; the search did not come to its end"
    status = "verified" if _sure(zero) else "NOT verified"
    shown = f"mbla run --set {name}={zero.best.x!r} shows it"
    return f"{says}. The last answer is {status}; {shown}."


def _side(answer: Answer) -> str:
    """A result in words."""
    return answer.status if math.isnan(answer.result) else number(answer.result)


def find(deck: Deck, options: Any, report: Callable[[Answer], None] | None = None) -> Finding:
    """Look for the values that the deck or the options ask for.

    report : called with every answer

    Raises
    ------
    UsageError
        The question is not complete, or names what the deck does not have.
    SolverError, LimitError
        As a run does.
    """
    question = question_of(deck, options)
    answers: list[Answer] = []

    def at(x: float) -> Answer:
        answers.append(answer_at(deck, question, x))
        if report is not None:
            report(answers[-1])
        return answers[-1]

    with sharing(Memory()):
        samples = scan(*question.bounds, question.scan, at)
        zeros = [find_zero(one, other, at, question.absolute_tolerance) for one, other in changes(samples)]
    return Finding(question, tuple(answers), tuple(zeros))
