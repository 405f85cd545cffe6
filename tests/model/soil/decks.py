"""Decks with soil of cells that these tests read and build."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import pytest

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.deck.deck import Deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from mbla.model.soil.soil_mesh import SoilCorners, SoilMesh

TEXT = """mbla: 1
materials: {{stone: {{unit_weight: "24 kN/m^3"}}, earth: {{unit_weight: "18 kN/m^3"}}}}
joints: {{dry: {{friction: 0.6}}, rough: {{friction: 1.0}}}}
blocks:
{blocks}
contacts: {{joint: dry{contacts}}}
supports: {supports}
{fill}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
"""
ARCH = (
    "arch: {group: arch, material: stone, shape: segmental, span: 4, rise: 1, thickness: 0.3, voussoirs: 15, width: 2, "
    "springers: ground}"
)
LEVEL = 1.5
"""of fill on the arch, 0.2 m over its crown"""
WALL = "box: {group: wall, material: stone, min: [-0.5, 0, 0], max: [0, 1, 1]}"
FOOTING = "box: {group: footing, material: stone, min: [0.4, 0, 1], max: [0.9, 1, 1.2]}"
BACKFILL = (
    "soil: {group: backfill, material: earth, outline: [[0, 0], [1.6, 0], [1.6, 1], [0, 1]], width: 1, "
    "cells: {size: 0.3}, friction_angle: 30}"
)
GROUND = "[{ground: {z: 0}}]"
SIDEWAYS = "live: [{acceleration: [1, 0, 0]}]"


def fill(keys: str = "", cells: str = "size: 0.4", level: float = LEVEL) -> str:
    """Section `fill` on the arch."""
    more = f", {keys}" if keys else ""
    return (
        f"fill: {{soil: {{on: arch, material: earth, level: {level}, cells: {{{cells}}}, friction_angle: 30{more}}}}}"
    )


def deck(
    folder: Path, *blocks: str, fill: str = "", supports: str = "[]", contacts: str = "", loads: str = SIDEWAYS
) -> Deck:
    path = folder / "deck.yaml"
    lines = "\n".join(f"  - {block}" for block in blocks)
    text = TEXT.format(blocks=lines, fill=fill, supports=supports, contacts=contacts).replace(SIDEWAYS, loads)
    path.write_text(text, encoding="utf-8")
    return read_deck(path)


def model(
    folder: Path,
    *blocks: str,
    fill: str = "",
    supports: str = "[]",
    contacts: str = "",
    loads: str = SIDEWAYS,
    soil: Mapping[str, SoilCorners] = MappingProxyType({}),
) -> Model:
    return build_model(deck(folder, *blocks, fill=fill, supports=supports, contacts=contacts, loads=loads), soil)


def refused(folder: Path, *blocks: str, fill: str = "", supports: str = "[]") -> list[tuple[str, str]]:
    """Key and message of each fault of a deck that is refused."""
    with pytest.raises(DeckError) as caught:
        model(folder, *blocks, fill=fill, supports=supports)
    return [(fault.key, str(fault.message)) for fault in caught.value.faults]


def moved_to(soil: SoilMesh, points: FloatArray) -> dict[str, SoilCorners]:
    """Its corners at other points (n, 2), by its name."""
    return {soil.name: SoilCorners(soil.size, points, moved=True)}
