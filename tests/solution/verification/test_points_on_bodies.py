"""Contact points on record against vertices and faces of their bodies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.solution.verification.points_on_bodies import distances_from_bodies
from tests.line import HEAD


def test_points_of_a_face_are_on_it_and_others_as_far_as_they_are(tmp_path: Path) -> None:
    """A corner, the middle of a face, above it, the centroid, of the ground, and off an edge of the second block."""
    (deck := tmp_path / "deck.yaml").write_text(
        f"{HEAD}blocks:\n"
        "  - box: {material: stone, min: [0, 0, 0], max: [2, 1, 1]}\n"
        "  - box: {material: stone, min: [5, 0, 0], max: [6, 4, 1]}\n"
        "joints: {dry: {friction: 0.6}}\nsupports: [{ground: {z: 0}}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n",
        encoding="utf-8",
    )
    blocks = build_model(read_deck(deck)).blocks
    arms = np.array([[1, 0.5, 0.5], [0, 0, 0.5], [0, 0, 0.7], [0, 0, 0], [7, 7, 7], [0, 2.3, 0.9]])
    found = distances_from_bodies(blocks, np.array([0, 0, 0, 0, 2, 1]), arms)
    sizes = blocks.sizes[[0, 0, 0, 0, 0, 1]]
    assert found * sizes == pytest.approx([0.0, 0.0, 0.2, 0.5, 0.0, 0.5], abs=1e-12)
