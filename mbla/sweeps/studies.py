"""Sweeps that a command makes of a deck by itself, without a sweep file, over one parameter: an angle, or a setting."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from mbla.deck import Deck
from mbla.process.run_options import RunOptions
from mbla.results.listing.text import INDENT
from mbla.sweeps.command import Prepared, SweepOptions
from mbla.sweeps.design.design import Design, DesignDimension, DesignPoint
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.identity import fingerprint_of
from mbla.sweeps.journal import SINGLE
from mbla.sweeps.plan import Plain, Plan
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable
from mbla.sweeps.tables.write_tables import StudyResult, refuse_tables


def study_options(deck: Deck, run: RunOptions, name: str, engine: EngineOptions) -> SweepOptions:
    """Where the files of a study go, ``DECK_NAME.out`` unless that is given; one that was broken off is continued.

    Raises FileError where an earlier study is in the way.
    """
    folder = run.folder or deck.path.with_name(f"{deck.path.stem}_{name}.out")
    refuse_tables(folder, (), replace=run.force)
    resume = not run.force and (folder / SINGLE).exists()
    return SweepOptions(folder, engine, resume=resume, force=run.force, goes_on="the same command continues")


def study_plan(deck: Deck, fixed: Sequence[str], cases: Sequence[str], results: Sequence[str], folder: Path) -> Plan:
    """The plan of a sweep over a deck that was read with the overrides ``fixed``."""
    base, fingerprint = str(deck.path.resolve()), fingerprint_of(deck.path, fixed)
    return Plan(base, fingerprint, tuple(fixed), tuple(cases), tuple(results), folder=str(folder.absolute()))


def prepared_study(
    deck: Deck,
    name: str,
    plan: Plan,
    column: SweepColumn,
    points: Mapping[Any, Mapping[str, Plain]],
    study_of: Callable[[SweepTable], StudyResult],
) -> Prepared:
    """The sweep over one parameter.

    column : of the parameter
    points : for each of its values, values by key path of the deck
    """
    made = tuple(DesignPoint(n, (n - 1,), (value,), own) for n, (value, own) in enumerate(points.items(), 1))
    design = Design((column,), (DesignDimension(column.dimension, len(made)),), made, (tuple(points),))
    return Prepared(name, deck.path.name, deck.title, deck, design, plan, study_of)


def heading_lines(deck: Deck) -> list[str]:
    """How the words of a study begin."""
    name = deck.path.name if deck.title == deck.path.name else f"{deck.path.name}: {deck.title}"
    return [name, f"{INDENT}flow rule {deck.analysis.flow_rule}"]
