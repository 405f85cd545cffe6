"""Points made by hand for the tests of journals: results of every kind and of very different length."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from mbla.sweeps.journal import JournalHeader
from mbla.sweeps.plan import DONE, FAILED, Plain, PointOutcome, Task

HEADER = JournalHeader(
    {"base deck": "f00d", "load cases": "push", "mbla": "0.1.0+abc", "numpy": "2.3.0"},
    {"status": "text", "load_factor": "float", 'a,"b"#': "int", "verified": "bool"},
)


def other_header(**changes: str) -> JournalHeader:
    """That of another sweep; low lines in names are spaces."""
    return replace(HEADER, belongs={**HEADER.belongs, **{key.replace("_", " "): changes[key] for key in changes}})


LENGTHS = (0, 3, 3, 40, 40, 400, 4000)
"""of the texts of a point"""


def point(number: int) -> tuple[Task, PointOutcome]:
    """Point of this number, always the same one."""
    draw = Random(number)
    key = f"{draw.getrandbits(128):032x}"
    text = "".join(draw.choice('aö",#\n\\[{ ') for _ in range(draw.choice(LENGTHS)))
    values: dict[str, list[Plain]] = {
        "text": [None, text],
        "float": [None, draw.gauss(0, 1), 1e300 * draw.random(), 0.1],
        "int": [None, 7, -1],
        "bool": [None, True, False],
    }
    failed = draw.random() < 0.2
    results = {} if failed else {name: draw.choice(values[kind]) for name, kind in HEADER.columns.items()}
    task = Task(key, number, {"parameters.mu": draw.random(), "title": text})
    return task, PointOutcome(
        key, FAILED if failed else DONE, 4 if failed else 0, text if failed else "", results, 1, draw.random()
    )


def as_read(outcome: PointOutcome) -> PointOutcome:
    """The outcome as a journal gives it back: with every column, texts in one line."""

    def plain(value: Plain) -> Plain:
        return (" ".join(value.split()) or None) if isinstance(value, str) else value

    results = {name: plain(outcome.results.get(name)) for name in HEADER.columns}
    return replace(outcome, results=results, reason=" ".join(outcome.reason.split()))
