"""10,000 points of a sweep in one process: its memory, and every point once with its own answer.

The block is b x 1 x 2 and is pushed at its centroid by load factor a times its weight in the direction (cos t, sin t).
It slides at a = mu, and overturns about an edge at a = b / (2 |cos t|) or 1 / (2 |sin t|); the smallest of these is the
load factor. So an answer that went to the wrong point is found out, not only one that is missing.
"""

from __future__ import annotations

import csv
import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from mbla.cli import main
from tests.sweeps.killed_sweeps import keys_in_journals
from tests.trust.counts import record_counts
from tests.trust.watching import POINTS, watched, written

CLAIM = (
    "A sweep of 10,000 points in one worker loses no point and repeats none, each row has the load factor of the "
    "closed form for its own parameters, and the process that solves the points does not grow by 5 %"
)
GROWTH = 0.05
"""of the process that solves points, from the first tenth of them to the last"""
HELD = 2.0
"""kB for each point that the command may grow: it holds the answers until the table is written"""
TOLERANCE = 1e-5
"""relative, of a load factor: what the bounds of a verified one lie within"""


@dataclass(frozen=True)
class Rows:
    """What is found in journal and table.

    journal : rows in it
    table   : rows in it
    right   : rows of the table with the load factor of the closed form for the parameters of that row
    wrong   : what is missing, twice, or not as it should be, in words
    """

    journal: int
    table: int
    right: int
    wrong: tuple[str, ...]


def rows_of(folder: Path, points: int) -> Rows:
    """Read the files of a finished sweep; ``points`` is how many there must be."""
    keys = Counter(keys_in_journals(folder))
    with (folder / "sweep.csv").open(newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    numbers = Counter(int(row["point"]) for row in table)
    wrong = [f"{count} rows of the journal have the key {key}" for key, count in keys.items() if count > 1]
    if len(keys) != points:
        wrong.append(f"{len(keys)} different points in the journal, not {points}")
    if list(numbers.elements()) != list(range(1, points + 1)):
        wrong.append(f"the table does not have the points 1 to {points}, each once and in their order")
    places = Counter(tuple(row[name] for name in _parameters(row)) for row in table)
    if len(places) != points:
        wrong.append(f"{len(places)} different sets of parameters in the table, not {points}")
    right = sum(_is_right(row) for row in table)
    if right != points:
        wrong.append(f"{right} rows with the load factor of the closed form, not {points}")
    counts = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))["points"]
    if counts != {"all": points, "done": points, "failed": 0, "unfinished": 0, "left_out": 0}:
        wrong.append(f"the record counts {counts}")
    return Rows(keys.total(), len(table), right, tuple(wrong))


def _parameters(row: Mapping[str, str]) -> Sequence[str]:
    """Names of the columns of parameters: those between the number of the point and its state."""
    names = list(row)
    return names[1 : names.index("state")]


def _is_right(row: Mapping[str, str]) -> bool:
    found = row["load_factor"]
    return bool(found) and math.isclose(float(found), closed_form(row), rel_tol=TOLERANCE)


def closed_form(row: Mapping[str, str]) -> float:
    """Load factor at the parameters of a row."""
    along, across, _ = (abs(float(component)) for component in json.loads(row["direction"]))
    overturning = [0.5 * size / push for size, push in ((float(row["b"]), along), (1.0, across)) if push > 0]
    return min(float(row["mu"]), *overturning)


def test_a_small_sweep_has_every_point_once_with_its_own_answer(tmp_path: Path) -> None:
    path = written(tmp_path, 8, widths=2, directions_around=2)
    assert main(["sweep", str(path), "-q", "-j", "1"]) == 0
    folder = path.with_suffix(".out")
    found = rows_of(folder, 8)
    assert found.wrong == ()
    assert (found.journal, found.table, found.right) == (8, 8, 8)
    table = (folder / "sweep.csv").read_text(encoding="utf-8")
    (folder / "sweep.csv").write_text(table.replace(",0.5,", ",1.5,", 2), encoding="utf-8")
    assert rows_of(folder, 8).wrong  # the answer of another point


@pytest.mark.trust
def test_ten_thousand_points_in_one_worker(tmp_path: Path) -> None:
    found = watched(tmp_path, POINTS, 1)
    rows = rows_of(tmp_path / "block_sweep.out", POINTS)
    assert rows.wrong == ()
    growth = found.last(found.points) / found.first(found.points) - 1.0
    assert growth < GROWTH
    assert found.kilobytes_per_point < HELD
    assert len(found.begun) == 1, "the process that solves points was begun anew: its memory says nothing"
    counts = {
        "points": POINTS,
        "rows of the journal": rows.journal,
        "rows of the table": rows.table,
        "with the load factor of the closed form": rows.right,
        "missing or twice": 0,
        "permille that the solving process grew": max(round(1e3 * growth), 0),
        "bytes a point that the command grew, which holds the answers for the table": round(
            1e3 * max(found.kilobytes_per_point, 0.0)
        ),
    }
    record_counts("soak", 90, CLAIM, counts)
