"""Sweeps that a command makes of a deck by itself, without a sweep file, over one parameter: an angle, or a setting."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from mbla.deck import Deck
from mbla.process.run_options import RunOptions
from mbla.results.listing.text import INDENT
from mbla.sweeps.command import Prepared, SweepOptions
from mbla.sweeps.design.design import Design, DesignDimension, DesignPoint
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.identity import PointKeys, fingerprint_of, path_in, program_identity
from mbla.sweeps.journal import SINGLE
from mbla.sweeps.plan import Plain, Plan
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable
from mbla.sweeps.tables.write_tables import StudyResult, TableFiles, refuse_tables


def study_options(deck: Deck, run: RunOptions, name: str, engine: EngineOptions) -> SweepOptions:
    """Where the files of a study go, ``DECK_NAME.out`` unless that is given; one that was broken off is continued.

    Raises FileError where an earlier study is in the way.
    """
    folder = run.folder or deck.path.with_name(f"{deck.path.stem}_{name}.out")
    refuse_tables(folder, TableFiles(), replace=run.force)
    resume = not run.force and (folder / SINGLE).exists()
    return SweepOptions(folder, engine, resume=resume, force=run.force, goes_on="the same command continues")


def prepared_study(
    deck: Deck,
    name: str,
    fixed: Sequence[str],
    cases: Sequence[str],
    results: Sequence[str],
    folder: Path,
    column: SweepColumn,
    points: Mapping[Any, Mapping[str, Plain]],
    study_of: Callable[[SweepTable], StudyResult],
    time_limit: float | None = None,
    timed: bool = False,
) -> Prepared:
    """The sweep over one parameter of a deck that was read with the overrides ``fixed``.

    column             : of the parameter
    points             : for each of its values, values by key path of the deck
    time_limit, timed  : as of ``Plan``
    """
    plan = Plan(
        deck=str(deck.path.resolve()),
        fingerprint=fingerprint_of(deck.path, fixed),
        fixed=tuple(fixed),
        cases=tuple(cases),
        results=tuple(results),
        keep="none",
        folder=str(folder.absolute()),
        time_limit=time_limit,
        memory_limit=None,
        program=program_identity(),
        timed=timed,
    )
    keys = PointKeys(plan.fingerprint, deck.path.resolve().parent, partial(path_in, deck))
    made = tuple(DesignPoint(n, (n - 1,), (value,), own) for n, (value, own) in enumerate(points.items(), 1))
    return Prepared(
        name=name,
        deck=deck.path.name,
        title=deck.title,
        design=Design((column,), (DesignDimension(column.dimension, len(made)),), made, (tuple(points),)),
        keys=tuple(map(keys.of, points.values())),
        columns=result_columns(plan.results, plan.cases, deck.units),
        plan=plan,
        files=TableFiles(),
        study_of=study_of,
    )


def heading_lines(deck: Deck) -> list[str]:
    """How the words of a study begin."""
    name = deck.path.name if deck.title == deck.path.name else f"{deck.path.name}: {deck.title}"
    return [name, f"{INDENT}flow rule {deck.analysis.flow_rule}"]
