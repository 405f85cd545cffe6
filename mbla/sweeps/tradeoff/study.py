"""The study of one deck: table of contents of ``mbla tradeoff``."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mbla.deck import Deck
from mbla.deck.units import Units
from mbla.errors import LimitError, SolverError, UsageError
from mbla.model import build_model
from mbla.results.failures import SIGNALS
from mbla.results.provenance import collect_provenance
from mbla.results.results import now
from mbla.run import contacts_of, select_cases, title_of
from mbla.sweeps.tradeoff.advice import Advice, advice
from mbla.sweeps.tradeoff.ladder import asked_ladder, fitted, usual_ladder
from mbla.sweeps.tradeoff.ladder_run import Limits, Report, RungRun, run_ladder
from mbla.sweeps.tradeoff.rung import REFERENCE, Rung
from mbla.sweeps.tradeoff.trade import CaseTrade, case_trades


@dataclass(frozen=True)
class Study:
    """Everything that was measured and what it says.

    overrides : ``--set`` of the command line, for every rung
    trades    : by load case, a travelling load as one
    advices   : by load case; then, with several, the one for all of them
    seconds   : by the clock, of the whole study
    """

    deck: str
    title: str
    overrides: tuple[str, ...]
    units: Units
    flow_rule: str
    wanted: float
    limits: Limits
    runs: tuple[RungRun, ...]
    trades: tuple[CaseTrade, ...]
    advices: tuple[Advice, ...]
    seconds: float
    provenance: dict[str, str]
    created: str = field(default_factory=now)

    @property
    def interrupted(self) -> bool:
        """Whether a signal ended the ladder before its end."""
        return self._signal is not None

    @property
    def _signal(self) -> int | None:
        """Exit status of the signal that ended it."""
        ends = {run.end for run in self.runs}
        return next((status for status, word in SIGNALS.values() if word in ends), None)

    @property
    def exit_code(self) -> int:
        """130, 143: a signal; 7: the time limit came before the reference; 4: no reference is verified; else 0."""
        if self._signal is not None:
            return self._signal
        reference = next((run for run in self.runs if run.rung.name == REFERENCE), None)
        if reference is not None and reference.expired:
            return LimitError.exit_status
        return 0 if all(trade.verified for trade in self.trades) else SolverError.exit_status


def study_deck(
    deck: Deck,
    fixed: Sequence[str],
    cases: Sequence[str],
    asked: Sequence[Rung],
    wanted: float,
    limits: Limits,
    report: Report | None = None,
) -> Study:
    """Run the ladder on a deck that was read with the overrides ``fixed``, and hold it against the reference.

    The time limit counts from here.

    Raises
    ------
    DeckError, UsageError
        The deck is not valid, there is no such load case, two settings have one name, or none applies.
    """
    started = time.perf_counter()
    names = traded_cases(deck, cases)
    ladder = asked_ladder(deck, fixed, asked) if asked else usual_ladder(deck, fixed)
    rungs = fitted(deck.path, fixed, deck, ladder)
    refuse_nothing_fit([rung for rung in rungs if rung.name in {own.name for own in asked}])
    left = None if limits.budget is None else max(limits.budget - (time.perf_counter() - started), 0.0)
    runs = run_ladder(deck.path, fixed, cases, rungs, Limits(left, limits.each, limits.threads), report)
    return study_of(deck, fixed, names, runs, wanted, limits, time.perf_counter() - started)


def refuse_nothing_fit(asked: Sequence[Rung]) -> None:
    """UsageError where settings were asked for and none of them applies: there would be nothing to compare."""
    if asked and all(rung.unfit for rung in asked):
        why = "; ".join(f"{rung.name}: {rung.unfit}" for rung in asked)
        raise UsageError("tradeoff-option", f"no setting that was asked for applies to the deck: {why}")


def study_of(
    deck: Deck,
    fixed: Sequence[str],
    cases: Sequence[tuple[str, int]],
    runs: Sequence[RungRun],
    wanted: float,
    limits: Limits,
    seconds: float,
) -> Study:
    """What the runs say."""
    trades = case_trades(cases, runs)
    advices = [advice([trade], wanted) for trade in trades]
    return Study(
        deck=deck.path.name,
        title=title_of(deck),
        overrides=tuple(fixed),
        units=deck.units,
        flow_rule=deck.analysis.flow_rule,
        wanted=wanted,
        limits=limits,
        runs=tuple(runs),
        trades=trades,
        advices=tuple([*advices, advice(trades, wanted)] if len(trades) > 1 else advices),
        seconds=seconds,
        provenance=collect_provenance(),
    )


def traded_cases(deck: Deck, names: Sequence[str]) -> tuple[tuple[str, int], ...]:
    """Load cases asked for, a travelling load as one with the number of its positions (0 for others).

    Building the model here finds whatever is wrong with the deck before a process is started.
    """
    model = build_model(deck)
    contacts_of(deck, model)
    found: dict[str, int] = {}
    for case in select_cases(model, names):
        name = case.name if case.travel is None else case.travel.series
        found[name] = found.get(name, 0) + (case.travel is not None)
    return tuple(found.items())


def file_name(deck: Path) -> str:
    """``STEM_tradeoff``, what the names of all files of a study begin with."""
    return f"{deck.stem}_tradeoff"
