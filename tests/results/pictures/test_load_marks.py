from dataclasses import replace

import numpy as np
import pytest

from mbla.model.model import TravelPosition
from mbla.results.pictures.load_marks import load_marks
from tests.results.synthetic import G, tower_model

GRAVITY = ("gravity (0, 0, -9.81) m/s2",)


def wrench(force: list[float], point: list[float], block: int) -> np.ndarray:
    """A force at a point of one block of the tower model, about its centroid, (3, 6)."""
    loads = np.zeros((3, 6))
    loads[block, :3] = force
    loads[block, 3:] = np.cross(np.array(point) - tower_model().blocks.centroids[block], force)
    return loads


@pytest.mark.parametrize(
    ("force", "point", "tip"),
    [
        ([5, 0, 0], [0.0, 0.5, 2.7], [0.0, 0.5, 2.7]),
        ([5, 0, 0], [0.8, 0.5, 2.7], [0.0, 0.5, 2.7]),
        ([0, 0, -3], [0.2, 0.1, 3.0], [0.2, 0.1, 3.0]),
        ([-1, 0, -1], [1.0, 0.5, 2.0], [1.0, 0.5, 2.0]),
        ([5, 0, 0], [0.5, 0.5, 7.0], [0.5, 0.5, 7.0]),
    ],
    ids=["on its face", "inside", "on top", "slanted", "outside of the block"],
)
def test_arrow_ends_where_the_force_enters_the_block(force: list[float], point: list[float], tip: list[float]) -> None:
    marks = load_marks(tower_model(), wrench(force, point, 1), ("force on tower[0]",))
    assert marks.blocks.tolist() == [1]
    assert marks.tips == pytest.approx(np.array([tip]))
    assert marks.forces == pytest.approx(np.array([force]))
    assert not len(marks.moments)
    assert not marks.uniform


def test_loads_on_supports_are_not_drawn() -> None:
    marks = load_marks(tower_model(), wrench([5, 0, 0], [0, 0, 0], 0), ("force on base[0]",))
    assert not len(marks.blocks)


def test_acceleration_is_one_arrow() -> None:
    model = tower_model()
    marks = load_marks(model, model.load_cases[0].dead_load, GRAVITY)
    assert not len(marks.blocks)
    assert marks.accelerated.tolist() == [False, True, True]
    assert marks.acceleration == pytest.approx(np.array([0, 0, -G]))


def test_forces_beside_gravity_are_drawn_by_themselves() -> None:
    """Also where every block has one, so that no two blocks have the same force for their mass."""
    model = tower_model()
    loads = model.load_cases[0].dead_load + wrench([0, 0, -3], [0.2, 0.5, 3], 1) + wrench([0, 0, -4], [4.5, 0.5, 1], 2)
    marks = load_marks(model, loads, (*GRAVITY, "line load"))
    assert marks.acceleration == pytest.approx(np.array([0, 0, -G]))
    assert marks.blocks.tolist() == [1, 2]
    assert marks.forces == pytest.approx(np.array([[0, 0, -3], [0, 0, -4.0]]), abs=1e-9)
    assert marks.tips == pytest.approx(np.array([[0.2, 0.5, 3.0], [4.5, 0.5, 0.5]]))


def test_masses_that_blocks_carry_along_make_no_moment() -> None:
    model = tower_model()
    blocks = replace(model.blocks, added_masses=np.array([0, 0.5, 0]), added_mass_points=model.blocks.centroids + 0.3)
    loads = np.zeros((3, 6))
    loads[:, 2] = -G * blocks.masses
    loads[:, 3:] = np.cross(np.full((3, 3), 0.3), np.outer(blocks.added_masses, [0, 0, -G]))
    marks = load_marks(replace(model, blocks=blocks), loads, GRAVITY)
    assert marks.uniform
    assert not len(marks.blocks)
    assert not len(marks.moments)


def test_moment_without_a_force() -> None:
    loads = np.zeros((3, 6))
    loads[2, 4] = 7.0
    marks = load_marks(tower_model(), loads, ("moment on brick[0]",))
    assert marks.moment_blocks.tolist() == [2]
    assert marks.moments == pytest.approx(np.array([[0, 7.0, 0]]))
    assert not len(marks.blocks)


def test_one_accelerated_block_whose_force_acts_off_its_centroid_has_an_arrow_there() -> None:
    """As of an acceleration that grows with height: no arrow beside the structure, no moment, but a force higher up."""
    model = tower_model()
    loads = np.zeros((3, 6))
    up = 0.3
    loads[1, :3] = model.blocks.masses[1] * np.array([1.0, 0.0, 0.0])
    loads[1, 3:] = np.cross([0.0, 0.0, up], loads[1, :3])
    marks = load_marks(model, loads, ("acceleration (1, 0, 0) g on 1 block times 0.5 to 0.5, by height",))
    assert not marks.uniform
    assert not len(marks.moments)
    assert marks.tips[0, 2] == pytest.approx(model.blocks.centroids[1, 2] + up)


@pytest.mark.parametrize("factor", [0.0, 1.0])
def test_an_acceleration_of_nothing_is_no_arrow(factor: float) -> None:
    """Nothing is loaded, or what is loaded has no mass."""
    model = tower_model()
    blocks = replace(model.blocks, densities=0 * model.blocks.densities)
    loads = factor * wrench([1, 0, 0], [4.5, 0.5, 0.25], 2)
    marks = load_marks(replace(model, blocks=blocks), loads, ("acceleration (1, 0, 0) g on brick[0]",))
    assert not marks.uniform
    assert not marks.acceleration.any()
    assert marks.blocks.tolist() == [2] * bool(factor)


def test_accelerations_that_differ_from_block_to_block_are_forces() -> None:
    """As of a tilt about different points: no two blocks have the same force for their mass."""
    model = tower_model()
    loads = np.zeros((3, 6))
    loads[1:, 0] = model.blocks.masses[1:] * [1.0, 2.0]
    marks = load_marks(model, loads, ("acceleration (1, 0, 0) g on 2 blocks times 0.1 to 0.2, by height",))
    assert not marks.uniform
    assert marks.blocks.tolist() == [1, 2]
    assert marks.forces == pytest.approx(loads[1:, :3])


def test_a_vehicle_has_an_arrow_for_each_axle() -> None:
    """Two on one block are two arrows, and what else acts on it has its own; an axle off the path stands beside."""
    model = tower_model()
    points = np.array([[9.0, 0.5, 4.0], [0.8, 0.5, 4.0], [0.2, 0.5, 4.0]])
    forces = np.array([[0, 0, -7.0], [0, 0, -5.0], [0, 0, -3.0]])
    vehicle = TravelPosition("train", 1, 1, points, np.array([9.0, 0.8, 0.2]), forces, np.array([-1, 1, 1]))
    loads = wrench([0, 0, -5], points[1], 1) + wrench([0, 0, -3], points[2], 1) + wrench([2, 0, 0], [0, 0.5, 2], 1)
    marks = load_marks(model, loads, ("force", "position 1"), vehicle)
    assert marks.blocks.tolist() == [1, 1, 1]
    assert marks.tips == pytest.approx(np.array([[0, 0.5, 2], [0.8, 0.5, 3], [0.2, 0.5, 3]]))
    assert marks.forces == pytest.approx(np.array([[2, 0, 0], *forces[1:]]))
    assert marks.beside.tolist() == points[:1].tolist()
    assert marks.beside_forces.tolist() == forces[:1].tolist()
