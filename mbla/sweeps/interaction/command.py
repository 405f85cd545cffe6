"""``mbla interact``: from its options to the diagram and its files."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from pathlib import Path
from typing import Any

from mbla.deck import Deck
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.results.failures import SIGNALS
from mbla.results.files import OutputFolder
from mbla.run import contacts_of
from mbla.run_options import RunOptions
from mbla.sweeps.engine.choice import engine_for
from mbla.sweeps.engine.engine import Engine
from mbla.sweeps.engine.options import EngineOptions
from mbla.sweeps.interaction.angles import FULL
from mbla.sweeps.interaction.direction import direction_question
from mbla.sweeps.interaction.question import TWO_LOADS, Question
from mbla.sweeps.interaction.records import study_json
from mbla.sweeps.interaction.study import Report, Study, plan_of, study_points
from mbla.sweeps.interaction.two_loads import two_loads_question
from mbla.sweeps.interaction.write import write_study
from mbla.sweeps.measure.study_files import written

DIRECTIONS, ANGLES = 72, 31
"""points unless their number is given: every 5 degrees around, every 3 degrees of a quarter"""
MOST_POINTS = 3600
QUARTER = 90.0


def interact(
    deck: Deck, run: RunOptions, options: Any, report: Report | None
) -> tuple[Study, dict[str, Any], list[str]]:
    """Solve the points of a diagram and write the files; the study, its JSON record, and remarks.

    options : ``case`` or ``loads`` (two names), ``directions``, ``start`` and ``end`` in degrees, None unless given;
              ``jobs``, how many processes solve points

    One that was interrupted is written as far as it came, but never over an earlier one.

    Raises
    ------
    DeckError, UsageError
        The deck is not valid, or cannot be asked this; nothing is written then.
    FileError
        Files are in the way or cannot be written.
    """
    engine = engine_for(EngineOptions(workers=options.jobs))
    question = question_of(deck, options)
    stem = file_name(deck.path, question)
    out = OutputFolder(run.folder_for(deck.path), stem, run.force, beside=True)
    names = (f"{stem}.csv", f"{stem}.json")
    out.refuse(*names)
    with out:
        plan = plan_of(deck.path, run.overrides, question)
        engine.expect(plan, len(question.settings))
        with engine as workers:
            if question.kind == TWO_LOADS:
                question = question_of(deck, options, factor_ratio(deck, run.overrides, options, workers))
            study = study_points(deck, run.overrides, question, plan, workers, report)
        remarks = written(out, names, study.interrupted, lambda: write_study(study, out))
    return study, study_json(study, out.names), remarks


def file_name(deck: Path, question: Question) -> str:
    """``STEM_interact``, or ``STEM_interact_A_B`` of two loads; what the names of all files begin with."""
    loads = question.pair if question.kind == TWO_LOADS else ()
    return "_".join((deck.stem, "interact", *loads))


def factor_ratio(deck: Deck, overrides: Sequence[str], options: Any, workers: Engine) -> float:
    """Load factor of the second load alone over that of the first; 1 where either has none."""
    alone = copy(options)
    alone.start, alone.end, alone.directions = 0.0, QUARTER, 2
    question = question_of(deck, alone)
    study = study_points(deck, overrides, question, plan_of(deck.path, overrides, question), workers, None)
    if study.interrupted:
        raise next(kind for kind, (status, _) in SIGNALS.items() if status == study.exit_code)
    factors = [point.load_factor if point.has_factor else 0.0 for point in study.points]
    return factors[1] / factors[0] if min(factors) > 0 else 1.0


def question_of(deck: Deck, options: Any, ratio: float = 1.0) -> Question:
    """What is asked of a deck; building the model here finds whatever is wrong with it before a point is solved.

    ratio : of two loads, as ``factor_ratio`` gives it
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
    if not start < end <= start + FULL:
        raise UsageError(
            "interact-option", f"--from {start:g} --to {end:g}: the end must lie above, by 360 degrees at most"
        )
    first, second = options.loads
    count = _count(options.directions, ANGLES, 2)
    return two_loads_question(deck, model, (first, second), start, end, count, ratio)


def _count(asked: int | None, usual: int, least: int) -> int:
    count = usual if asked is None else asked
    if not least <= count <= MOST_POINTS:
        raise UsageError("interact-option", f"--directions {count}: {least} to {MOST_POINTS} points")
    return count
