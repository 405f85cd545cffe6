"""Surfaces that support, as a polygon, in a file of their own, and among the blocks of a mesh: closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.process.run_options import RunOptions
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.results import Results
from mbla.run import run
from mbla.verify import verify_file
from tests.contacts.structures import any_rotation
from tests.line import factor_of, line_of

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
SHEET = np.array([[-2, -2, 0], [0.7, -2, 0], [0.7, 3, 0], [-2, 3, 0]], dtype=float)
"""carries the cube as far as x = 0.7"""


def at(x: float, y: float, z: float) -> FloatArray:
    return np.asarray(CUBE + np.array([x, y, z]))


def rows(points: FloatArray) -> str:
    return str(points.tolist())


def deck_of(
    supports: str, *blocks: FloatArray, friction: float = 0.9, along: FloatArray | None = None, down: str = ""
) -> str:
    """Cubes with these corners, pushed along x unless another direction is given."""
    items = "".join(
        f"  - polyhedron: {{group: stone, material: stone, vertices: {rows(block)}, faces: {[*map(list, FACES)]}}}\n"
        for block in blocks or (CUBE,)
    )
    push = np.array([1.0, 0.0, 0.0]) if along is None else along
    return (
        "mbla: 1\nmaterials: {stone: {density: 2000}}\n"
        f"joints: {{dry: {{friction: {friction}}}, ice: {{friction: 0.05}}}}\n"
        f"blocks:\n{items}contacts: {{joint: dry}}\nsupports: {supports}\n"
        f"load_cases: {{push: {{{down}live: [{{acceleration: {push.tolist()}}}]}}}}\n"
    )


def obj_of(**objects: tuple[FloatArray, tuple[tuple[int, ...], ...]]) -> str:
    text, first = "", 1
    for name, (points, faces) in objects.items():
        text += f"o {name}\n" + "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
        text += "".join(f"f {' '.join(str(first + corner) for corner in face)}\n" for face in faces)
        first += len(points)
    return text


def mesh_deck(folder: Path, keys: str, text: str, supports: str = "[]") -> Path:
    (folder / "stones.obj").write_text(text, encoding="utf-8")
    path = folder / "deck.yaml"
    path.write_text(
        "mbla: 1\nmaterials: {stone: {density: 2000}}\njoints: {dry: {friction: 0.9}}\nblocks:\n"
        f"  - mesh: {{group: stone, material: stone, file: stones.obj{keys}}}\n"
        f"contacts: {{joint: dry}}\nsupports: {supports}\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n",
        encoding="utf-8",
    )
    return path


def results_of(path: Path) -> Results:
    return run(path, RunOptions(folder=path.parent / "out", force=True))


def figure(results: Results) -> float:
    (case,) = results.cases
    assert case.checks.verified
    assert case.solution.mechanics is not None
    return case.solution.mechanics.load_factor


def test_a_block_turns_about_the_edge_of_a_surface() -> None:
    # 0.2 of its width before the edge, 0.5 high
    assert factor_of(deck_of(f"[{{surface: {{polygon: {rows(SHEET)}}}}}]")) == pytest.approx(0.4, rel=1e-6)
    # the other way its own edge comes first
    away = factor_of(deck_of(f"[{{surface: {{polygon: {rows(SHEET)}}}}}]", along=np.array([-1.0, 0.0, 0.0])))
    assert away == pytest.approx(0.9, rel=1e-5)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("reverse", [False, True])
def test_turned_with_its_gravity_reversed_and_scaled(scale: float, *, reverse: bool) -> None:
    turn, shift = any_rotation(3), np.array([3.0, -2.0, 5.0])
    sheet, cube = ((points @ turn.T + shift) * scale for points in (SHEET, CUBE))
    down = f"dead: [{{gravity: {(turn @ [0, 0, -9.81]).tolist()}}}], "
    text = deck_of(
        f"[{{surface: {{polygon: {rows(sheet[::-1] if reverse else sheet)}}}}}]", cube, along=turn[:, 0], down=down
    )
    assert factor_of(text) == pytest.approx(0.4, rel=1e-6)


@pytest.mark.parametrize("friction", [0.5, 0.7])
def test_a_block_slides_down_an_inclined_surface(friction: float) -> None:
    angle = np.radians(20)
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    flat = np.array([[-1, -1, 0], [3, -1, 0], [3, 3, 0], [1, 4, 0], [-1, 3, 0]], dtype=float)
    block = CUBE * [1, 1, 0.5]
    found = factor_of(deck_of(f"[{{surface: {{polygon: {rows(flat @ turn.T)}}}}}]", block @ turn.T, friction=friction))
    assert found == pytest.approx(np.tan(np.arctan(friction) - angle), rel=1e-5)


def test_blocks_reach_below_the_plane_of_a_bounded_surface() -> None:
    # a shelf at half height carries one block, ground below it another that stands beside and in front of the shelf
    shelf = "{surface: {polygon: [[0, 0, 1], [2, 0, 1], [2, 1, 1], [0, 1, 1]]}}"
    low = "{surface: {polygon: [[2, 0, 0], [9, 0, 0], [9, 1, 0], [2, 1, 0]]}}"
    text = deck_of(f"[{shelf}, {low}]", at(0.5, 0, 1), at(4, 0, 0))
    assert factor_of(text) == pytest.approx(0.9, rel=1e-5)
    with pytest.raises(DeckError, match="blocks reach below it"):
        factor_of(text.replace(shelf, "{ground: {z: 1}}"))


def test_surfaces_have_a_joint_law_and_blocks_of_their_own() -> None:
    wide = rows(SHEET * [3, 1, 1])
    assert factor_of(deck_of(f"[{{surface: {{polygon: {wide}}}, joint: ice}}]")) == pytest.approx(0.05, rel=1e-5)
    two = CUBE, at(0, 1.5, 0)
    chosen = deck_of(f"[{{surface: {{polygon: {wide}}}, blocks: {{group: stone, index: 0}}}}]", *two)
    with pytest.raises(AssertionError):  # the other one hangs in the air
        factor_of(chosen)
    law = "contacts: {joint: dry, overrides: [{between: [ground, stone], joint: ice}]}"
    text = deck_of(f"[{{surface: {{polygon: {wide}}}}}]").replace("contacts: {joint: dry}", law)
    assert factor_of(text) == pytest.approx(0.05, rel=1e-5)


def test_a_surface_carries_from_both_sides() -> None:
    # a block on the plate, and one beside it that touches it from below and rests on ground
    plate = rows(np.array([[-1, -1, 0], [4, -1, 0], [4, 2, 0], [-1, 2, 0]]))
    below = CUBE * [1, 1, 0.5] - [-2, 0, 0.5]
    text = deck_of(f"[{{surface: {{polygon: {plate}}}}}, {{ground: {{z: -0.5}}}}]", CUBE, below)
    model = line_of(text).model
    assert [ground.label.endswith("other side") for ground in model.grounds] == [False, False, True]
    assert model.grounds[1].normal == pytest.approx(-model.grounds[2].normal)
    assert factor_of(text) == pytest.approx(0.9, rel=1e-5)
    with pytest.raises(DeckError, match="hold the same piece"):
        factor_of(deck_of(f"[{{surface: {{polygon: {plate}}}}}]", CUBE, CUBE - [0, 0, 1]))


@pytest.mark.every(2)
@pytest.mark.parametrize(
    "keys",
    [", supports: [ground]", ", flat_faces: supports", ", leave_out: [ground]", ", members: [low, high]"],
)
def test_a_flat_face_among_the_blocks_of_a_file(tmp_path: Path, keys: str) -> None:
    ground = (SHEET * [3, 1, 1], ((0, 1, 2), (0, 2, 3)))
    text = obj_of(low=(CUBE, FACES), high=(at(0, 0, 1), FACES), ground=ground)
    own = "supports" not in keys
    supports = "[{surface: {file: stones.obj, members: [ground]}}]" if own else "[]"
    results = results_of(mesh_deck(tmp_path, keys, text, supports))
    assert figure(results) == pytest.approx(0.5, rel=1e-6)
    (carrying,) = results.model.grounds
    assert carrying.label == "surface ground"
    assert carrying.outline is not None
    assert len(carrying.outline) == 4
    again = read_results_hdf5(tmp_path / "out" / "deck.h5")
    assert np.array_equal(np.array(again.model.grounds[0].outline), carrying.outline)
    assert not verify_file(tmp_path / "out" / "deck.h5")[1]


def test_a_file_without_names(tmp_path: Path) -> None:
    text = obj_of(a=(CUBE, FACES), b=(SHEET, ((0, 1, 2, 3), (3, 2, 1, 0))))
    bare = "\n".join(line for line in text.splitlines() if not line.startswith("o "))
    assert figure(results_of(mesh_deck(tmp_path, ", flat_faces: supports", bare))) == pytest.approx(0.4, rel=1e-6)


def test_what_the_file_has_is_moved_and_copied_with_it(tmp_path: Path) -> None:
    text = obj_of(low=(CUBE * 1000, FACES), ground=(SHEET * 1000, ((0, 1, 2, 3),)))
    keys = (
        ", units: mm, flat_faces: supports, repeat: {count: 2, translate: [0, 20, 0]},"
        " transform: [{rotate: {axis: [0, 0, 1], angle: 180}}, {translate: [1, 1, 7]}]"
    )
    results = results_of(mesh_deck(tmp_path, keys, text))
    assert [len(results.contacts), len(results.model.grounds)] == [2, 2]
    assert figure(results) == pytest.approx(0.9, rel=1e-5)  # slides; turned by 180 degrees it stands on its edge


def test_a_terrain_of_many_flat_parts(tmp_path: Path) -> None:
    # two planes at an angle, each of two triangles, and a block on the level one
    points = np.array([[-1, -1, 0], [0.7, -1, 0], [0.7, 2, 0], [-1, 2, 0], [3, -1, -1], [3, 2, -1]], dtype=float)
    terrain = (points, ((0, 1, 2), (0, 2, 3), (1, 4, 5), (1, 5, 2)))
    text = obj_of(low=(CUBE, FACES), terrain=terrain)
    results = results_of(mesh_deck(tmp_path, ", supports: [terrain]", text))
    assert figure(results) == pytest.approx(0.4, rel=1e-6)
    assert len(results.model.grounds) == 1


def test_the_mirrored_half(tmp_path: Path) -> None:
    half = "[[-0.2, -1, 0], [0.3, -1, 0], [0.3, 0.5, 0], [-0.2, 0.5, 0]]"
    text = deck_of(f"[{{surface: {{polygon: {half}}}}}]", CUBE * [1, 0.5, 1] - [0.5, 0, 0], friction=2.0)
    text += "symmetry: [{y: 0.5, halves: stone}]\n"
    # on x from -0.2 to 0.3, whole block of width 1 in y
    assert factor_of(text) == pytest.approx(0.6, rel=1e-6)
    path = tmp_path / "deck.yaml"
    path.write_text(text.replace("[-0.2, 0.5, 0]", "[-0.2, 2, 0]").replace("[0.3, 0.5, 0]", "[0.3, 2, 0]"))
    model = build_model(read_deck(path))
    assert len(model.grounds) == 1  # it lies across the mirror, alike on both sides
    assert find_contacts(model, read_deck(path).contacts).areas.sum() == pytest.approx(0.5)


def test_pressure_acts_beside_a_surface_only() -> None:
    # 0.3 of the base is free: 1 N/m2 from below lifts there
    text = deck_of(f"[{{surface: {{polygon: {rows(SHEET)}}}}}]").replace(
        "acceleration: [1.0, 0.0, 0.0]", "pressure: {value: 1}, on: stone"
    )
    model = line_of(text).model
    assert model.load_cases[0].live_load[0, :3] == pytest.approx([0, 0, -0.7])


def test_rocking_about_the_edge_of_a_surface(tmp_path: Path) -> None:
    text = deck_of(f"[{{surface: {{polygon: {rows(SHEET)}}}}}]", friction=2.0)
    path = tmp_path / "deck.yaml"
    path.write_text(text.replace("live: [", "pushover: {step: 0.02, until: 0.1}, live: ["), encoding="utf-8")
    results = results_of(path)
    (case,) = results.cases
    # its centroid, 0.2 before the edge and 0.5 above, turns about the edge: the overhang over the height is left
    radius = np.hypot(0.2, 0.5)
    assert len(case.solution.further.pushover.curve) > 4
    for row in case.solution.further.pushover.curve:
        left = 0.2 - row.displacement
        assert row.load_factor == pytest.approx(left / np.sqrt(radius**2 - left**2), rel=1e-3), row
    assert not verify_file(tmp_path / "out" / "deck.h5")[1]


@pytest.mark.parametrize("lift", [1e-5, 0.01, 0.3])
def test_a_bent_quadrilateral_is_taken_as_two_triangles(tmp_path: Path, lift: float) -> None:
    # one corner of the sheet lies higher, the block stands beyond the shorter diagonal
    bent = SHEET.copy()
    bent[3] = [-3, 4, lift]
    text = obj_of(low=(CUBE * [0.5, 1, 1] - [-0.1, 1.8, 0], FACES), ground=(bent, ((0, 1, 2, 3),)))
    results = results_of(mesh_deck(tmp_path, ", supports: [ground]", text))
    (ground,) = results.model.grounds
    assert ground.outline is not None
    assert len(ground.outline) == (4 if lift < 1e-4 else 3)
    assert figure(results) == pytest.approx(0.5, rel=1e-3)
