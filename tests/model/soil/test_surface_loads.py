"""Loads on the top of soil of cells: they are where the deck says, whatever the mesh and wherever its points are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.model import Model
from tests.model.soil.decks import BACKFILL, GROUND, WALL, model, moved_to

STRIP = "pressure: {value: 1000, normal: [0, 0, 1], box: [[0.33, -1, 0.9], [0.81, 2, 1.1]]}, on: backfill"


def live(found: Model) -> FloatArray:
    """Force and moment about the origin of the live load of the first case."""
    load = found.load_cases[0].live_load
    moments = load[:, 3:] + np.cross(found.blocks.centroids, load[:, :3])
    return np.append(load[:, :3].sum(axis=0), moments.sum(axis=0))


def both(folder: Path, loads: str) -> tuple[Model, Model]:
    """Soil behind a wall, and the same with its points moved, along the top as well."""
    before = model(folder, WALL, BACKFILL, supports=GROUND, loads=loads)
    (soil,) = before.soils
    shifts = np.where(soil.inside[:, None], [0.02, -0.01], 0.04 * soil.along)
    return before, model(
        folder, WALL, BACKFILL, supports=GROUND, loads=loads, soil=moved_to(soil, soil.points + shifts)
    )


@pytest.mark.parametrize(
    ("load", "force", "at"),
    [
        ("pressure: {value: 100, normal: [0, 0, 1]}, on: backfill", 160.0, 0.8),
        (STRIP, 480.0, 0.57),
    ],
)
def test_the_same_on_points_that_are_moved(tmp_path: Path, load: str, force: float, at: float) -> None:
    found = both(tmp_path, f"live: [{{{load}}}]")
    for each in found:
        total = live(each)
        assert total[:3] == pytest.approx([0, 0, -force], abs=1e-9)
        assert total[3:] == pytest.approx([-0.5 * force, at * force, 0], abs=1e-9)
    assert not np.allclose(found[0].load_cases[0].live_load, found[1].load_cases[0].live_load)


def test_an_end_of_the_box_on_the_top_does_not_cut_it(tmp_path: Path) -> None:
    on_top = STRIP.replace("0.9]", "0]").replace("1.1]", "1.0]")
    found = model(tmp_path, WALL, BACKFILL, supports=GROUND, loads=f"live: [{{{on_top}}}]")
    assert live(found)[2] == pytest.approx(-480.0)


def test_faces_of_blocks_are_whole(tmp_path: Path) -> None:
    """The centroid of the top of the wall lies in the box, or it does not."""
    box = "pressure: {value: 1000, normal: [0, 0, 1], box: [[-0.3, -1, 0.9], [0.81, 2, 1.1]]}"
    found = model(tmp_path, WALL, BACKFILL, supports=GROUND, loads=f"live: [{{{box}}}]")
    assert found.load_cases[0].live_load[0, 2] == pytest.approx(-500.0)
    assert live(found)[2] == pytest.approx(-500.0 - 810.0)


def test_words_tell_of_soil(tmp_path: Path) -> None:
    across = "live: [{line: {from: [-0.4, 0.5, 1], to: [0.1, 0.5, 1], force_per_length: [0, 0, -7]}}]"
    (words,) = model(tmp_path, WALL, BACKFILL, supports=GROUND, loads=across).load_cases[0].live_words
    assert words.endswith("on 1 block and soil backfill")
