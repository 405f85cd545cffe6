"""The same sweep says the same in every folder: nothing of a machine is in its table."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mbla.sweeps.command import SweepOptions, prepare, run_sweep
from mbla.sweeps.file.read import read_sweep
from mbla.sweeps.plan import FAILED, Plan, PointOutcome, as_named
from tests.line import BLOCK

SWEEP = """\
mbla_sweep: 1
deck: ../decks/base.yaml
set: {parameters.f: 1}
parameters:
  mu: {values: [0.3, -1]}
results: [status, load_factor]
output: {files: all}
"""
CLOCKS = ("tries", "seconds", "created", "time")


def plan_in(folder: str, deck: str) -> Plan:
    return Plan(deck, "", (), (), (), "none", folder, None, None, "")


@pytest.mark.parametrize(
    ("deck", "named", "reason", "shown"),
    [
        ("/a/b/base.yaml", "base.yaml", "/a/b/base.yaml:3:1 joints: no", "base.yaml:3:1 joints: no"),
        ("/a/b/base.yaml", "base.yaml", "no file '/a/b/part/x.obj'", "no file 'part/x.obj'"),
        ("/a/s/../b/base.yaml", "../b/base.yaml", "/a/s/../b/base.yaml:3:1 no", "../b/base.yaml:3:1 no"),
        ("/a/s/../b/base.yaml", "../b/base.yaml", "/a/b/x.obj: no", "../b/x.obj: no"),
        ("/a/b/base.yaml", "base.yaml", "/a/b/s.out/points/3/base.h5: disk full", "points/3/base.h5: disk full"),
        ("/a/b/base.yaml", "/a/b/base.yaml", "/a/b/base.yaml:3:1 no", "/a/b/base.yaml:3:1 no"),
        ("/base.yaml", "base.yaml", "--set:1:20 a.b = 1: no; --set:12:3 c: no", "a.b = 1: no; c: no"),
    ],
)
def test_files_have_the_names_that_the_sweep_file_gives_them(deck: str, named: str, reason: str, shown: str) -> None:
    outcome = PointOutcome("key", FAILED, 3, reason, {}, 1, 0.0)
    assert as_named(plan_in("/a/b/s.out", deck), named, outcome).reason == shown


def written(folder: Path) -> dict[str, str]:
    """Texts of the files of a sweep with a refused point, without what clocks say."""
    (folder / "decks").mkdir(parents=True)
    (folder / "sweeps").mkdir()
    text = BLOCK.replace("parameters: {", "parameters: {f: 2, ").replace(
        "acceleration: [1, 0", 'acceleration: ["=f", 0'
    )
    (folder / "decks" / "base.yaml").write_text(text, encoding="utf-8")
    path = folder / "sweeps" / "s.yaml"
    path.write_text(SWEEP, encoding="utf-8")
    options = SweepOptions()
    finished = run_sweep(prepare(read_sweep(path), options), options)
    assert finished.exit_code == 8
    files = path.with_suffix(".out")
    record = json.loads((files / "sweep.json").read_text(encoding="utf-8"))
    rows = [row.split(",") for row in (files / "sweep.csv").read_text(encoding="utf-8").splitlines()]
    kept = [column["name"] not in CLOCKS for column in record["columns"]]
    return {
        "journal": (files / "journal.csv").read_text(encoding="utf-8"),
        "table": "\n".join(",".join(row[: len(kept) - 2]) for row in rows),
        "record": json.dumps({key: value for key, value in record.items() if key not in CLOCKS}),
    }


@pytest.mark.long
def test_the_table_is_the_same_in_every_folder(tmp_path: Path) -> None:
    """A deck refused in one point: its file stands in the reason, under the name in the sweep file."""
    here, there = written(tmp_path / "here"), written(tmp_path / "there" / "deeper")
    assert here["table"] == there["table"]
    assert here["record"] == there["record"]
    for text in (*here.values(), *there.values()):
        assert str(tmp_path) not in text
    assert "../decks/base.yaml" in here["table"]
