"""One arch from files of every kind: every deck has the generator's blocks, contacts and load factor."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from tests.analytic.planar import arch_load_factor, polygon_arch
from tests.decks.folder import BENCHMARKS

DECKS = [path for name, path in BENCHMARKS.items() if name.startswith("arch_from_")]
SINGLE = ("stl", "gltf")
"""kinds of files with coordinates in single precision"""


def kind(path: Path) -> str:
    return path.stem.removeprefix("arch_from_")


@pytest.mark.parametrize("path", DECKS, ids=kind)
def test_volume_and_contacts_are_those_of_the_generator(path: Path) -> None:
    deck = read_deck(path)
    model = build_model(deck)
    each = 0.5 * np.sin(np.pi / 9) * (2.6**2 - 2.0**2)
    precision = 1e-6 if kind(path) in SINGLE else 1e-9
    assert model.blocks.volumes == pytest.approx([each] * 9, rel=precision)
    contacts = find_contacts(model, deck.contacts)
    assert contacts.areas == pytest.approx([0.6] * 10, rel=precision)
    assert len(contacts.points) == 40


@pytest.mark.parametrize("path", DECKS, ids=kind)
def test_the_load_factor_expected_is_that_of_the_planar_program(path: Path) -> None:
    """That each deck gives what it expects, to 1e-6, is held with all decks (``test_decks``)."""
    expected = read_deck(path).content.expected["push"]
    factor = arch_load_factor(polygon_arch(2.0, 2.6, np.pi, 9), 0.7)
    scale = 2000 * 9.81 if kind(path) == "tables" else 1.0
    assert factor is not None
    assert expected.load_factor == pytest.approx(factor * scale, rel=1e-8)
    assert expected.tolerance == 1e-6
