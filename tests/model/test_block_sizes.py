"""Blocks of no stone's size are wondered at, whatever the deck's unit; stones, models of them and monuments are not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.model import build_model

DECK = """
mbla: 1
units: {{length: {unit}, force: N, mass: kg}}
materials: {{stone: {{density: 2000 kg/m^3}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
  - wall: {{group: wall, material: stone, unit: [{sizes}], length: "={length}*4", courses: 4}}
  - box: {{group: rock, material: stone, min: [{far}, 0, 0], max: ["=2*{far}", {far}, {far}]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}, {{blocks: rock}}]
load_cases: {{push: {{live: [{{acceleration: [0, 1, 0]}}]}}}}
"""


def remarks(folder: Path, unit: str, sizes: tuple[float, float, float], scale: float = 1.0) -> list[str]:
    """Remarks on sizes of a wall of units, and of a large rock that is fixed."""
    length, width, height = (scale * size for size in sizes)
    (folder / "wall.yaml").write_text(
        DECK.format(unit=unit, sizes=f"{length}, {width}, {height}", length=length, far=1000 * length)
    )
    model = build_model(read_deck(folder / "wall.yaml"))
    return [notice.message for notice in model.notices if notice.identifier == "block-size-unusual"]


@pytest.mark.parametrize(
    ("unit", "sizes", "meant"),
    [
        ("m", (800, 600, 400), "mm"),
        ("m", (250, 120, 65), "mm"),
        ("m", (80, 60, 40), "cm"),
        ("m", (25, 12, 6.5), "cm"),
        ("mm", (0.8, 0.6, 0.4), "m"),
        ("mm", (0.25, 0.12, 0.065), "m"),
        ("ft", (800, 600, 400), "mm"),
    ],
)
def test_sizes_of_another_unit(unit: str, sizes: tuple[float, float, float], meant: str, tmp_path: Path) -> None:
    (remark,) = remarks(tmp_path, unit, sizes)
    words = rf"wall\[\d+\] is {sizes[0]:g} x {sizes[1]:g} x {sizes[2]:g} {unit} large, .* would be a stone in {meant}: "
    assert re.match(words, remark)


@pytest.mark.parametrize("unit", ["m", "mm", "in"])
@pytest.mark.parametrize("metres", [(0.25, 0.12, 0.065), (0.005, 0.002, 0.002), (20, 5, 4.5), (0.02, 60, 30)])
def test_bricks_models_and_monuments(unit: str, metres: tuple[float, float, float], tmp_path: Path) -> None:
    assert remarks(tmp_path, unit, metres, {"m": 1.0, "mm": 1e3, "in": 1 / 0.0254}[unit]) == []


SOIL = """
mbla: 1
units: {{length: {unit}, force: N, mass: kg}}
materials: {{earth: {{density: 1800 kg/m^3}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
  - soil:
      group: backfill
      material: earth
      outline: [[0, 0], [{long}, 0], [{long}, "={long}/2"], [0, "={long}/2"]]
      width: 1
      cells: {{size: "={long}/{parts}"}}
      friction_angle: 30
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
"""


@pytest.mark.parametrize(
    ("unit", "long", "words"),
    [
        ("mm", 6, "soil backfill is 6 x 1 x 3 mm large, as hardly any soil is, which would be soil in m: "),
        ("m", 6000, "soil backfill is 6000 x 1 x 3000 m large, as hardly any soil is, which would be soil in mm: "),
        ("m", 60, None),
        ("m", 0.3, None),
    ],
)
@pytest.mark.parametrize("parts", [4, 20])
def test_soil_is_judged_as_a_whole(unit: str, long: float, words: str | None, parts: int, tmp_path: Path) -> None:
    (tmp_path / "soil.yaml").write_text(SOIL.format(unit=unit, long=long, parts=parts))
    model = build_model(read_deck(tmp_path / "soil.yaml"))
    found = [notice.message for notice in model.notices if notice.identifier == "block-size-unusual"]
    assert [remark[: len(words or "")] for remark in found] == ([] if words is None else [words])
