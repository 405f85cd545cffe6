from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.errors import DeckError
from mbla.model import Model, build_model
from tests.model.shapes import deck

BLOCKS = ["box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"] + [
    f"box: {{group: high, material: stone, min: [{x}, 0, 1], max: [{x + 1}, 1, 2]}}" for x in (0, 2)
]


def model(folder: Path, rows: str, kind: str = "live") -> Model:
    (folder / "loads.csv").write_text(rows)
    loads = (
        "live: [{table: loads.csv}]"
        if kind == "live"
        else "dead: [{gravity: none}, {table: loads.csv}], live: [{gravity: [1, 0, 0]}]"
    )
    return build_model(deck(folder, BLOCKS, loads=loads))


def test_forces_with_points_and_moments_add_up(tmp_path: Path) -> None:
    rows = (
        "group,index,fx,fy,fz,x,y,z,my\nhigh,1,1,0,0,2.5,0.5,2,0\nlow,0,0,2,0,0.5,0.5,0.5,7\nhigh,1,0,0,-3,3,0.5,2,0\n"
    )
    live = model(tmp_path, rows).load_cases[0].live_load
    expected = np.zeros((3, 6))
    expected[0] = [0, 2, 0, 0, 7, 0]
    expected[2] = [1, 0, -3, 0, 0.5 * 1 + 0.5 * 3, 0]  # (p - x) x F about (2.5, 0.5, 1.5)
    assert live == pytest.approx(expected)


def test_without_points_forces_act_at_centroids(tmp_path: Path) -> None:
    case = model(tmp_path, "group;index;fx;fy;fz\nhigh;0;1,5;0;0\n", "dead").load_cases[0]
    assert case.dead_load[1].tolist() == [1.5, 0, 0, 0, 0, 0]
    assert case.dead_words == (
        "no gravity",
        "1 row of loads.csv: forces on 1 block",
    )


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("group,index,fx,fy,fz\nlaw,0,1,0,0\n", "loads.csv:2: unknown group law; did you mean low?"),
        ("group,index,fx,fy,fz\nhigh,2,1,0,0\n", "loads.csv:2: index = 2: high has blocks 0 to 1"),
        ("group,index,fx,fy,fz\nhigh,-1,1,0,0\n", "loads.csv:2: index = -1: high has blocks 0 to 1"),
        ("group,index,fx,fy,fz\nhigh,0,1,0,x\n", "loads.csv:2: fz = x: must be a finite number"),
        ("group,index,fx,fy,fz,x\nhigh,0,1,0,0,1\n", "loads.csv: columns x, y, z go together, only x is there"),
        ("group,index,fx,fy\nhigh,0,1,0\n", "loads.csv:1: column fz is missing"),
    ],
)
def test_faults_by_file_and_line(tmp_path: Path, rows: str, message: str) -> None:
    with pytest.raises(DeckError) as caught:
        model(tmp_path, rows)
    assert [fault.message for fault in caught.value.faults] == [message]


def test_forces_that_cancel(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="the live loads cancel each other"):
        model(tmp_path, "group,index,fx,fy,fz\nlow,0,1,0,0\nlow,0,-1,0,0\n")


def test_a_missing_table(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match=r"load_cases\.push\.live\[0\]\.table = gone\.csv"):
        build_model(deck(tmp_path, BLOCKS, loads="live: [{table: gone.csv}]"))
