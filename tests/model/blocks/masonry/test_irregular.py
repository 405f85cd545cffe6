"""Random units: reproducible, exact in volume, perpends that keep the overlap asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.model.blocks.masonry.bonds import stream
from mbla.model.blocks.wall import WallItem
from tests.model.blocks.masonry.built import build, is_sound, least_distance, perpends

IRREGULAR = {"seed": 7, "variation": 0.3, "heights": 0.2}


@pytest.mark.parametrize("seed", range(5))
def test_random_walls_are_prisms_whose_perpends_keep_the_overlap(tmp_path: Path, seed: int) -> None:
    built = build(tmp_path, length=4.0, courses=10, irregular={**IRREGULAR, "seed": seed})
    is_sound(built)
    assert built.volume == pytest.approx(4.0 * 0.2 * 1.5, rel=1e-12)
    assert built.bed_area() == pytest.approx(9 * 4.0 * 0.2, rel=1e-12)
    assert least_distance(perpends(built)) >= 0.2 * 0.4 * (1 - 1e-6)
    lengths = np.ptp(built.boxes(), axis=1)[:, 0]
    assert lengths.std() > 0.03
    assert lengths.min() >= 0.08 - 1e-9


def test_the_same_seed_gives_the_same_wall_on_every_machine(tmp_path: Path) -> None:
    """PCG64 is fixed by numpy; these are its doubles, made without any function that a machine may round otherwise."""
    first = build(tmp_path, length=4.0, courses=6, irregular=IRREGULAR)
    again = build(tmp_path, length=4.0, courses=6, irregular=IRREGULAR)
    other = build(tmp_path, length=4.0, courses=6, irregular={**IRREGULAR, "seed": 8})
    assert np.array_equal(first.blocks.vertices, again.blocks.vertices)
    assert not np.array_equal(first.blocks.vertices[:8], other.blocks.vertices[:8])
    item = WallItem.model_validate(
        {"material": "stone", "unit": (0.4, 0.2, 0.15), "length": 4, "courses": 6, "irregular": IRREGULAR}
    )
    assert item.irregular is not None
    numbers = stream(item.irregular, 1).random(3)
    assert numbers.tolist() == pytest.approx(SEED_7_STREAM_1, rel=1e-15)


SEED_7_STREAM_1 = [0.7701409510034741, 0.1119272443176843, 0.18909773329712753]


def test_heights_vary_but_heads_and_sills_stay(tmp_path: Path) -> None:
    openings = [{"from": [1.5, 0.45], "to": [2.5, 1.05], "lintel": {"bearing": 0.2}}]
    built = build(tmp_path, length=4.0, courses=10, irregular=IRREGULAR, openings=openings)
    is_sound(built)
    assert built.volume == pytest.approx(0.2 * (4.0 * 1.5 - 0.6), rel=1e-12)
    boxes = built.boxes()
    levels = np.unique(boxes[:, :, 2].round(12))
    assert len(levels) == 11
    assert {0.0, 0.45, 1.05, 1.2, 1.5} <= set(levels.tolist())
    assert np.diff(levels).std() > 0.01
    assert np.diff(levels).min() > 0.09


def test_through_stones_of_random_leaves(tmp_path: Path) -> None:
    built = build(
        tmp_path,
        length=4.0,
        courses=6,
        leaves=2,
        headers={"every": 3, "spacing": 2},
        irregular={"seed": 1, "variation": 0.2},
    )
    is_sound(built)
    assert built.volume == pytest.approx(4.0 * 0.4 * 0.9, rel=1e-12)
    header, course = built.member("header"), built.position("course")
    assert set(course[header].tolist()) == {2, 5}
    assert built.position("unit")[header & (course == 2)].tolist()[:3] == [0, 2, 4]
