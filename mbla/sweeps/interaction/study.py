"""``mbla interact``: a sweep over an angle, its table, diagram and what the points prove together."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.findings import contacts_of
from mbla.deck import Deck
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.process.run_options import RunOptions
from mbla.results.failures import SIGNALS
from mbla.results.files import OutputFolder
from mbla.results.record.json_values import number
from mbla.results.record.keys import Key
from mbla.sweeps.design.directions import FULL_CIRCLE
from mbla.sweeps.engine.engine import Engine, EngineOptions, engine_for
from mbla.sweeps.interaction.domain import (
    NAN,
    POWER,
    RESULTS,
    Domain,
    Extreme,
    Point,
    domain_of,
    everywhere,
    extremes,
    point_of,
)
from mbla.sweeps.interaction.picture import draw_study
from mbla.sweeps.interaction.question import (
    DIRECTION,
    TWO_LOADS,
    Question,
    direction_question,
    two_loads_question,
)
from mbla.sweeps.interaction.words import conclusions
from mbla.sweeps.plan import Outcome
from mbla.sweeps.studies import (
    NOT_SOLVED,
    Study,
    about,
    plan_of,
    rows_json,
    solved,
    study_record,
    study_table,
    tasks_of,
    with_columns,
    written_study,
)
from mbla.sweeps.tables.sweep_table import SweepColumn

DIRECTIONS, ANGLES = 72, 31
"""points unless their number is given: every 5 degrees around, every 3 degrees of a quarter"""
MOST_POINTS = 3600
QUARTER = 90.0
GRAVEST_FIRST = (1, 6, 7, 3, 4)
"""exit codes of points that were not answered"""
NO_FACTOR = 5
Report = Callable[[int, int], None]
"""called with the points done and all points"""


@dataclass(frozen=True)
class Interaction(Study):
    """Every point of the diagram, and what they say together.

    domain : of associative flow; None where the points do not lie in the plane of two loads
    """

    question: Question
    points: tuple[Point, ...]
    domain: Domain | None

    @property
    def exit_code(self) -> int:
        """130 or 143 where it was interrupted or terminated, 4 where bounds cross, 5 without any load factor.

        Before the last two come points without a verified answer, with the gravest of their codes.
        A direction in which the load never brings collapse is an answer, as a position of a travelling load is.
        """
        if self.stop:
            return self.stop
        codes = {point.exit_code for point in self.points if not point.answered}
        if codes:
            return next((code for code in GRAVEST_FIRST if code in codes), max(codes))
        if self.domain is not None and self.domain.crossings:
            return 4
        return 0 if any(point.has_factor for point in self.points) else NO_FACTOR


def interact(
    deck: Deck, run: RunOptions, options: Any, report: Report | None
) -> tuple[Interaction, dict[str, Any], list[str]]:
    """Solve the points of a diagram and write the files; the study, its JSON record, and remarks.

    options : ``case`` or ``loads`` (two names), ``directions``, ``start`` and ``end`` in degrees, None unless given;
              ``jobs``, how many processes solve points

    Raises
    ------
    DeckError, UsageError
        The deck is not valid, or cannot be asked this; nothing is written then.
    FileError
        Files are in the way or cannot be written.
    """
    engine = engine_for(EngineOptions(workers=options.jobs))
    question = question_of(deck, options)
    loads = question.pair if question.kind == TWO_LOADS else ()
    stem = "_".join((deck.path.stem, "interact", *loads))

    def solve() -> Interaction:
        asked = question
        with engine as workers:
            if asked.kind == TWO_LOADS:
                asked = question_of(deck, options, factor_ratio(deck, run.overrides, options, workers))
            return study_points(deck, run.overrides, asked, workers, report)

    def draw(folder: OutputFolder, ending: str, study: Interaction) -> None:
        with folder.writing(f"{stem}.{ending}") as path:
            draw_study(path, study)

    return written_study(OutputFolder(run.folder_for(deck.path), stem, run.force, beside=True), solve, draw, study_json)


def factor_ratio(deck: Deck, overrides: Sequence[str], options: Any, workers: Engine) -> float:
    """Load factor of the second load alone over that of the first; 1 where either has none.

    Raises KeyboardInterrupt or Terminated where such a signal stopped it.
    """
    alone = copy(options)
    alone.start, alone.end, alone.directions = 0.0, QUARTER, 2
    study = study_points(deck, overrides, question_of(deck, alone), workers, None)
    if study.stop:
        raise next(kind for kind, (status, _) in SIGNALS.items() if status == study.stop)
    factors = [point.load_factor if point.has_factor else 0.0 for point in study.points]
    return factors[1] / factors[0] if min(factors) > 0 else 1.0


def question_of(deck: Deck, options: Any, ratio: float = 1.0) -> Question:
    """What is asked of a deck; building the model here finds whatever is wrong with it before a point is solved.

    ratio : of two loads, as ``factor_ratio`` gives it

    Raises
    ------
    DeckError
        for what is wrong with the deck
    UsageError
        for options that do not go together, and for load cases of which it cannot be asked
    """
    model = build_model(deck)
    contacts_of(deck, model)
    if options.loads is None:
        if options.start is not None or options.end is not None:
            raise UsageError("interact-option", "--from and --to apply with --loads; directions go all around")
        return direction_question(deck, options.case or "", _count(options.directions, DIRECTIONS, 1))
    if options.case:
        raise UsageError("interact-option", "--case and --loads: one or the other; --loads names the two load cases")
    start = 0.0 if options.start is None else options.start
    end = start + QUARTER if options.end is None else options.end
    if not start < end <= start + FULL_CIRCLE:
        raise UsageError(
            "interact-option", f"--from {start:g} --to {end:g}: the end must lie above, by 360 degrees at most"
        )
    first, second = options.loads
    count = _count(options.directions, ANGLES, 2)
    return two_loads_question(deck, model, (first, second), start, end, count, ratio)


def _count(given: int | None, usual: int, least: int) -> int:
    count = usual if given is None else given
    if not least <= count <= MOST_POINTS:
        raise UsageError("interact-option", f"--directions {count}: {least} to {MOST_POINTS} points")
    return count


def study_points(
    deck: Deck, overrides: Sequence[str], question: Question, engine: Engine, report: Report | None
) -> Interaction:
    """Solve every point of a question; ``overrides`` are those that the deck was read with.

    An interruption ends it with the points solved until then; one before the first is raised. Raises as the engine
    does.
    """
    started = time.perf_counter()
    results = (*RESULTS, *(POWER + name for name in question.pair))
    plan = plan_of(deck, (*overrides, *question.fixed), (question.case,), results)
    count = len(question.settings)
    told = None if report is None else lambda done: report(done, count)
    outcomes, stop = solved(engine, plan, tasks_of(plan, question.settings), deck, told)
    points = tuple(_point(angle, outcomes.get(n), stop) for n, angle in enumerate(question.angles, 1))
    of = about(deck, overrides)
    name = "azimuth" if question.kind == DIRECTION else "angle"
    words = "from +x towards +y" if question.kind == DIRECTION else "of two loads: A times cosine, B times sine"
    angle = SweepColumn(name, "degree", words, "float", "azimuth", name)
    return Interaction(
        about=of,
        question=question,
        points=points,
        table=with_columns(study_table(of, angle, question.angles, plan, outcomes), _factors(question, points)),
        domain=domain_of(points, question.pair, closed=question.closed) if question.pair else None,
        stop=stop,
        seconds=time.perf_counter() - started,
    )


def _point(angle: float, outcome: Outcome | None, stop: int) -> Point:
    if outcome is None:
        return Point(angle, False, stop, "", NAN, NAN, NAN, NAN, reason=NOT_SOLVED)
    return point_of(angle, outcome)


def _factors(question: Question, points: Sequence[Point]) -> list[tuple[SweepColumn, FloatArray]]:
    """The load factor along both axes of the diagram."""
    places = np.array([point.at(point.load_factor) for point in points]).reshape(-1, 2)
    return [
        (SweepColumn(f"factor_{name}", "", f"{axis}: load factor times {part}", "float", "result"), places[:, row])
        for row, (name, axis, part) in enumerate(zip(question.short, question.axes, ("cosine", "sine"), strict=True))
    ]


def study_json(study: Interaction, files: tuple[str, ...] = ()) -> dict[str, Any]:
    """The record that ``--json`` prints and ``STEM_interact.json`` holds; ``points`` are the rows of the table."""
    ends, question = extremes(study.points), study.question
    azimuth = "from +x towards +y" if question.absolute else "turned from the deck's directions"
    own = {
        "kind": question.kind,
        "case": question.case if question.kind == DIRECTION else None,
        "loads": list(question.pair) if question.kind == TWO_LOADS else None,
        "azimuth": azimuth if question.kind == DIRECTION else None,
        "axes": list(question.axes),
        "closed": question.closed,
        "points": rows_json(study.table),
        "least": None if ends is None else _extreme_json(ends[0]),
        "greatest": None if ends is None else _extreme_json(ends[1]),
        "domain": None if study.domain is None else _domain_json(study, study.domain),
        "words": [*question.words, *conclusions(study)],
    }
    return study_record(study, own, files)


def _extreme_json(extreme: Extreme) -> Mapping[str, Any]:
    return {"load_factor": extreme.load_factor, "angles": list(extreme.angles)}


def _domain_json(study: Interaction, domain: Domain) -> Mapping[str, Any]:
    return {
        "flow_rule": "associative",
        "inner": (domain.inner + 0.0).tolist(),
        "outer": (domain.outer + 0.0).tolist(),
        "cut_off": domain.cut_off,
        "gap": number(domain.gap),
        "convex": not domain.crossings,
        "crossings": [{"angle": one.angle, "safe": one.safe, "share": number(one.share)} for one in domain.crossings],
        "least_everywhere": everywhere(domain, closed=study.question.closed),
    }


INTERACT_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("deck", "string", "file name of the deck"),
    Key("title", "string", "title of the deck"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status: that of the gravest point; 5 where no point has a load factor"),
    Key("set", "list", "values that `--set` and the like changed in the deck, `key.path=value`"),
    Key("flow_rule", "string", "as of the deck"),
    Key("units", "object", "length, force and mass of the deck"),
    Key("provenance", "object", "versions and machine, as of the result files"),
    Key("kind", "string", "`direction` or `two_loads`"),
    Key("case", "string?", "load case whose live load is turned; null for two loads"),
    Key("loads", "list?", "names of the two load cases; null for directions"),
    Key(
        "azimuth", "string?", "from what directions are counted: from +x, or from those of the deck; null for two loads"
    ),
    Key("axes", "list", "what the two axes of the diagram are, in words"),
    Key("closed", "boolean", "the angles go all around"),
    Key("points", "list", "rows of the table, in the order of their angles; values by the names of its columns"),
    Key("least", "object?", "least load factor of the points, `load_factor`, and its `angles` in degrees"),
    Key("greatest", "object?", "greatest load factor of the points, likewise"),
    Key("domain", "object?", "what the bounds of associative flow prove together; null where no point has bounds"),
    Key("domain.flow_rule", "string", "associative"),
    Key("domain.inner", "list", "corners of the convex hull of safe points, factors along the axes"),
    Key("domain.outer", "list", "corners of what the half-planes of all mechanisms leave"),
    Key("domain.cut_off", "boolean", "the outer polygon ends at an edge that no mechanism draws"),
    Key("domain.gap", "number?", "area between the polygons over that of the outer one; null where it is not bounded"),
    Key("domain.convex", "boolean", "no safe point lies beyond a bound"),
    Key(
        "domain.crossings",
        "list",
        "safe points beyond bounds, which must not be: ray of the bound (`angle`), angle of the point (`safe`), "
        "relative distance (`share`)",
    ),
    Key("domain.least_everywhere", "number?", "load factor carried at every angle, also between the points"),
    Key("words", "list", "what was asked and what follows, in sentences"),
    Key("time", "number", "seconds by the clock, of the whole"),
    Key("files", "list", "names of the files of the diagram"),
)
