"""A small working deck that the tests of the deck stage change one thing in."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError

BLOCK = """mbla: 1
title: A block on the ground
units: {length: m, force: N, mass: kg}
parameters: {mu: 0.6}
materials:
  stone: {density: 2000}
joints:
  dry: {friction: "=mu"}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
contacts: {joint: dry}
supports:
  - {ground: {z: 0}}
load_cases:
  push:
    live: [{acceleration: [1, 0, 0]}]
"""


def changed(old: str, new: str) -> str:
    """The working deck with one thing replaced."""
    assert BLOCK.count(old) == 1
    return BLOCK.replace(old, new)


def write(folder: Path, text: str, name: str = "deck.yaml") -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="")
    return path


def refusal(path: Path, *overrides: str) -> DeckError:
    """The error of a deck that must be refused."""
    with pytest.raises(DeckError) as caught:
        read_deck(path, overrides)
    return caught.value


def faults(path: Path, *overrides: str) -> list[str]:
    """Place, key and identifier of each fault of a deck that must be refused, without the folder."""
    found = refusal(path, *overrides).faults
    return [f"{fault.place} {fault.key} [{fault.identifier}]".replace(f"{path.parent}/", "") for fault in found]
