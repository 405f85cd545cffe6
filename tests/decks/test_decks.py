"""Every deck runs, meets its ``expected`` section, and says so by exit status, bounds and JSON."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from mbla.deck.content import Expectation
from mbla.deck.text.include import read_files
from mbla.solution.thresholds import GAP_TOLERANCE
from tests.decks.folder import LONG, PATHS, ROOT, deck_of, every_deck, name_of, outcome_of

EXIT_STATUS = {"solved": 0, "approximate": 4, "not_verified": 4, "no_equilibrium": 5, "unbounded": 5}

ROUNDED = 2e-8
"""Figures of closed forms and linear programs are written with eight digits."""


LOCKED = (
    "benchmarks/closed_forms/groove_steep_friction",
    "regressions/block_under_a_ceiling",
    "regressions/shelf",
    "regressions/shelf_across",
)
"""No associative load factor, and one without dilatancy all the same."""


LOCKED_IN = ("benchmarks/closed_forms/bar_between_walls",)
"""Held by forces that somebody must have locked in."""


def cases_of(path: Path) -> Iterator[tuple[dict[str, Any], Expectation]]:
    """Each load case as the JSON has it, with what is expected of it; of a travelling load the worst position."""
    expected, record = deck_of(path).content.expected, outcome_of(path).record
    worst = {series["worst"]["case"]: series["name"] for series in record["series"]}
    for case in record["cases"]:
        name = worst.get(case["name"], case["name"])
        if name in expected:
            yield case, expected[name]


def path_of(name: str) -> Path:
    """The deck of that name."""
    return next(path for path in PATHS if name_of(path) == name)


def test_there_are_decks() -> None:
    names = {name_of(path) for path in PATHS}
    assert {"tutorials/block", "tutorials/wall", "tutorials/arch", "tutorials/crossvault"} <= names
    assert len(names) > 40
    assert set(LONG) <= names


@pytest.fixture(scope="module")
def schema() -> jsonschema.Draft202012Validator:
    """The schema of decks, itself looked at once (every deck would look at it again, in 0.8 s)."""
    found = json.loads((ROOT / "schemas" / "deck.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(found)
    return jsonschema.Draft202012Validator(found)


@every_deck
def test_the_deck_agrees_with_the_schema_to_which_its_first_line_leads(
    path: Path, schema: jsonschema.Draft202012Validator
) -> None:
    tree, reading = read_files(path)
    assert not reading.faults
    schema.validate(tree.data)
    first = path.read_text(encoding="utf-8").splitlines()[0]
    prefix = "# yaml-language-server: $schema="
    assert first.startswith(prefix)
    assert (path.parent / first.removeprefix(prefix)).resolve() == ROOT / "schemas" / "deck.schema.json"


@every_deck
def test_every_load_case_has_an_expectation(path: Path) -> None:
    content = deck_of(path).content
    assert set(content.expected) == set(content.load_cases)
    for name, expectation in content.expected.items():
        figures: tuple[object, ...] = (expectation.load_factor, expectation.associative_load_factor, expectation.angle)
        if content.load_cases[name].settlement is not None:
            figures = (expectation.reaction, None, None)
        if content.load_cases[name].objective is not None:
            figures = (expectation.least, expectation.greatest, None)
        if content.load_cases[name].modes is not None and content.load_cases[name].live is None:
            figures = (expectation.period, None, None)
        if content.load_cases[name].time_history is not None:
            figures = (expectation.peak, expectation.end, None)
        without = expectation.status in ("no_equilibrium", "unbounded", "not_verified")
        assert (figures == (None, None, None)) == without, name
        assert expectation.status is not None, name


@every_deck
def test_the_deck_meets_its_expectations(path: Path) -> None:
    """By notices, exit status and bounds; its JSON and its files hold every load case."""
    notices = outcome_of(path).record["notices"]
    assert [notice["message"] for notice in notices if notice["identifier"] == "not-as-expected"] == []
    statuses = {EXIT_STATUS[str(expectation.status)] for _, expectation in cases_of(path)}
    gravest = next(status for status in (4, 5, 0) if status in statuses)
    assert outcome_of(path).exit_status == outcome_of(path).record["exit_code"] == gravest
    check_standing(path)
    check_bounds(path)
    check_forces(path)
    check_json(path)
    check_files(path)


def check_standing(path: Path) -> None:
    """It stands before its live load, save where it has no equilibrium, or one by self-stress only."""
    for case, expectation in cases_of(path):
        stands = "only by self-stress" if name_of(path) in LOCKED_IN else "yes"
        falls = expectation.status == "no_equilibrium"
        assert case["standing"]["verdict"] == ("no" if falls else stands), case["name"]


def check_json(path: Path) -> None:
    """One line with every case."""
    outcome = outcome_of(path)
    assert outcome.output.count("\n") == 1
    assert outcome.output.endswith("}\n")
    assert outcome.record["deck"] == path.name
    names = [case["name"].partition("@")[0] for case in outcome.record["cases"]]
    assert list(dict.fromkeys(names)) == list(deck_of(path).content.load_cases)
    several = {case["name"].partition("@")[0] for case in outcome.record["cases"] if "@" in case["name"]}
    assert {each["name"] for key in ("series", "objectives") for each in outcome.record[key]} == several


def check_forces(path: Path) -> None:
    """Each end of a force lies between its bounds, which have met where it is solved."""
    for force in outcome_of(path).record["objectives"]:
        for end in (force["least"], force["greatest"]):
            if end["status"] == "solved":
                own = next(case for case in outcome_of(path).record["cases"] if case["name"] == end["case"])
                room = 1e-9 * own["reaction"]["unit"]
                assert end["lower_bound"] - room <= end["value"] <= end["upper_bound"] + room
                assert own["gap"] <= GAP_TOLERANCE


def check_bounds(path: Path) -> None:
    """The associative figure lies between its bounds, and no load factor above them."""
    for case, expectation in cases_of(path):
        if case["load_factor"] is not None and name_of(path) not in LOCKED:
            assert case["load_factor"] <= case["kinematic_bound"] * (1 + max(expectation.tolerance, GAP_TOLERANCE))
        found = case["associative_load_factor"]
        if found is None:
            assert expectation.associative_load_factor is None
            assert expectation.load_factor is None or name_of(path) in LOCKED
            continue
        static, kinematic = case["static_bound"], case["kinematic_bound"]
        assert case["gap"] <= GAP_TOLERANCE
        # bounds of a zero gap may be off by the rounding of the sums that prove them
        assert static <= kinematic * (1 + 1e-9)
        figure = expectation.associative_load_factor
        if figure is None and case["flow_rule"] == "associative":
            figure = expectation.load_factor
        if figure is not None and expectation.tolerance <= 1e-6:
            assert static <= figure * (1 + ROUNDED)
            assert kinematic >= figure * (1 - ROUNDED)


def check_files(path: Path) -> None:
    """HDF5, listing, status and JSON, and the VTU files that the deck asks for."""
    stem, files = path.stem, outcome_of(path).files
    assert {f"{stem}.h5", f"{stem}.lst", f"{stem}.sta", f"{stem}.json"} <= set(files)
    record, written = outcome_of(path).record, deck_of(path).content.output.vtu
    positions = {position["case"] for series in record["series"] for position in series["positions"]}
    full = {series["worst"]["case"] for series in record["series"]}
    for case in record["cases"]:
        in_full = case["name"] not in positions or case["name"] in full
        assert (f"{stem}_{case['name']}_blocks.vtu" in files) == (written and in_full)
    assert (f"{stem}_positions.csv" in files) == bool(positions)


def test_in_a_process_of_its_own(tmp_path: Path) -> None:
    path = path_of("benchmarks/closed_forms/incline_too_steep")
    command = [sys.executable, "-m", "mbla", "run", str(path), "--expected", "--json", "-o", str(tmp_path / "out")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 5, done.stderr
    assert json.loads(done.stdout)["exit_code"] == 5


def test_what_is_carried_while_it_moves_is_told_where_the_load_falls() -> None:
    """A plank in a clamp loses its clamping as it slides; the least of rigid joints is that of a plank that slides."""
    ((case, _),) = cases_of(path_of("benchmarks/closed_forms/plank_in_clamp"))
    assert case["path_end"] == "falls"
    assert case["least_load_factor"] < case["path_last"] < case["load_factor"]


def test_a_locked_wedge_is_shown_to_be_locked() -> None:
    outcome = outcome_of(path_of("benchmarks/closed_forms/groove_locked"))
    assert outcome.record["cases"][0]["load_factor"] is None
    assert outcome.record["cases"][0]["verified"]
