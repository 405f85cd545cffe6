"""Odd results go through every output: no error, no bare ``nan`` in words, no figure that is none."""

from __future__ import annotations

import json
import re
from pathlib import Path

import meshio
import numpy as np
import pytest

import mbla
from mbla.results.diff.comparison import compare_results
from mbla.results.diff.words import comparison_text
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.listing import verification_lines
from mbla.results.notebook.display import _table
from mbla.results.notebook.run import Run
from mbla.results.outcome import result_of
from mbla.results.pictures.options import KINDS, PictureOptions
from mbla.results.pictures.plot import plot_results
from mbla.results.pictures.scene import scene_of
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.report.report import report_html
from mbla.results.series import told_cases
from mbla.results.tables.formats import table_csv
from mbla.results.tables.tables import Formats, export_results, tables_of
from mbla.results.verify import verify_file
from tests.results.odd_decks import DECKS

pytestmark = pytest.mark.long

NO_WORD = re.compile(r"(?<!\w)(nan|NaN|None|-?inf|Infinity)(?!\w)")
"""what Python writes where there is nothing to write"""
SAID = {  # words of the verdict of what is no result, or not fully one
    "not_verified": "NOT VERIFIED",
    "approximate": "approximate",
    "no_equilibrium": "no equilibrium",
    "unbounded": "no collapse",
    "time_limit": "out of time",
    "iteration_limit": "out of iterations",
    "numerical_error": "numerical",
}


def run_of(name: str, folder: Path | None = None) -> Run:
    text, overrides = DECKS[name]
    cases = [each.removeprefix("case=") for each in overrides if each.startswith("case=")]
    files = ["output.vtu=true", "output.frames=2"] if folder is not None else []
    others = [each for each in overrides if not each.startswith("case=")]
    return mbla.run(text, set=[*others, *files], cases=cases, output=folder)


def check_words(text: str) -> None:
    found = NO_WORD.search(text)
    assert found is None, text[max(0, found.start() - 80) : found.end() + 40]


@pytest.mark.parametrize("name", DECKS)
def test_words_and_records(name: str) -> None:
    """Listing, summary, table of a notebook, JSON, tables, comparison with itself and verification."""
    run = run_of(name)
    for text in (run.listing, run.summary, _table(run.records.model, run.cases)):
        check_words(text)
    record = json.loads(json_line(results_json(run.records)), parse_constant=lambda word: pytest.fail(word))
    for case, told in zip(run.cases, record["cases"], strict=True):
        check_words(f"{case.summary} {case.reason} {case.verdict}")
        assert told["status"] == case.status
        if result_of(case.record) is None:
            assert told["load_factor"] is None
            assert np.isnan(case.load_factor)
            assert case.thrust is None
            assert case.collapse is None
        if case.status != "solved":
            assert SAID[case.status].lower() in case.verdict.lower()
            told = case.name in [each.load_case.name for each in told_cases(run.records.cases)]
            assert (SAID[case.status].lower() if told else "any multiple") in run.listing.lower()
    for table in tables_of(run.records).values():
        assert not re.search(r"(?<!\w)(nan|NaN|None)(?!\w)", table_csv(table))  # inf is a value: any multiple
    compared = compare_results(run.records, run.records)
    assert not compared.differing
    check_words(comparison_text(compared, ("A.h5", "B.h5")))


@pytest.mark.parametrize("rule", ["non_associative", "associative"])
def test_blocks_that_only_guides_hold(rule: str) -> None:
    """What turns both ways about a hinge, and carries its dead load, has no joint that could resist the live load."""
    text, _ = DECKS["hinge"]
    run = mbla.run(text, set=[f"analysis.flow_rule={rule}", "analysis.force_ranges=true"])
    assert run.load_factor == pytest.approx(0, abs=1e-9)
    assert run.verified


def test_a_structure_without_dead_load() -> None:
    """No weight, no friction: any push moves it. Steps without a scale of forces would overflow."""
    assert run_of("weightless_unloaded").load_factor == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("name", "count"), [("hangs", 1), ("one_block", 0)])
def test_a_picture_of_forces_says_what_it_leaves_out(name: str, count: int) -> None:
    """A joint in tension has no point of application, so that its force is not drawn among the others."""
    records = run_of(name).records
    words = scene_of(records, records.cases[0], PictureOptions(), "forces").words_of("forces")[-1]
    assert ("not drawn: 1 joint in tension" in words) == (count == 1)


@pytest.mark.parametrize("name", DECKS)
def test_files_pictures_and_report(name: str, tmp_path: Path) -> None:
    """Every file is read by its readers; pictures of every kind are drawn, and the report has no bare ``nan``."""
    pyvista = pytest.importorskip("pyvista")
    run_of(name, tmp_path / "out")
    results = read_results_hdf5(tmp_path / "out" / "deck.h5")
    again, apart = verify_file(tmp_path / "out" / "deck.h5")
    assert not apart
    assert again.exit_code == results.exit_code
    check_words("\n".join(verification_lines(again, apart)))
    for path in (tmp_path / "out").glob("*.vtu"):
        assert len(meshio.read(path).points) == pyvista.read(path).n_points
    options = PictureOptions(kinds=KINDS, size=(600, 400))
    assert all(path.stat().st_size > 0 for path in plot_results(results, tmp_path / "pictures", "odd", options))
    assert export_results(results, tmp_path / "tables", "odd", Formats(csv=True, parquet=True))
    page, remarks = report_html(results, view=False)
    assert not remarks
    hidden = re.compile(r'<style.*?</style>|<svg.*?</svg>|<pre.*?</pre>|"data:[^"]*"', re.DOTALL)
    check_words(re.sub(r"<[^>]*>", " ", hidden.sub(" ", page)).replace("None: nothing", "").replace("None.", ""))
    check_words(re.sub(r'<[^>]*>|"data:[^"]*"', " ", mbla.read_results(tmp_path / "out" / "deck.h5")._repr_html_()))
