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
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.report.report import report_html
from mbla.results.series import detailed_cases
from mbla.results.tables.formats import table_csv
from mbla.results.tables.tables import export_results, tables_of
from mbla.verify import verify_file

HEAD = """\
mbla: 1
title: Odd
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
"""
BLOCK = (
    HEAD
    + """\
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2]}}]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""One block on the ground: rocks at 1/2."""

STACK = (
    HEAD
    + """\
parameters: {x: 0, s: 1}
blocks:
  - box: {group: base, material: stone, min: ["=x", 0, 0], max: ["=x+s", "=s", "=s"]}
  - box: {group: middle, material: stone, min: ["=x", 0, "=s"], max: ["=x+s", "=s", "=2*s"]}
  - box: {group: top, material: stone, min: ["=x", 0, "=2*s"], max: ["=x+s", "=s", "=3*s"]}
supports: [{blocks: base}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)
"""Two blocks on a fixed one: both rock at 1/2."""

TWIST = BLOCK.replace(
    "{live: [{acceleration: [1, 0, 0]}]}",
    "{live: [{force: [0, 1000, 0], on: block, at: [1, 0.5, 1]}, {force: [0, -1000, 0], on: block, at: [0, 0.5, 1]}]}",
)
WEDGE = (
    HEAD.replace("0.6", "1.8")
    + """\
parameters: {b: 30, t: "=0.5*tan(b)"}
blocks:
  - polyhedron:
      group: wedge
      material: stone
      vertices: [[0, 0, 0], [0.5, 0, "=t"], [-0.5, 0, "=t"], [0, 4, 0], [0.5, 4, "=t"], [-0.5, 4, "=t"]]
      faces: [[0, 1, 2], [5, 4, 3], [3, 4, 1, 0], [4, 5, 2, 1], [5, 3, 0, 2]]
supports:
  - {ground: {point: [0, 0, 0], normal: ["=-sin(b)", 0, "=cos(b)"]}}
  - {ground: {point: [0, 0, 0], normal: ["=sin(b)", 0, "=cos(b)"]}}
load_cases: {along: {live: [{acceleration: [0, 1, 0]}]}}
"""
)
BEAM = (
    HEAD
    + """\
blocks:
  - box: {group: pier, material: stone, min: [2, 0, 0], max: [2.5, 0.5, 2]}
  - box: {group: pier, material: stone, min: [5.5, 0, 0], max: [6, 0.5, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [8, 0.5, 2.4]}
supports: [{blocks: pier}]
load_cases:
  crane: {live: [{travel: {force: [0, 0, -10000], path: [[0, 0.25, 3], [8, 0.25, 3]], positions: 5}}]}
analysis: {flow_rule: associative}
"""
)
PIER_WITH_HALF = BEAM.split("load_cases")[0]

HUGE = "ÄÖÜß <script>alert(1)</script> & 'quoted' \\\"words\\\" \U0001f9f1 " + "a very long title " * 8

DECKS: dict[str, tuple[str, tuple[str, ...]]] = {
    "one_block": (BLOCK, ()),
    "isolated": (
        STACK.replace(
            "supports:", "  - box: {group: far, material: stone, min: [9, 0, 0], max: [10, 1, 1]}\nsupports:"
        ),
        (),
    ),
    "no_interfaces": (
        STACK.replace('min: ["=x", 0, "=s"]', 'min: ["=x", 0, "=1.5*s"]').replace(
            '  - box: {group: top, material: stone, min: ["=x", 0, "=2*s"], max: ["=x+s", "=s", "=3*s"]}\n', ""
        ),
        (),
    ),
    "guides_only": (
        BLOCK.replace("{ground: {z: 0}}", "{blocks: block, slide: [0.8, 0, 0.6]}"),
        (),
    ),
    "guide_carries": (
        BLOCK.replace("{ground: {z: 0}}", "{ground: {z: 0}}, {blocks: block, slide: [1, 0, 0]}"),
        (),
    ),
    "pushed_on_guides": (
        BLOCK.replace("{ground: {z: 0}}", "{blocks: block, slide: [1, 0, 0]}").replace(
            "0]}]}", "0]}], pushover: {step: 0.05, until: 0.2}}"
        )
        + "analysis: {geometric_safety: true}\n",
        (),
    ),
    "guided_dead_falls": (BLOCK.replace("{ground: {z: 0}}", "{blocks: block, fixed: [rx, ry, rz]}"), ()),
    "settlement": (
        PIER_WITH_HALF + "load_cases: {sinks: {settlement: {on: {group: pier, index: 1}, direction: [0, 0, -1]}}}\n",
        (),
    ),
    "not_all_cases": (
        BLOCK.replace("load_cases: {", "load_cases: {other: {live: [{acceleration: [0, 1, 0]}]}, "),
        ("case=push",),
    ),
    "frictionless": (BLOCK.replace("0.6", "0"), ()),
    "hangs": (
        HEAD.replace("0.6", "0.6, cohesion: 1.e+5, tensile_strength: 8.e+4")
        + """\
blocks:
  - box: {group: ceiling, material: stone, min: [0, 0, 1], max: [1, 1, 2]}
  - box: {group: hanging, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
supports: [{blocks: ceiling}]
load_cases: {pull: {live: [{force: [0, 0, -1000], on: hanging, at: [0.5, 0.5, 0]}]}}
""",
        (),
    ),
    "all_glued": (
        STACK.replace("contacts: {joint: dry}", "contacts: {joint: glued}").replace(
            "{blocks: base}", "{ground: {z: 0}, joint: dry}"
        ),
        (),
    ),
    "convex_twist": (TWIST, ("analysis.contact_model=convex",)),
    "far": (STACK, ("parameters.x=1000000",)),
    "mm": (
        STACK.replace("materials", "units: {length: mm}\nmaterials").replace("2000", "2.e-6"),
        ("parameters.s=1000",),
    ),
    "title": (BLOCK.replace("title: Odd", f'title: "{HUGE}"'), ()),
    "tiny": (STACK, ("parameters.s=0.000001",)),
    "no_equilibrium": (
        BLOCK.replace("[{acceleration", "[{acceleration").replace(
            "push: {", "push: {dead: [{gravity: [9.81, 0, -9.81]}], "
        ),
        (),
    ),
    "unbounded": (WEDGE, ("analysis.flow_rule=associative",)),
    "locked": (WEDGE, ()),
    "time_limit": (STACK, ("analysis.time_limit=0.001",)),
    "iteration_limit": (STACK, ("analysis.max_iterations=2",)),
    "no_search": (TWIST, ("analysis.search=0",)),
    "travel_unbounded": (BEAM, ()),
    "travel_not_verified": (BEAM, ("analysis.max_iterations=3",)),
    "tilt": (BLOCK.replace("{acceleration: [1, 0, 0]}", "{tilt: {axis: [0, 1, 0]}}"), ()),
    "weightless_unloaded": (
        BLOCK.replace(
            "{live: [{acceleration: [1, 0, 0]}]}",
            "{dead: [{gravity: none}], live: [{force: [1000, 0, 0], on: block, at: [0.5, 0.5, 2]}]}",
        ),
        (),
    ),
    "livesley": (STACK, ("analysis.flow_rule=livesley",)),
    "crushing": (STACK.replace("0.6}", "0.6, compressive_strength: 2.e+6}"), ("analysis.contact_model=convex",)),
}


NO_WORD = re.compile(r"(?<!\w)(nan|NaN|None|-?inf|Infinity)(?!\w)")
"""what Python writes where there is nothing to write"""
SAID = {  # words of the verdict of what is no result, or not fully one
    "not_verified": "NOT VERIFIED",
    "approximate": "approximate",
    "no_equilibrium": "no equilibrium",
    "unbounded": "no collapse",
    "time_limit": "the time ran out",
    "iteration_limit": "the iterations ran out",
    "numerical_error": "numerical",
}


def run_of(name: str, folder: Path) -> Run:
    text, overrides = DECKS[name]
    cases = [each.removeprefix("case=") for each in overrides if each.startswith("case=")]
    files = ["output.vtu=true", "output.frames=2"]
    others = [each for each in overrides if not each.startswith("case=")]
    return mbla.run(text, set=[*others, *files], cases=cases, output=folder)


EVERY = 3
"""of the decks whose pictures are all drawn, which takes seconds, one of so many is a long test"""


def check_words(text: str) -> None:
    found = NO_WORD.search(text)
    assert found is None, text[max(0, found.start() - 80) : found.end() + 40]


@pytest.fixture(scope="module", params=DECKS)
def ran(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Run, Path]:
    """Name of a deck, its run, and the folder of its files."""
    folder = tmp_path_factory.mktemp("odd") / "out"
    return request.param, run_of(request.param, folder), folder


@pytest.mark.long
def test_words_and_records(ran: tuple[str, Run, Path]) -> None:
    """Listing, summary, table of a notebook, JSON, tables, comparison with itself and verification."""
    _, run, _ = ran
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
            told = case.name in [each.load_case.name for each in detailed_cases(run.records.cases)]
            in_table = not told and case.status == "unbounded"
            assert ("any multiple" if in_table else SAID[case.status].lower()) in run.listing.lower()
    for table in tables_of(run.records).values():
        assert not re.search(r"(?<!\w)(nan|NaN|None)(?!\w)", table_csv(table))  # inf is a value: any multiple
    compared = compare_results(run.records, run.records)
    assert not compared.differing
    check_words(comparison_text(compared, ("A.h5", "B.h5")))


@pytest.mark.parametrize(
    "ran",
    [pytest.param(name, marks=pytest.mark.trust if i % EVERY else pytest.mark.long) for i, name in enumerate(DECKS)],
    indirect=True,
)
def test_files_pictures_and_report(ran: tuple[str, Run, Path], tmp_path: Path) -> None:
    """Every file is read by its readers; pictures of every kind are drawn, and the report has no bare ``nan``."""
    pyvista = pytest.importorskip("pyvista")
    name, _, folder = ran
    results = read_results_hdf5(folder / "deck.h5")
    again, apart = verify_file(folder / "deck.h5")
    assert not apart
    assert bool(again.unconfirmed) is (name == "not_all_cases")  # what the deck asks for and the file lacks
    assert again.exit_code == (4 if again.unconfirmed else results.exit_code)
    check_words("\n".join(verification_lines(again, apart)))
    for path in folder.glob("*.vtu"):
        assert len(meshio.read(path).points) == pyvista.read(path).n_points
    options = PictureOptions(kinds=KINDS, size=(600, 400))
    assert all(path.stat().st_size > 0 for path in plot_results(results, tmp_path / "pictures", "odd", options))
    assert export_results(results, tmp_path / "tables", "odd", parquet=True)
    page, remarks = report_html(results, view=False)
    assert not remarks
    hidden = re.compile(r'<style.*?</style>|<svg.*?</svg>|<pre.*?</pre>|"data:[^"]*"', re.DOTALL)
    check_words(re.sub(r"<[^>]*>", " ", hidden.sub(" ", page)).replace("None: nothing", "").replace("None.", ""))
    check_words(re.sub(r'<[^>]*>|"data:[^"]*"', " ", mbla.read_results(folder / "deck.h5")._repr_html_()))
