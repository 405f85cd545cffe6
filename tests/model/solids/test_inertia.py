from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import Delaunay

from mbla.arrays import FloatArray
from mbla.model.solids.inertia import crossing, inertia_of, second_moments
from tests.model.shapes import L_OUTLINE, box, build, hull, moved, prism, rotation


def of_box(sides: tuple[float, float, float], mass: float) -> FloatArray:
    squares = np.square(sides)
    return np.diag(mass / 12 * (squares.sum() - squares))


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_box_has_its_inertia_wherever_it_stands(seed: int) -> None:
    turn = rotation(seed)
    built = build(moved(box((0, 0, 0), (2, 3, 5)), turn, (700, 80, -9)))
    inertia = inertia_of(replace(built.blocks, densities=np.array([7.0])))
    assert inertia.masses == pytest.approx([210])
    assert inertia.arms == pytest.approx(np.zeros((1, 3)))
    assert inertia.tensors[0] == pytest.approx(turn @ of_box((2, 3, 5), 210) @ turn.T, rel=1e-9, abs=1e-9)


def test_second_moments_of_an_l_are_those_of_its_three_squares() -> None:
    blocks = build(prism(L_OUTLINE)).blocks
    found = second_moments(blocks)[0]
    centre = blocks.centroids[0]
    expected = np.zeros((3, 3))
    for corner in ((0, 0), (1, 0), (0, 1)):
        arm = np.array([corner[0] + 0.5, corner[1] + 0.5, 0.5]) - centre
        expected += np.eye(3) / 12 + np.outer(arm, arm)
    assert found == pytest.approx(expected)


@pytest.mark.parametrize("seed", range(4))
def test_second_moments_of_a_hull_are_those_of_tetrahedra_inside(seed: int) -> None:
    (vertices, faces), _ = hull(seed)
    blocks = build((vertices, faces)).blocks
    points = np.array(vertices) - blocks.centroids[0]
    expected = np.zeros((3, 3))
    for simplex in Delaunay(points).simplices:
        four = points[simplex]
        volume = abs(np.linalg.det(four[1:] - four[0])) / 6
        expected += volume / 20 * (four.T @ four + np.outer(four.sum(axis=0), four.sum(axis=0)))
    assert second_moments(blocks)[0] == pytest.approx(expected)


def test_halves_make_the_whole() -> None:
    built = build(box((0, 0, 0), (1, 2, 3)), box((1, 0, 0), (2, 2, 3)))
    halves = inertia_of(replace(built.blocks, densities=np.array([5.0, 5.0])))
    whole = halves.joined(np.array([0, 0]), np.array([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]]))
    assert whole.masses == pytest.approx([60])
    assert whole.arms == pytest.approx(np.zeros((1, 3)))
    assert whole.tensors[0] == pytest.approx(of_box((2, 2, 3), 60))


def test_a_carried_mass_and_a_heavy_half_move_the_mass_centre() -> None:
    built = build(box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 1, 1)))
    carried = replace(
        built.blocks,
        densities=np.array([1.0, 2.0]),
        added_masses=np.array([3.0, 0.0]),
        added_mass_points=np.array([[0.0, 0.5, 2.5], [1.5, 0.5, 0.5]]),
    )
    body = inertia_of(carried).joined(np.array([0, 0]), np.array([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]]))
    # masses 1 at (-.5, 0, 0), 2 at (.5, 0, 0), 3 at (-1, 0, 2) from the centroid
    assert body.masses == pytest.approx([6])
    assert body.arms[0] == pytest.approx([-2.5 / 6, 0, 1])
    velocity, spin = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.2, -0.7])
    energy = 0.0
    for mass, arm, own in ((1.0, (-0.5, 0, 0), 1.0), (2.0, (0.5, 0, 0), 1.0), (3.0, (-1.0, 0, 2.0), 0.0)):
        energy += mass * np.square(velocity + np.cross(spin, arm)).sum() + own * mass / 6 * spin @ spin
    motion = np.concatenate([velocity, spin])
    assert motion @ body.matrices[0] @ motion == pytest.approx(energy)


def test_crossing_is_the_cross_product() -> None:
    one, other = np.random.default_rng(0).normal(size=(2, 3))
    assert crossing(one[None])[0] @ other == pytest.approx(np.cross(one, other))
