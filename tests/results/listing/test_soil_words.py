"""Soil of cells in words: it is no set of blocks."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import mbla
from mbla.model.model import Model
from mbla.results.listing.places import counted_blocks, counted_of, group_words
from mbla.results.listing.sections.model_words import model_sections
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import section_lines
from mbla.results.listing.verdict_words import NO_RANGE, OF_SOIL, soil_flow_words
from tests.model.soil.decks import ARCH, BACKFILL, GROUND, WALL, fill, model

DECK = """mbla: 1
materials: {stone: {density: 2000}, earth: {density: 1800}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [3, 1, 1]}
contacts: {joint: dry}
supports: [{blocks: base}]
fill: {soil: {on: base, material: earth, level: 2, cells: {size: 1}, friction_angle: 10}}
load_cases:
  strip: {live: [{travel: {force: [0, 0, -1], contact: 0.5, path: [[1, 0.5, 2], [2, 0.5, 2]], positions: 2}}]}
analysis: {soil_range: false}
"""


def test_counts_tell_soil_beside_blocks(tmp_path: Path) -> None:
    found = model(tmp_path, WALL, BACKFILL, supports=GROUND)
    cells = len(found.blocks) - 1
    assert counted_blocks(found) == f"1 block, soil backfill of {cells} cells"
    assert counted_of(found, np.arange(3), "free block") == "1 free block and 2 cells of soil backfill"
    assert counted_of(found, np.arange(1, 3)) == "2 cells of soil backfill"
    assert counted_of(found, np.arange(0)) == "0 blocks"


def test_a_soil_that_is_called_so_is_not_named_twice(tmp_path: Path) -> None:
    found = model(tmp_path, ARCH, fill=fill())
    assert counted_blocks(found) == f"15 blocks, soil of {len(found.blocks) - 15} cells"


def test_parts_of_soil_are_wedges(tmp_path: Path) -> None:
    found = model(tmp_path, WALL, BACKFILL, supports=GROUND)
    assert group_words(found, np.array([1, 3, 4])) == "a wedge of soil backfill, 3 cells"
    assert group_words(found, np.array([0, 2])) == "wall[0] and a wedge of soil backfill, 1 cell"


def test_the_law_on_ground_is_that_of_the_soil_under_it(tmp_path: Path) -> None:
    supports = "[{ground: {z: 0}, blocks: backfill}]"
    assert "rigid ground z = 0 with joint law backfill, under soil backfill only" in _words(
        model(tmp_path, WALL, BACKFILL, supports=supports)
    )
    assert "rigid ground z = 0 with joint law dry, backfill under soil\n" in _words(
        model(tmp_path, WALL, BACKFILL, supports=GROUND)
    )


def test_the_model_lists_soil_apart(tmp_path: Path) -> None:
    words = _words(model(tmp_path, WALL, BACKFILL, supports=GROUND))
    assert "1, of them 1 free and 0 fixed" in words
    assert "joint law backfill, to other blocks" in " ".join(words.split())


def test_the_figure_of_soil_is_told_as_that_of_associative_flow() -> None:
    rules = ("analysis.flow_rule=associative", "analysis.flow_rule=non_associative")
    by_bounds, by_path = (mbla.run(DECK, set=[each]).records for each in rules)
    assert soil_flow_words(by_bounds.model, by_bounds.cases[0]) == OF_SOIL + NO_RANGE
    assert OF_SOIL[:40] in "\n".join(summary_lines(by_bounds))
    assert not soil_flow_words(by_path.model, by_path.cases[0])


def _words(found: Model) -> str:
    return "\n".join(section_lines(model_sections(found)))
