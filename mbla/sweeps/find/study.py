"""``mbla find``: ask, look, and say what was found: table, sentences, JSON."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from mbla import __version__
from mbla.contacts.known import KnownContacts
from mbla.deck import Deck
from mbla.deck.sections.find import SWITCHES
from mbla.results.listing.text import counted, full_sentence, number, sentence, small, table
from mbla.results.record.json_values import as_json
from mbla.solution.further.zeros.samples import Zero
from mbla.solution.further.zeros.zeros import find_zeros, is_level, scan, scan_to_first
from mbla.solution.solution import Standing, StandingResult
from mbla.sweeps.find.answer import REFUSED, Evaluation, answer_at, refuse_unfit_deck, standing_at
from mbla.sweeps.find.question import TARGETS, FindQuestion, question_of

FOUND, IN_DOUBT, NOTHING = 0, 4, 5
"""exit status: every value verified; one that is not, that is a jump of the load factor or no limit of standing, or
nothing found and something not known; the target neither passed nor met between the bounds"""


@dataclass(frozen=True)
class FindResult:
    """What was found.

    answers : in the order in which they were looked for
    zeros   : values, or stretches of values, at which the result is the target, from the least on
    scanned : answers at the steps between the bounds
    standing : of ``stands``, at each zero on the side that stands: whether it does from the stress-free assembly
    """

    question: FindQuestion
    answers: tuple[Evaluation, ...]
    zeros: tuple[Zero[Evaluation], ...]
    scanned: tuple[Evaluation, ...]
    standing: tuple[StandingResult, ...]

    @property
    def solves(self) -> int:
        """Programs with a load factor that were solved."""
        return sum(each.solves for each in self.answers)

    @property
    def exit_code(self) -> int:
        """See ``FOUND``."""
        if not self.zeros:
            return IN_DOUBT if self.unknown else NOTHING
        steps = self.question.kind == "stands" or self.question.in_time
        sound = all(_sure(zero) and (steps or not zero.jumps) for zero in self.zeros)
        return FOUND if sound and all(each.verdict is Standing.YES for each in self.standing) else IN_DOUBT

    @property
    def unknown(self) -> tuple[Evaluation, ...]:
        """Steps at which not even the side is known."""
        return tuple(each for each in self.scanned if math.isnan(each.y))

    @property
    def changes(self) -> bool:
        """Whether the result is not the same at all steps between the bounds, as far as it is known."""
        return not is_level(self.scanned)

    @property
    def found_words(self) -> list[str]:
        """A sentence or some on every value that was found."""
        of_load_factor = [None] * (len(self.zeros) - len(self.standing))
        pairs = zip(self.zeros, [*self.standing, *of_load_factor], strict=True)
        return [_found_words(self.question, zero, standing) for zero, standing in pairs]

    @property
    def record(self) -> dict[str, Any]:
        """The JSON object."""
        question = self.question
        return {
            "mbla": __version__,
            "parameter": question.parameter,
            "unit": question.unit,
            "load_case": question.load_case,
            "target": {question.kind: True if question.kind in SWITCHES else question.target},
            "bounds": list(question.bounds),
            "tolerance": question.tolerance,
            "found": [
                {
                    "value": zero.best.x,
                    "error": zero.error,
                    "bracket": sorted(each.x for each in zero.bracket),
                    "rises": zero.rises if zero.stretch is None else None,
                    "stretch": None if zero.stretch is None else [each.x for each in zero.stretch],
                    "complete": zero.complete,
                    "jumps": zero.jumps,
                    **_answer_json(zero.best),
                    "says": says,
                    **({"standing": self.standing[row].verdict.value} if self.standing else {}),
                }
                for row, (zero, says) in enumerate(zip(self.zeros, self.found_words, strict=True))
            ],
            "changes": self.changes,
            "evaluations": [{"value": each.x, **_answer_json(each)} for each in self.answers],
            "solves": self.solves,
            "exit_code": self.exit_code,
        }

    @property
    def lines(self) -> list[str]:
        """The same in words."""
        question, what = self.question, TARGETS[self.question.kind]
        asked = ASKED.get(question.kind) or f"{what} {number(question.target)}"
        least, greatest = (f"{each:g}" for each in question.bounds)
        unit = f" {question.unit}" if question.unit else ""
        bounds = f"{question.parameter} from {least} to {greatest}{unit}"
        lines = [f"{bounds}, load case {question.load_case}: where {asked}"]
        lines += table(["value", what, "slope", "", ""], list(map(_row, self.answers)), left=0)
        for words in dict.fromkeys(each.words for each in self.answers if each.words):
            lines += sentence(full_sentence(words))
        if question.kind == "stands":
            lines += sentence(PRESSURE)
        for words in self.found_words:
            lines += sentence(words)
        if question.in_time:
            lines += sentence(CHAOS)
        if question.first and self.zeros:
            lines += sentence(FIRST.format(f"{self.scanned[-1].x:.9g}{unit}"))
        if not self.changes:
            words = NO_EFFECT.format(question.parameter, what, least, greatest, unit, number(self.scanned[0].result))
            lines += sentence(words)
        if self.unknown:
            at = ", ".join(f"{each.x:.9g}" for each in self.unknown)
            lines += sentence(UNKNOWN.format(question.parameter, at))
        elif not self.zeros and self.changes:
            words = NO_CHANGE.format(question.scan)
            lines += sentence(words)
        return [*lines, f"  {counted(len(self.answers), 'value')}, {counted(self.solves, 'solve')}"]


PRESSURE = (
    "Pressure in all joints, as of water, that is carried with the dead load, in the units of the deck; where it is "
    "negative, the dead load alone is not carried."
)
ASKED = {"stands": "the dead load is just carried", "falls": "a block begins to fall"}
"""what is looked for, without a figure"""
CHAOS = (
    "In time a stronger motion may do less: this holds at the values looked at, between which, below and above it may "
    "be otherwise. A finer --scan looks at more of them."
)
FIRST = "It is the first on the way up: nothing above {} was looked at."
SCATTERS = ", between which the result scatters"
NO_CHANGE = (
    "Nothing was found: the result is on one side of the target at both ends of every step ({} from bound to bound). "
    "Other bounds or a finer --scan may find it."
)
NO_EFFECT = "{} has no effect on the {} between {} and {}{}, as far as the values above show: it is {} at all of them."
UNKNOWN = (
    "There is no result for {} = {}: values next to it may be missed. Other bounds or a finer --scan may find them."
)


def _row(each: Evaluation) -> list[str]:
    figures = ["-" if math.isnan(value) else f"{value:.7g}" for value in (each.result, each.slope)]
    return [f"{each.x:.9g}", *figures, each.status, "" if each.verified or not each.solves else "not verified"]


def _sure(zero: Zero[Evaluation]) -> bool:
    """Whether the search came to its end and the answer that counts is verified: of jump or stretch both ends."""
    answers = zero.bracket if zero.jumps else zero.stretch or (zero.best,)
    return zero.complete and all(each.verified for each in answers)


def _answer_json(answer: Evaluation) -> dict[str, Any]:
    names = ("result", "slope", "status", "verified", "words", "bounds")
    return {name: as_json(getattr(answer, name)) for name in names} | {"known": as_json(answer.uncertainty)}


def _found_words(question: FindQuestion, zero: Zero[Evaluation], standing: StandingResult | None) -> str:
    """Value or stretch, error, which way the result goes, and how sure it is."""
    says = _value_words(question, zero, standing) if zero.stretch is None else _stretch_words(question, zero, standing)
    if not zero.complete:
        return f"{says}. The search did not come to its end: nothing narrower is known."
    last = "answers at its ends are" if zero.stretch and zero.stretch[0] is not zero.stretch[1] else "last answer is"
    says += f". The {last} {'verified' if _sure(zero) else 'NOT verified'}"
    return f"{says}; mbla run --set {question.parameter}={zero.best.x!r} shows it."


def _value_words(question: FindQuestion, zero: Zero[Evaluation], standing: StandingResult | None) -> str:
    first, last = sorted(zero.bracket, key=lambda each: each.x)
    unit = f" {question.unit}" if question.unit else ""
    name, stands = question.parameter, question.kind == "stands"
    says = f"{name} between {first.x:.9g} and {last.x:.9g}{unit}"
    if question.in_time and zero.jumps:
        return f"{says}: at {first.x:.9g} {_in_time(first)}, at {last.x:.9g} {_in_time(last)}"
    if zero.jumps and not stands:
        ends = f"{_side(first)} to {_side(last)}"
        says += f": there the result jumps over the target, from {ends}; no value gives {number(question.target)}"
    elif zero.complete and not zero.jumps:
        says = f"{name} = {zero.best.x:.9g}{unit}, within {small(zero.error)} by "
        says += "the values around it" if math.isnan(zero.best.slope) else "the slope there"
        says += SCATTERS if math.isnan(zero.best.slope) and zero.error > question.absolute_tolerance else ""
    side = "above" if zero.rises else "below"
    if standing is not None and standing.verdict is not Standing.YES:
        says += f"; {side} {_no_limit(standing)}"
    elif stands:
        says += f"; it stands {side}"
    elif not zero.jumps:
        says += f"; the result {'rises' if zero.rises else 'falls'} with it"
    return says


def _stretch_words(question: FindQuestion, zero: Zero[Evaluation], standing: StandingResult | None) -> str:
    assert zero.stretch is not None
    first, last = zero.stretch
    unit, name = f" {question.unit}" if question.unit else "", question.parameter
    touches = "touches the target without passing it" if zero.complete else "meets the target"
    says, ends = f"{name} = {first.x:.9g}{unit}: there the result {touches}", "it is"
    if first is not last:
        says = (
            f"every {name} from {first.x:.9g} to {last.x:.9g}{unit} meets the target, as far as the values above show"
        )
        inner = [each.x for each in zero.stretch if each.x not in question.bounds]
        ends = "both ends are" if len(inner) == 2 else f"the end at {inner[0]:.9g} is" if inner else ""
    says += f"; {ends} known within {small(zero.error)}" if zero.complete and ends else ""
    return says if standing is None or standing.verdict is Standing.YES else f"{says}; {_no_limit(standing)}"


def _no_limit(standing: StandingResult) -> str:
    return f"some forces carry the dead load, but {standing.reason}; so this is no limit of standing"


def _in_time(answer: Evaluation) -> str:
    """What a structure does in time."""
    if math.isnan(answer.result):
        return "it does not stand at rest"
    return (
        "it falls" if math.isinf(answer.y) and answer.y > 0.0 else f"it stands, with a peak of {number(answer.result)}"
    )


def _side(answer: Evaluation) -> str:
    """A result in words."""
    return answer.status if math.isnan(answer.result) else number(answer.result)


def find(deck: Deck, options: Any) -> FindResult:
    """Look for the values that the deck or the options ask for.

    Raises UsageError: the question is not complete, or names what the deck does not have. Raises DeckError: the deck is
    refused as it stands, and at every step. Raises SolverError, LimitError: as a run does.
    """
    question = question_of(deck, options)
    answers, contacts = list[Evaluation](), KnownContacts()

    def at(x: float) -> Evaluation:
        answers.append(answer_at(deck, question, x, contacts))
        return answers[-1]

    samples = (scan_to_first if question.first else scan)(*question.bounds, question.scan, at)
    if all(each.status == REFUSED for each in samples):
        refuse_unfit_deck(deck, question)
    zeros = tuple(find_zeros(samples, at, question.absolute_tolerance))
    asked = zeros if question.kind == "stands" else ()
    standing = tuple(standing_at(deck, question, _standing_side(zero, question)) for zero in asked)
    return FindResult(question, tuple(answers), zeros, tuple(samples), standing)


def _standing_side(zero: Zero[Evaluation], question: FindQuestion) -> float:
    """A value that stands, if some do, as near to the limit as that is asked for."""
    limit, stands = zero.best.x, zero.bracket[1].x
    if zero.stretch is not None:
        return limit
    if not zero.complete or zero.jumps:
        return stands
    return limit + math.copysign(min(question.absolute_tolerance, abs(stands - limit)), stands - limit)
