"""How answers that are no value are shown, and counted in words."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.results.pictures.palette import GHOST, INK, PURPLE, WARNING
from mbla.sweeps.answers import Answer, Answers
from mbla.sweeps.results import STATUS


@dataclass(frozen=True)
class Mark:
    """How an answer that is no value is shown: words of legends and notes, marker, colour, hatch of cells."""

    words: str
    marker: str
    colour: str
    hatch: str


MARKS = {
    Answer.UNVERIFIED: Mark("not verified", "o", WARNING, "xx"),
    Answer.NO_EQUILIBRIUM: Mark("no equilibrium (does not stand)", "v", INK, "///"),
    Answer.UNBOUNDED: Mark("unbounded (no collapse)", "^", PURPLE, 3 * "\\"),
    Answer.NONE: Mark("has no such value", "|", GHOST, "--"),
    Answer.FAILED: Mark("failed", "x", WARNING, "xx"),
    Answer.NOT_RUN: Mark("not solved yet", ".", GHOST, "oo"),
    Answer.MIXED: Mark("different from point to point", "d", GHOST, "++"),
    Answer.PARTLY: Mark("some points without a verified value", "o", WARNING, "//"),
}


def count_words(answers: Answers) -> str:
    """``48 points: 40 with a verified value, 5 no equilibrium (does not stand), 3 failed``."""
    total = len(answers.answer)
    counts = [(answers.of(answer).sum(), mark.words) for answer, mark in MARKS.items()]
    known = "with a value" if answers.column.path == STATUS else "with a verified value"
    parts = [f"{answers.good.sum()} {known}", *(f"{count} {words}" for count, words in counts if count)]
    return f"{total} point{'s' * (total != 1)}: {', '.join(parts)}"
