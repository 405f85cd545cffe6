"""The diagram of one deck: table of contents of ``mbla interact``."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from mbla.deck import Deck
from mbla.deck.units import Units
from mbla.results.failures import SIGNALS, words_of
from mbla.results.provenance import collect_provenance
from mbla.results.results import now
from mbla.run import title_of
from mbla.sweeps.engine.engine import Engine
from mbla.sweeps.identity import fingerprint_of, key_hash, program_identity
from mbla.sweeps.interaction.domain import Domain, domain_of
from mbla.sweeps.interaction.point import NAN, POWER, RESULTS, Point, point_of
from mbla.sweeps.interaction.question import Question
from mbla.sweeps.plan import Plan, Task
from mbla.sweeps.reasons import shown_folders

STOPPED = tuple(status for status, _ in SIGNALS.values())
"""exit statuses of points that were not solved as a signal came before"""
NOT_SOLVED = "not solved: interrupted before"
"""reason of points that were not reached"""
GRAVEST_FIRST = (1, 6, 7, 3, 4)
"""exit codes of points that were not answered"""
NO_FACTOR = 5
Report = Callable[[int, int], None]
"""called with the points done and all points"""


@dataclass(frozen=True)
class Study:
    """Every point of the diagram, and what they say together.

    overrides : of the command line
    domain    : of associative flow; None where the points do not lie in the plane of two loads
    seconds   : by the clock
    """

    deck: str
    title: str
    overrides: tuple[str, ...]
    units: Units
    flow_rule: str
    question: Question
    points: tuple[Point, ...]
    domain: Domain | None
    seconds: float
    provenance: dict[str, str]
    created: str = field(default_factory=now)

    @property
    def heading(self) -> str:
        """Deck and title; the deck alone where it has no title."""
        return self.deck if self.title == self.deck else f"{self.deck}: {self.title}"

    @property
    def interrupted(self) -> bool:
        """Whether it ended before every point was solved."""
        return any(point.exit_code in STOPPED for point in self.points)

    @property
    def exit_code(self) -> int:
        """130 or 143 where it was interrupted or terminated, 4 where bounds cross, 5 without any load factor.

        Before the last two come points without a verified answer, with the gravest of their codes.
        A direction in which the load never brings collapse is an answer, as a position of a travelling load is.
        """
        if self.interrupted:
            return next(point.exit_code for point in self.points if point.exit_code in STOPPED)
        codes = {point.exit_code for point in self.points if not point.answered}
        if codes:
            return next((code for code in GRAVEST_FIRST if code in codes), max(codes))
        if self.domain is not None and self.domain.crossings:
            return 4
        return 0 if any(point.has_factor for point in self.points) else NO_FACTOR


def study_points(
    deck: Deck, fixed: Sequence[str], question: Question, plan: Plan, engine: Engine, report: Report | None
) -> Study:
    """Solve every point of a question; ``fixed`` are the overrides that the deck was read with.

    An interruption ends it with the points solved until then; one before the first is raised.

    Raises as the engine does.
    """
    started = time.perf_counter()
    tasks = tasks_of(question, plan.fingerprint)
    numbers = {task.key: task.number for task in tasks}
    shown = shown_folders(plan, deck.path.name)
    points: dict[int, Point] = {}
    stop = 0
    with closing(engine.run(plan, tasks)) as outcomes:
        try:
            for outcome in map(shown.in_outcome, outcomes):
                number = numbers[outcome.key]
                points[number] = point_of(question.angles[number - 1], outcome)
                if report is not None:
                    report(len(points), len(tasks))
        except tuple(SIGNALS) as error:
            if not points:
                raise
            stop, _ = words_of(error)
    ordered = tuple(points.get(task.number) or _not_solved(question.angles[task.number - 1], stop) for task in tasks)
    domain = domain_of(ordered, question.pair, closed=question.closed) if question.pair else None
    return Study(
        deck=deck.path.name,
        title=title_of(deck),
        overrides=tuple(fixed),
        units=deck.units,
        flow_rule=deck.analysis.flow_rule,
        question=question,
        points=ordered,
        domain=domain,
        seconds=time.perf_counter() - started,
        provenance=collect_provenance(),
    )


def _not_solved(angle: float, stop: int) -> Point:
    return Point(angle, False, stop, "", NAN, NAN, NAN, NAN, reason=NOT_SOLVED)


def tasks_of(question: Question, fingerprint: str) -> list[Task]:
    """One task for each angle; no two angles are one point."""
    return [
        Task(key_hash(fingerprint, settings, ()), number, settings)
        for number, settings in enumerate(question.settings, 1)
    ]


def plan_of(path: Path, overrides: Sequence[str], question: Question) -> Plan:
    """What the points have in common; ``overrides`` are those of the command line."""
    fixed = (*overrides, *question.fixed)
    return Plan(
        deck=str(path.resolve()),
        fingerprint=fingerprint_of(path, fixed),
        fixed=fixed,
        cases=(question.case,),
        results=(*RESULTS, *(POWER + name for name in question.pair)),
        keep="none",
        folder=str(path.resolve().parent),
        time_limit=None,
        memory_limit=None,
        program=program_identity(),
    )
