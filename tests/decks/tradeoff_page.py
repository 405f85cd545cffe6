"""The measured trade of the standard set: decks/tradeoff/measured.csv, README.md and pictures.

``python -m tests.decks.tradeoff_page [--run-limit S] [--time-limit S] [NAME ...]`` measures the structures of those
names (parts of names do), all without, and renews their rows in measured.csv; then it writes the page from that file.
``--page`` only writes the page. A structure is stored as soon as it is measured, so that nothing is lost when it is
stopped; with a time limit those that were measured longest ago, or never, come first.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from datetime import UTC, datetime

from mbla.deck import Deck, read_deck
from mbla.sweeps.tradeoff.ladder import fitted
from mbla.sweeps.tradeoff.ladder_run import Limits, RungRun, run_ladder
from mbla.sweeps.tradeoff.rung import Rung
from mbla.sweeps.tradeoff.study import Study, study_deck, study_of, traded_cases
from tests.decks.tradeoff_pictures import write_pictures
from tests.decks.tradeoff_plan import overrides_of, plan_of, rungs_for
from tests.decks.tradeoff_record import FOLDER, Entry, entries_of, read_entries, write_entries
from tests.decks.tradeoff_text import page_text
from tests.performance.recording import machine, versions
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET, Structure

WANTED = 1e-4
"""error for which a study advises; the page has no advice"""


def measure(structure: Structure, rule: str, run_limit: float | None = None) -> Study:
    """Run what is planned for one structure with one flow rule, as ``mbla tradeoff`` does."""
    fixed, plan = overrides_of(structure, rule), plan_of(structure, rule)
    deck = read_deck(structure.deck, fixed)
    limits = Limits(None, run_limit or plan.limit, 1)
    rungs = rungs_for(structure, rule)
    if not plan.in_turn:
        return study_deck(deck, fixed, (structure.load_case,), rungs, WANTED, limits, _tell)
    started = time.perf_counter()
    runs = _in_turn(deck, structure, rule, rungs, limits)
    cases = traded_cases(deck, (structure.load_case,))
    return study_of(deck, fixed, cases, runs, WANTED, limits, time.perf_counter() - started)


def _in_turn(deck: Deck, structure: Structure, rule: str, rungs: Sequence[Rung], limits: Limits) -> list[RungRun]:
    """Each with a process of its own; none after one that was stopped, as it would take longer still."""
    fixed = overrides_of(structure, rule)
    runs: list[RungRun] = []
    for rung in fitted(deck.path, fixed, deck, rungs):
        stopped = next((run for run in runs if run.end == "stopped"), None)
        if stopped is not None:
            runs.append(RungRun(rung, (), "not run", f"not tried, as {stopped.rung.name} was {stopped.words}"))
        else:
            runs += run_ladder(deck.path, fixed, (structure.load_case,), [rung], limits, _tell)
    return runs


def chosen(names: Sequence[str], entries: Sequence[Entry]) -> list[tuple[Structure, str]]:
    """Structures and flow rules to be measured, those measured longest ago or never first."""
    pairs = [
        (structure, rule)
        for structure in STANDARD_SET
        for rule in FLOW_RULES
        if not names or any(name in f"{structure.name}, {rule}" for name in names)
    ]
    last = {(entry.structure, entry.flow_rule): entry.date for entry in entries}
    return sorted(pairs, key=lambda pair: last.get((pair[0].name, pair[1]), ""))


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--run-limit", type=float, metavar="S", help="seconds for each rung (default: as planned)")
    parser.add_argument("--time-limit", type=float, metavar="S", help="seconds after which no structure is begun")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page")
    options = parser.parse_args()
    started = time.monotonic()
    entries = read_entries()
    for structure, rule in [] if options.page else chosen(options.names, entries):
        if options.time_limit and time.monotonic() - started > options.time_limit:
            sys.stdout.write(f"not begun: {structure.name}, {rule}\n")
            continue
        sys.stdout.write(f"{structure.name}, {rule}\n")
        study = measure(structure, rule, options.run_limit)
        sys.stdout.write(f"  {study.seconds:.0f} s, {time.monotonic() - started:.0f} s in all\n")
        date = datetime.now(UTC).isoformat(timespec="seconds")
        new = entries_of(study, structure, rule, date, versions(), machine())
        entries = [*(e for e in entries if (e.structure, e.flow_rule) != (structure.name, rule)), *new]
        write_entries(entries)
        entries = read_entries()
    (FOLDER / "README.md").write_text(page_text(entries), encoding="utf-8")
    write_pictures(entries)


def _tell(number: int, count: int, name: str, case: str) -> None:
    if not case:
        sys.stdout.write(f"  {number}/{count} {name}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
