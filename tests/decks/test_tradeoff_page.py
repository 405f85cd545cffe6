"""The page of the measured trade says what its record holds, and the record keeps what was measured."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.rung import Rung
from tests.decks import tradeoff_page
from tests.decks.tradeoff_page import chosen, measure
from tests.decks.tradeoff_plan import PRESETS, plan_of, rungs_for
from tests.decks.tradeoff_record import FOLDER, Entry, entries_of, read_entries, write_entries
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
    model = replace(ENTRY, rung="contact_model: convex", other_model="contact_model", front=False, time=5.0)
    stopped = Entry(ENTRY.structure, "associative", "form: static", "", "stopped after 60 s")
    text = page_text([ENTRY, twice, doubtful, model, stopped])
    name, count = ENTRY.structure, f"1 of {len(STANDARD_SET)}"
    assert f"| associative | standard | {count} | 1 | 2.0e-06 ({name}) | 2.0e-06 | 1.00 | 0.5 s ({name}) |" in text
    assert f"| associative | reference | {count} | 1 | 1.0e-09 ({name}) | 1.0e-09 | 2.00 | 1 s ({name}) |" in text
    assert f"| associative | draft | {count} | 0 | - (-) | - | 1.00 |" in text  # nothing verified, so no error
    row = f"| {name} | 0.65 | 0.5 (not verified) | 0.5 | 1 | 0.1 | 12.0 | 5.0e-01 | 2.0e-06 | 1.0e-09 |"
    assert row in text
    assert f"| associative | contact_model: convex (other model) | 1 | 1 | 10.00 | 2.0e-06 | 2.0e-06 ({name}) |" in text
    assert "| associative | form: static | 1 | 0 | - | - | - (-) |" in text
    assert f"- {name}, associative: accuracy: draft: not verified" in text
    assert f"- {name}, associative: form: static: stopped after 60 s" in text
    assert f"Not measured yet, without dilatancy: {name};" in text


def test_a_broken_promise_is_told() -> None:
    kept = [replace(ENTRY, rung=f"accuracy: {name}") for name in ("draft", "standard")]
    assert "No verified run breaks them." in page_text(kept)
    broken = replace(ENTRY, distance=2e-4)
    assert f"**Broken: accuracy: standard on {ENTRY.structure} (associative, 2.0e-04).**" in page_text([broken])
    loose = replace(ENTRY, rung="accuracy: reference", reference=True, distance=0.0, resolution=2e-7)
    assert "Broken: accuracy: reference" in page_text([loose])
    without = replace(loose, flow_rule="non_associative")  # where nothing is proved
    assert "No verified run breaks them." in page_text([without])


def test_a_distance_of_two_states_is_no_error() -> None:
    far = replace(ENTRY, flow_rule="non_associative", distance=2e-3, residual=8e-7, resolution=1e-8)
    text = page_text([far])
    assert "No verified run breaks them." in text
    assert f"reference: accuracy: standard on {ENTRY.structure} (without dilatancy, 2.0e-03)." in text
    for own in (replace(far, residual=2e-6), replace(far, resolution=2e-6), replace(far, flow_rule="associative")):
        assert "**Broken: accuracy: standard" in page_text([own])


def test_the_oldest_come_first() -> None:
    newer = replace(ENTRY, structure=STANDARD_SET[1].name, date="2026-02-01T00:00:00+00:00")
    order = [(structure.name, rule) for structure, rule in chosen([], [newer, ENTRY])]
    assert len(order) == len(STANDARD_SET) * len(FLOW_RULES)
    assert order[-2:] == [(ENTRY.structure, "associative"), (newer.structure, "associative")]
    assert {s.name for s, _ in chosen(["dome"], [])} == {"dome"}


def test_every_structure_has_the_presets() -> None:
    """Among its rungs; large members have them alone, from rough to sharp."""
    for structure in STANDARD_SET:
        for rule in FLOW_RULES:
            names = [rung.name for rung in rungs_for(structure, rule)]
            assert set(PRESETS) <= set(names)
            assert not plan_of(structure, rule).in_turn or tuple(names) == PRESETS
    assert plan_of(STANDARD_SET[-1], "associative").in_turn
    assert len(rungs_for(STANDARD_SET[0], "associative")) > 10


def test_presets_after_one_that_was_stopped_are_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(deck: Path, fixed: object, cases: object, rungs: list[Rung], *rest: object) -> list[RungRun]:
        return [RungRun(rung, (), "stopped", "stopped after 1 s") for rung in rungs]

    monkeypatch.setattr(tradeoff_page, "run_ladder", stopped)
    large = next(structure for structure in STANDARD_SET if "60 x 60" in structure.name)
    small = replace(large, overrides=STANDARD_SET[0].overrides)  # read and built in no time
    study = measure(small, "associative")
    assert [run.rung.name for run in study.runs] == list(PRESETS)
    assert [run.end for run in study.runs] == ["stopped", "not run", "not run"]
    entries = entries_of(study, small, "associative", "2026-01-01", "", "")
    assert "accuracy: reference: not tried, as accuracy: draft was stopped after 1 s" in page_text(entries)
