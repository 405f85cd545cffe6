"""Time histories of structures that are mirrored: forces, kinematic blocks and numbers of bodies of the whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.motion.files import written
from tests.model.shapes import write_deck

HALF = [
    "box: {group: pier, material: stone, min: [1, 0, 0], max: [2, 1, 2]}",
    "box: {group: beam, material: stone, min: [0, 0, 2], max: [2, 1, 3]}",
]
SYMMETRY = "symmetry: [{x: 0, halves: beam}]\n"
MOTION = "motion: {pulse: sine, amplitude: 0.3 g, duration: 0.5, direction: [0, 1, 1]}"


def mirrored(folder: Path, history: str) -> Model:
    written(folder, "0;0\n1;2\n2;0\n", "force.csv")
    path = write_deck(folder, HALF, loads=f"time_history: {{{history}}}")
    path.write_text(path.read_text() + SYMMETRY)
    return build_model(read_deck(path))


def test_forces_over_time_have_images(tmp_path: Path) -> None:
    force = "{on: pier, at: [2, 0.5, 1], file: force.csv, unit: N, direction: [1, 0, 0]}"
    found = mirrored(tmp_path, f"{MOTION}, forces: [{force}]")
    history = found.load_cases[0].time_history
    assert history is not None
    assert len(found.blocks) == 3
    wrenches = history.forces[0].wrenches
    assert wrenches[:, :3].tolist() == [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]
    assert wrenches[0, 6:] == pytest.approx(wrenches[2, 6:])  # an arm and a force that are both turned round
    assert history.dead_levers.shape == (3, 9)
    assert history.dead_following.shape == (3, 6)


def test_kinematic_blocks_have_images_and_grounds_new_numbers(tmp_path: Path) -> None:
    interfaces = "record: {interfaces: {foot: {between: [pier, ground]}, bed: {between: [pier, beam]}}}"
    found = mirrored(tmp_path, f"{MOTION}, rigid: [[pier, beam]], {interfaces}")
    history = found.load_cases[0].time_history
    assert history is not None
    assert [blocks.tolist() for blocks in history.rigid] == [[0, 1, 2]]
    assert [each.bodies.tolist() for each in history.interfaces] == [[0, 3], [0, 1]]


def test_a_kinematic_block_beside_the_plane_has_an_image_of_its_own(tmp_path: Path) -> None:
    blocks = [*HALF, "box: {group: pier, material: stone, min: [2, 0, 0], max: [3, 1, 2]}"]
    path = write_deck(tmp_path, blocks, loads=f"time_history: {{{MOTION}, rigid: [pier]}}")
    path.write_text(path.read_text() + SYMMETRY)
    history = build_model(read_deck(path)).load_cases[0].time_history
    assert history is not None
    assert [each.tolist() for each in history.rigid] == [[0, 2], [3, 4]]


def test_the_base_moves_as_it_did(tmp_path: Path) -> None:
    history = mirrored(tmp_path, MOTION).load_cases[0].time_history
    assert history is not None
    assert history.base_acceleration(0.125) == pytest.approx(0.3 * 9.81 * np.sqrt(0.5) * np.array([0.0, 1.0, 1.0]))
