"""The page of the measured trade says what its record holds, and the record keeps what was measured."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from tests.decks.tradeoff_page import chosen, rungs_for
from tests.decks.tradeoff_record import FOLDER, Entry, read_entries, write_entries
from tests.decks.tradeoff_text import page_text
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET

ENTRY = Entry(
    STANDARD_SET[0].name,
    "associative",
    "accuracy: standard",
    "",
    "done",
    status="solved",
    verified=True,
    front=True,
    load_factor=0.65,
    distance=2e-6,
    resolution=1e-9,
    static_bound=0.64999,
    kinematic_bound=0.65001,
    residual=1e-8,
    time=0.5,
    solver_time=0.1,
    memory=12.0,
    iterations=33,
    date="2026-01-01T00:00:00+00:00",
)


def test_the_page_is_that_of_the_record() -> None:
    assert (FOLDER / "README.md").read_text(encoding="utf-8") == page_text(read_entries())


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    stopped = Entry(STANDARD_SET[1].name, "associative", "accuracy: draft", "", "stopped after 60 s")
    write_entries([stopped, ENTRY], tmp_path / "measured.csv")
    read = read_entries(tmp_path / "measured.csv")
    assert [entry.structure for entry in read] == [ENTRY.structure, stopped.structure]  # in the order of the set
    assert str(read) == str([ENTRY, stopped])


def test_rows_and_summary() -> None:
    twice = replace(ENTRY, rung="accuracy: reference", reference=True, front=False, distance=0.0, time=1.0)
    doubtful = replace(ENTRY, rung="accuracy: draft", distance=0.5, verified=False, front=False, status="not_verified")
    model = replace(ENTRY, rung="contact_model: convex", other_model="contact_model", front=False)
    stopped = Entry(ENTRY.structure, "associative", "form: static", "", "stopped after 60 s")
    text = page_text([ENTRY, twice, doubtful, model, stopped])
    row = "| 0.5 | 0.1 | 33 | 12.0 | 0.65 | 2.0e-06 | 0.64999 | 0.65001 | 1.0e-08 | "
    assert f"| accuracy: standard {row}front |" in text
    assert f"| contact_model: convex {row}other model: contact_model |" in text
    assert "| 5.0e-01 | 0.64999 | 0.65001 | 1.0e-08 | not verified |" in text
    assert "| form: static | - | - | - | - | - | - | - | - | - | stopped after 60 s |" in text
    name = ENTRY.structure
    assert f"| associative | standard | 1 | 1 | 2.0e-06 ({name}) | 2.0e-06 | 1.00 times | 0.5 s ({name}) |" in text
    assert f"| associative | reference | 1 | 1 | 1.0e-09 ({name}) | 1.0e-09 | 2.00 times | 1 s ({name}) |" in text
    assert "| associative | draft | 1 | 0 | - (-) | - | 1.00 times |" in text  # nothing verified, so no error
    assert f"Not measured yet: {name} (without dilatancy);" in text


def test_the_oldest_come_first() -> None:
    newer = replace(ENTRY, structure=STANDARD_SET[1].name, date="2026-02-01T00:00:00+00:00")
    order = [(structure.name, rule) for structure, rule in chosen([], [newer, ENTRY])]
    assert len(order) == len(STANDARD_SET) * len(FLOW_RULES)
    assert order[-2:] == [(ENTRY.structure, "associative"), (newer.structure, "associative")]
    assert {s.name for s, _ in chosen(["dome"], [])} == {"dome"}


def test_every_structure_has_the_presets() -> None:
    """Among its rungs; walls of 60 x 60 have few others."""
    for structure in (STANDARD_SET[0], STANDARD_SET[4], STANDARD_SET[-1]):
        for rule in FLOW_RULES:
            names = {rung.name for rung in rungs_for(structure, rule)}
            assert {"accuracy: draft", "accuracy: standard", "accuracy: reference"} <= names
            assert ("contact_model: convex" in names) == ("60" not in structure.name)
