"""Haunches of arches and barrel vaults: what they fill, what they stand on, that they touch what they should."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.contacts import Contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model

DECK = """mbla: 1
materials: {{stone: {{density: 2400}}}}
joints: {{dry: {{friction: 0.7}}}}
blocks: [{block}]
contacts: {{joint: dry}}
supports: {supports}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
"""
ARCH = (
    "arch: {{group: arch, material: stone, shape: {shape}, span: 4, thickness: 0.4, width: 2, voussoirs: 21, "
    "skew: {skew}, springers: {springers}{piers}, backing: {{top: {top}, unit: [0.6, 0.3]{width}}}}}"
)
VAULT = (
    "barrel_vault: {group: vault, material: stone, shape: semicircular, span: 4, thickness: 0.4, length: 3, "
    "courses: 15, unit: 0.7, springers: blocks, backing: {top: 1.2, unit: [0.6, 0.3], width: 0.5}}"
)
PIERS = ", piers: {height: 2, width: 1.2, courses: 3}"


def built(folder: Path, block: str, supports: str = "[]") -> tuple[Model, Contacts]:
    path = folder / "deck.yaml"
    path.write_text(DECK.format(block=f"{{{block}}}", supports=supports))
    deck = read_deck(path)
    model = build_model(deck)
    return model, build_assembly(deck, model).contacts


def backing(model: Model) -> np.ndarray:
    return np.array([member == "backing" for member in model.blocks.labels.members])


def area_beside(outer: float, joints: int, half: float, base: float, top: float) -> float:
    """Between the chords of a circle about the origin and a level top, from the chord's end out to ``half``, one side.

    Angles from the crown to where the outer corner has the height ``base``, by thin upright strips.
    """
    last = np.arccos(base / outer)
    angles = np.linspace(-last, last, joints + 1)
    x, z = outer * np.sin(angles), outer * np.cos(angles)
    places = np.linspace(0.0, half, 400001)
    heights = np.where(places > x[-1], base, np.interp(places, x, z))
    return float(np.trapezoid(np.maximum(top - heights, 0.0), places))


@pytest.mark.parametrize(("skew", "springers"), [(0, "ground"), (20, "ground"), (0, "blocks")])
@pytest.mark.parametrize("top", [1.3, 2.9])
def test_they_fill_what_lies_beside_a_semicircle(tmp_path: Path, skew: int, springers: str, top: float) -> None:
    block = ARCH.format(shape="semicircular", skew=skew, springers=springers, piers="", top=top, width=", width: 0.8")
    model, contacts = built(tmp_path, block)
    chosen = backing(model)
    area = area_beside(2.4, 21, 3.2, 0.0, top)
    assert model.blocks.volumes[chosen].sum() == pytest.approx(2 * 2 * area, rel=1e-5)
    report = contacts.report
    assert not len(report.near_misses) + len(report.overlaps) + len(report.isolated) + len(report.slivers)
    assert not report.unsupported


def test_on_piers_of_a_segmental_arch(tmp_path: Path) -> None:
    """Out to the backs of the piers, on the springers of the inclined joints."""
    block = ARCH.format(shape="segmental, rise: 1", skew=0, springers="none", piers=PIERS, top=1.0, width="")
    model, contacts = built(tmp_path, block, "[{ground: {z: -2}}]")
    chosen = backing(model)
    area = area_beside(2.9, 21, 3.2, 2.9 * 1.5 / 2.5, 2.5)  # the circle has its middle 1.5 below the springings
    assert model.blocks.volumes[chosen].sum() == pytest.approx(2 * 2 * area, rel=1e-5)
    ends = model.blocks.vertices[np.isin(model.blocks.block_of_vertex, np.flatnonzero(chosen)), 0]
    assert (ends.min(), ends.max()) == pytest.approx((-1.2, 5.2))
    report = contacts.report
    assert not len(report.near_misses) + len(report.overlaps) + len(report.isolated) + len(report.slivers)
    assert not report.unsupported


def test_of_a_barrel_vault(tmp_path: Path) -> None:
    """In units along the vault, which itself is a member then."""
    model, contacts = built(tmp_path, VAULT)
    chosen = backing(model)
    area = area_beside(2.4, 15, 2.9, 0.0, 1.2)
    assert model.blocks.volumes[chosen].sum() == pytest.approx(2 * 3 * area, rel=1e-5)
    lengths = [
        np.ptp(model.blocks.vertices[model.blocks.block_of_vertex == block, 1]) for block in np.flatnonzero(chosen)
    ]
    assert max(lengths) == pytest.approx(0.7)
    assert set(model.blocks.labels.members) == {"barrel", "backing", ""}
    assert not contacts.report.unsupported
