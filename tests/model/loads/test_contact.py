"""Axles with a length along their way: an even pressure on what lies under it, on blocks, in fill and on soil."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import shapely

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.deck.deck import Deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.loads.test_line import resultant
from tests.model.soil.decks import moved_to

DECK = """mbla: 1
materials: {{stone: {{density: 2000}}, earth: {{density: 1800}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
{blocks}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
vehicles: {{cart: {{force: [0, 0, -10], wheels: {{gauge: 2, contact: [0.3, 0.4]}}}}}}
{fill}
load_cases: {{push: {{live: [{load}]}}}}
"""
FIELD = [
    f"box: {{group: row, material: stone, min: [{x}, {y}, 0], max: [{x + 1}, {y + 1}, 1]}}"
    for x in range(4)
    for y in range(3)
]
PATH = "path: [[1.9, 1.4, 1], [2.1, 1.5, 1]], positions: 2"
SOIL = "cells: {size: 0.45}, friction_angle: 30"
DISPERSAL = "dispersal: {law: uniform, angle: 30}"


def deck(folder: Path, load: str, fill: str = "", blocks: Sequence[str] = FIELD) -> Deck:
    """With fill to z = 1.5, if that is given."""
    text = DECK.format(
        blocks="\n".join(f"  - {block}" for block in blocks),
        fill=fill and f"fill: {{earth: {{on: row, material: earth, level: 1.5, {fill}}}}}",
        load=load,
    )
    (folder / "deck.yaml").write_text(text)
    return read_deck(folder / "deck.yaml")


def travels(folder: Path, keys: str, path: str = PATH) -> Model:
    return build_model(deck(folder, f"{{travel: {{{keys}, {path}}}}}"))


def rectangle(middle: tuple[float, float], along: tuple[float, float], length: float, width: float) -> shapely.Polygon:
    way = np.array(along) / np.linalg.norm(along)
    sides = length * way, width * np.array([-way[1], way[0]])
    corners = [np.array(middle) + a * sides[0] + b * sides[1] for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return shapely.Polygon(np.array(middle) + (np.array(corners) - middle) / 2)


def test_a_rectangle_askew_to_the_blocks(tmp_path: Path) -> None:
    """Each block has its share of the area, at the middle of that share."""
    found = travels(tmp_path, "force: [0, 0, -10], contact: 0.8, width: 1.5")
    pressed = rectangle((1.9, 1.4), (2, 1), 0.8, 1.5)
    load = found.load_cases[0].live_load
    for block, centroid in enumerate(found.blocks.centroids):
        part = shapely.intersection(pressed, shapely.box(*(centroid[:2] - 0.5), *(centroid[:2] + 0.5)))
        force = 10 * part.area / pressed.area
        assert load[block, 2] == pytest.approx(-force, abs=1e-9)
        if force:
            arm = np.array(part.centroid.coords[0]) - centroid[:2]
            assert load[block, 3:5] == pytest.approx([-arm[1] * force, arm[0] * force], abs=1e-9)
    assert resultant(found, load) == pytest.approx([0, 0, -10, -14, 19, 0], abs=1e-9)
    assert "on 0.8 m along its way on 6 blocks" in found.load_cases[0].live_words[0]


def test_a_length_without_a_width_is_a_line_along_the_way(tmp_path: Path) -> None:
    straight = "path: [[1.9, 1.4, 1], [2.9, 1.4, 1]], positions: 2"
    found = travels(tmp_path, "force: [0, 0, -10], contact: 0.8", straight)
    loads = -found.load_cases[0].live_load[:, 2].reshape(4, 3)
    assert loads[:, 1] == pytest.approx([0, 6.25, 3.75, 0])
    assert loads.sum() == pytest.approx(10)


def test_in_fill_two_places_stand_for_it(tmp_path: Path) -> None:
    """They have the second moment of the length, and spread each as a line of the width does."""

    def load(keys: str, x: float) -> FloatArray:
        path = f"path: [[{x}, 1.5, 2], [{x + 0.1}, 1.5, 2]], positions: 2"
        load = f"{{travel: {{force: [0, 0, -10], width: 1, {path}{keys}}}, through: earth}}"
        return build_model(deck(tmp_path, load, DISPERSAL)).load_cases[0].live_load

    apart = 0.6 / np.sqrt(12)
    expected = (load("", 1.9 - apart) + load("", 1.9 + apart)) / 2
    assert load(", contact: 0.6", 1.9) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("keys", ["width: 1, contact: 0.3", "contact: 0.3", "wheels"])
def test_on_soil_it_presses_on_the_tops_of_cells_under_it(tmp_path: Path, keys: str) -> None:
    """By their lengths within the contact, wherever the mesh has its corners."""
    given = "vehicle: cart" if keys == "wheels" else f"force: [0, 0, -10], {keys}"
    path = "path: [[0.37, 1.5, 1.5], [3.2, 1.5, 1.5]], positions: 5"
    read = deck(tmp_path, f"{{travel: {{{given}, {path}}}}}", SOIL)
    (soil,) = build_model(read).soils
    on_top = np.isclose(soil.points[:, 1], 1.5) & ~soil.fixed
    moved = soil.points + np.outer(on_top, [0.06, 0.0])
    for found in (build_model(read), build_model(read, moved_to(soil, moved))):
        (soil,) = found.soils
        tops = soil.points[soil.triangles]
        for case in found.load_cases:
            x = case.question.place.point[0]
            expected = np.zeros(len(found.blocks))
            for block, corners in zip(soil.blocks.tolist(), tops, strict=True):
                ends = np.sort(corners[np.isclose(corners[:, 1], 1.5), 0])
                if len(ends) == 2:
                    expected[block] = max(0.0, min(ends[1], x + 0.15) - max(ends[0], x - 0.15)) / 0.3 * 10
            assert -case.live_load[:, 2] == pytest.approx(expected, abs=1e-9)
            assert resultant(found, case.live_load) == pytest.approx([0, 0, -10, -15, 10 * x, 0], abs=1e-8)
            assert "on soil earth, position" in case.live_words[0]


def test_a_joint_that_is_not_quite_closed_is_no_gap(tmp_path: Path) -> None:
    blocks = [*FIELD[:3], *(each.replace("min: [1,", "min: [1.0005,") for each in FIELD[3:])]
    path = "path: [[1, 1.5, 1], [1.5, 1.5, 1]], positions: 2"
    given = f"{{travel: {{force: [0, 0, -10], contact: 0.4, width: 1, {path}}}}}"
    load = build_model(deck(tmp_path, given, blocks=blocks)).load_cases[0].live_load
    assert load[:, 2].sum() == pytest.approx(-10)
    assert load[1, 2] == pytest.approx(-5, abs=0.01)


def test_what_reaches_past_the_blocks_is_refused(tmp_path: Path) -> None:
    """Else part of the load were lost, or pressed more on the rest than there is room for."""
    with pytest.raises(DeckError, match=r"position 1 of 2, at \(0.1, 1.5, 1\) m, lies over no block with a part of it"):
        travels(
            tmp_path, "force: [0, 0, -10], contact: 0.4, width: 1", "path: [[0.1, 1.5, 1], [2, 1.5, 1]], positions: 2"
        )


def test_what_axles_stand_on(tmp_path: Path) -> None:
    """Of both wheels a rectangle with half of the force; the factor of the load is in it."""
    found = build_model(deck(tmp_path, "{vehicle: {name: cart, at: [2.1, 1.5, 1]}, factor: 3}"))
    (load,) = found.load_cases[0].live
    assert load.patches.forces.tolist() == [[0, 0, -15]] * 2
    assert load.patches.corners.mean(axis=1) == pytest.approx(np.array([[2.1, 0.5, 1], [2.1, 2.5, 1]]))
    assert np.ptp(load.patches.corners[0], axis=0) == pytest.approx([0.3, 0.4, 0])
    assert found.blocks.centroids[load.patches.blocks, :2].tolist() == [[2.5, 0.5], [2.5, 2.5]]
    assert not load.patches.spreads
    on_fill = "{vehicle: {name: cart, at: [2.1, 1.5, 9]}, through: earth}"
    (load,) = build_model(deck(tmp_path, on_fill, DISPERSAL)).load_cases[0].live
    assert load.patches.spreads
    assert load.patches.corners[..., 2] == pytest.approx(1.5)


def test_in_a_mirror_axles_stand_on_both_sides(tmp_path: Path) -> None:
    path = tmp_path / "deck.yaml"
    deck(tmp_path, "{vehicle: {name: cart, at: [2.1, 1.5, 1]}}")
    path.write_text(f"{path.read_text()}symmetry: [{{x: 0}}]\n")
    found = build_model(read_deck(path))
    (load,) = found.load_cases[0].live
    assert load.patches.corners[:, :, 0].mean(axis=1) == pytest.approx([2.1, 2.1, -2.1, -2.1])
    assert load.patches.forces.sum(axis=0) == pytest.approx(load.wrenches[:, :3].sum(axis=0))
    assert found.blocks.centroids[load.patches.blocks, 0].tolist() == [2.5, 2.5, -2.5, -2.5]
