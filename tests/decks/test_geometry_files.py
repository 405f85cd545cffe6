"""Decks of geometry from files: one arch from every kind of file, and the two exported structures."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.cli import main
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from tests.analytic.planar import arch_load_factor, polygon_arch
from tests.decks.folder import BENCHMARKS, DECKS

ARCHES = [path for name, path in BENCHMARKS.items() if name.startswith("arch_from_")]
SINGLE = ("stl",)
"""kinds of files with coordinates in single precision"""


def kind(path: Path) -> str:
    return path.stem.removeprefix("arch_from_")


@pytest.mark.parametrize("path", ARCHES, ids=kind)
def test_volume_and_contacts_are_those_of_the_generator(path: Path) -> None:
    deck = read_deck(path)
    model = build_model(deck)
    each = 0.5 * np.sin(np.pi / 9) * (2.6**2 - 2.0**2)
    precision = 1e-6 if kind(path) in SINGLE else 1e-9
    assert model.blocks.volumes == pytest.approx([each] * 9, rel=precision)
    contacts = find_contacts(model, deck.contacts)
    assert contacts.areas == pytest.approx([0.6] * 10, rel=precision)
    assert len(contacts.points) == 40


@pytest.mark.parametrize("path", ARCHES, ids=kind)
def test_the_load_factor_expected_is_that_of_the_planar_program(path: Path) -> None:
    """That each deck gives what it expects, to 1e-6, is held with all decks (``test_decks``)."""
    expected = read_deck(path).content.expected["push"]
    factor = arch_load_factor(polygon_arch(2.0, 2.6, np.pi, 9), 0.7)
    scale = 2000 * 9.81 if kind(path) == "tables" else 1.0
    assert factor is not None
    assert expected.load_factor == pytest.approx(factor * scale, rel=1e-8)
    assert expected.tolerance == 1e-6


# What the comments of the two exported structures say about contacts.tolerance.


def check(
    deck: str, tolerance: float, capsys: pytest.CaptureFixture[str]
) -> tuple[int, dict[str, Any], dict[str, str]]:
    """Exit status and JSON of ``mbla check``, and its notices by their identifiers."""
    path = DECKS / "tutorials" / f"{deck}.yaml"
    status = main(["check", str(path), "--json", "--set", f"contacts.tolerance={tolerance}"])
    record: dict[str, Any] = json.loads(capsys.readouterr().out)
    return status, record, {notice["identifier"]: notice["message"] for notice in record.get("notices", [])}


@pytest.mark.parametrize("tolerance", [1.2e-3, 2e-3, 5e-3, 1e-2])
def test_the_vault_has_the_same_contacts_over_a_decade(tolerance: float, capsys: pytest.CaptureFixture[str]) -> None:
    status, record, notices = check("crossvault", tolerance, capsys)
    model = record["model"]
    assert (status, model["blocks"], model["free_blocks"], model["interfaces"]) == (0, 184, 180, 488)
    assert not {"near-misses", "isolated-blocks"} & notices.keys()
    assert tolerance != 2e-3 or notices["slivers-dropped"].startswith("15 common surfaces")


@pytest.mark.parametrize(("tolerance", "overlapping"), [(1e-4, 6), (1e-3, 1)])
def test_the_vault_is_refused_where_its_blocks_overlap(
    tolerance: float, overlapping: int, capsys: pytest.CaptureFixture[str]
) -> None:
    status, record, _ = check("crossvault", tolerance, capsys)
    assert status == 3
    (message,) = record["errors"]
    assert ("overlap by" if overlapping == 1 else f"{overlapping} pairs of blocks overlap, ") in message


@pytest.mark.parametrize(("tolerance", "near_misses"), [(1e-4, 0), (1e-3, 0), (1e-2, 31)])
def test_the_wall_touches_in_its_bed_joints_only(
    tolerance: float, near_misses: int, capsys: pytest.CaptureFixture[str]
) -> None:
    status, record, notices = check("obj_wall", tolerance, capsys)
    assert (status, record["model"]["blocks"], record["model"]["interfaces"]) == (0, 38, 65)
    assert "slivers-dropped" not in notices
    assert notices.get("near-misses", "0").split()[0] == str(near_misses)
