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

from mbla.deck import read_deck
from mbla.studies.tradeoff.ladder import usual_ladder
from mbla.studies.tradeoff.ladder_run import Limits
from mbla.studies.tradeoff.rung import Rung
from mbla.studies.tradeoff.study import Study, study_deck
from tests.decks.tradeoff_pictures import write_pictures
from tests.decks.tradeoff_record import FOLDER, Entry, entries_of, read_entries, write_entries
from tests.decks.tradeoff_text import page_text
from tests.performance.recording import machine, versions
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET, Structure

RUN_LIMIT = 60.0
"""seconds after which a rung is stopped"""
LEFT_OUT = ("the deck's own settings", "tolerance: 1e-4", "tolerance: 1e-10", "points per edge: 3")
"""rungs of the usual ladder that tell nothing more here"""
LARGE = ("60 x 60", "40 x 40", "500 voussoirs")
"""structures under which only the presets and what they are made of are run"""
FEW = {"associative": ("accuracy: ", "form: ", "solver: "), "non_associative": ("accuracy: ",)}
"""beginnings of the names of those rungs"""


def rungs_for(structure: Structure, rule: str) -> list[Rung]:
    """The important rungs of the usual ladder."""
    fixed = overrides_of(structure, rule)
    rungs = [rung for rung in usual_ladder(read_deck(structure.deck, fixed), fixed) if rung.name not in LEFT_OUT]
    rungs = [rung for rung in rungs if not rung.unfit and rung.name != f"flow_rule: {rule}"]
    if any(name in structure.name for name in LARGE):
        return [rung for rung in rungs if rung.name.startswith(FEW[rule])]
    return rungs


def overrides_of(structure: Structure, rule: str) -> tuple[str, ...]:
    """What makes the deck the structure of the set."""
    return (*structure.overrides, f"analysis.flow_rule={rule}")


def measure(structure: Structure, rule: str, limits: Limits) -> Study:
    """Run the rungs of one structure with one flow rule, as ``mbla tradeoff`` does."""
    fixed = overrides_of(structure, rule)
    rungs = rungs_for(structure, rule)
    deck = read_deck(structure.deck, fixed)
    return study_deck(deck, fixed, (structure.load_case,), rungs, 1e-4, limits, _tell)


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
    parser.add_argument("--run-limit", type=float, default=RUN_LIMIT, metavar="S", help="seconds for each rung")
    parser.add_argument("--time-limit", type=float, metavar="S", help="seconds after which no structure is begun")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page")
    options = parser.parse_args()
    until = time.monotonic() + (options.time_limit or float("inf"))
    entries = read_entries()
    for structure, rule in [] if options.page else chosen(options.names, entries):
        if time.monotonic() > until:
            sys.stdout.write(f"not begun: {structure.name}, {rule}\n")
            continue
        sys.stdout.write(f"{structure.name}, {rule}\n")
        study = measure(structure, rule, Limits(None, options.run_limit, 1))
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
