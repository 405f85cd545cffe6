"""Peaks of structures in time are those that LMGC90 found, which is not needed for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from tests.performance.lmgc90_oracle import KEYS, LMGC90, MBLA, RIGID, STEPS, USUAL, Run, by_mbla, other_joints, table
from tests.performance.lmgc90_scenes import SCENES
from tests.performance.recording import RESULTS, read_rows

NEAR = 0.05
"""relative, of peaks"""
LONGER = 1.1
"""than until the peak, of what is followed here"""
ROWS = {tuple(row[key] for key in KEYS): row for row in read_rows(RESULTS / "lmgc90.csv")}
CASES = [*((name, USUAL) for name in SCENES if name != "stack"), ("stack", RIGID)]


def recorded(scene: str, point: str, joints: str) -> Mapping[str, str]:
    """LMGC90's row with its shortest step."""
    return ROWS[scene, point, other_joints(scene, joints), LMGC90, f"{1e3 * STEPS[-1]:g}", "1"]


@pytest.mark.long
@pytest.mark.parametrize(("name", "joints"), CASES, ids=[name for name, _ in CASES])
def test_peaks(name: str, joints: str) -> None:
    scene = SCENES[name]()
    rows = [recorded(name, point, joints) for point in scene.points]
    until = LONGER * max(float(row["peak_s"]) for row in rows)
    found = by_mbla(replace(scene, duration=round(until / STEPS[0]) * STEPS[0]), Run(joints, STEPS[0]))
    expected = [float(row["peak_mm"]) / 1e3 for row in rows]
    peaks = found.displacements[np.abs(found.displacements).argmax(axis=0), range(len(rows))]
    assert peaks == pytest.approx(expected, rel=NEAR)


def test_recorded_peaks() -> None:
    """Of both programs, with all joints."""
    own = [row for row in ROWS.values() if row["program"] == MBLA]
    assert {row["scene"] for row in own} == set(SCENES)
    for row in own:
        expected = float(recorded(row["scene"], row["point"], row["joints"])["peak_mm"])
        assert float(row["peak_mm"]) == pytest.approx(expected, rel=NEAR), row
    assert len(list(table(list(ROWS.values())))) > 2 + len(SCENES)
