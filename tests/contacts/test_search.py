"""Interfaces of structures whose joints can be counted by hand, and what must not change them."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from mbla.contacts import Contacts
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra
from tests.contacts.structures import (
    any_rotation,
    boxes,
    contacts_of,
    ground,
    moved,
    running_bond,
    shuffled,
)
from tests.decks.folder import DECKS
from tests.line import line_of_file


def expected_wall(units: int, courses: int) -> tuple[int, float]:
    """Number and total area of the interfaces of ``running_bond``, counted course by course."""
    n_blocks = [units if course % 2 == 0 else units + 1 for course in range(courses)]
    head = sum(n - 1 for n in n_blocks)
    bed = units + (courses - 1) * 2 * units  # slab; between courses every half unit is one interface
    return head + bed, head * 0.2 * 0.175 + courses * units * 0.4 * 0.2


@pytest.mark.parametrize(("units", "courses", "n_blocks"), [(5, 5, 28), (10, 10, 106), (20, 20, 411)])
def test_every_interface_of_a_running_bond_wall_is_found(units: int, courses: int, n_blocks: int) -> None:
    wall = running_bond(units, courses)
    contacts = contacts_of(wall, fixed=[0])
    count, area = expected_wall(units, courses)
    assert len(wall) == n_blocks
    assert len(contacts) == count
    assert contacts.areas.sum() == pytest.approx(area, rel=1e-12)
    assert (np.diff(contacts.point_start) == 4).all()
    assert contacts.report.notices == ()


def matched(contacts: Contacts, names: np.ndarray | None = None) -> dict[tuple[int, ...], list[float]]:
    """Sorted areas by unordered pair of bodies; bodies renamed."""
    bodies = contacts.bodies if names is None else names[contacts.bodies]
    table: dict[tuple[int, ...], list[float]] = {}
    for pair, area in zip(np.sort(bodies, axis=1).tolist(), contacts.areas.tolist(), strict=True):
        table.setdefault(tuple(pair), []).append(area)
    return {pair: sorted(areas) for pair, areas in table.items()}


@pytest.mark.parametrize("scale", [1000.0, 1e-3])
def test_unit_of_length_changes_nothing(scale: float) -> None:
    wall = running_bond(8, 8)
    plain, scaled = contacts_of(wall, fixed=[0]), contacts_of(moved(wall, scale=scale), fixed=[0])
    np.testing.assert_array_equal(plain.bodies, scaled.bodies)
    np.testing.assert_array_equal(plain.point_start, scaled.point_start)
    np.testing.assert_allclose(scaled.areas, scale**2 * plain.areas, rtol=1e-9)
    np.testing.assert_allclose(scaled.points, scale * plain.points, atol=1e-9 * scale)
    np.testing.assert_allclose(scaled.frames, plain.frames, atol=1e-12)
    np.testing.assert_allclose(scaled.point_areas, scale**2 * plain.point_areas, rtol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_rotation_changes_nothing(seed: int) -> None:
    wall, turn = running_bond(20, 20), any_rotation(seed)
    plain, turned = contacts_of(wall, fixed=[0]), contacts_of(moved(wall, turn=turn), fixed=[0])
    assert len(turned) == 1170
    np.testing.assert_array_equal(plain.bodies, turned.bodies)
    np.testing.assert_allclose(turned.areas, plain.areas, rtol=1e-9)
    np.testing.assert_allclose(turned.centroids, plain.centroids @ turn.T, atol=1e-9)
    np.testing.assert_allclose(turned.normals, plain.normals @ turn.T, atol=1e-9)
    assert (np.diff(turned.point_start) == 4).all()
    assert turned.report.notices == ()


def test_a_million_block_sizes_from_the_origin() -> None:
    wall = running_bond(20, 20)
    plain = contacts_of(wall, fixed=[0])
    far = contacts_of(moved(wall, turn=any_rotation(), shift=2.4e5), fixed=[0])
    np.testing.assert_array_equal(plain.bodies, far.bodies)
    np.testing.assert_allclose(far.areas, plain.areas, rtol=1e-7)
    assert (np.diff(far.point_start) == 4).all()


def test_order_of_blocks_changes_nothing() -> None:
    wall = running_bond(20, 20)
    mixed, names = shuffled(wall)
    plain = contacts_of(wall, fixed=[0])
    other = contacts_of(mixed, fixed=[int(np.flatnonzero(names == 0)[0])])
    first, second = matched(plain), matched(other, names)
    assert first.keys() == second.keys()
    for pair, areas in first.items():
        assert second[pair] == pytest.approx(areas, rel=1e-9)


def test_same_model_gives_the_same_bits() -> None:
    wall = moved(running_bond(6, 6), turn=any_rotation())
    first, second = contacts_of(wall, fixed=[0]), contacts_of(wall, fixed=[0])
    for field in fields(Contacts):
        one, other = getattr(first, field.name), getattr(second, field.name)
        if isinstance(one, np.ndarray):
            assert one.tobytes() == other.tobytes(), field.name


def assert_consistent(contacts: Contacts) -> None:
    """What the docstring of ``Contacts`` promises about every interface."""
    frames = contacts.frames
    np.testing.assert_allclose(
        np.einsum("kij,klj->kil", frames, frames), np.broadcast_to(np.eye(3), frames.shape), atol=1e-12
    )
    np.testing.assert_allclose(np.linalg.det(frames), 1.0, rtol=1e-12)
    np.testing.assert_array_equal(frames[:, 0], contacts.normals[contacts.interface_of_point])
    sums = np.add.reduceat(contacts.point_areas, contacts.point_start[:-1])
    np.testing.assert_allclose(sums, contacts.areas, rtol=1e-9)
    assert (contacts.point_areas >= 0).all()
    moments = np.add.reduceat(contacts.point_areas[:, None] * contacts.points, contacts.point_start[:-1])
    np.testing.assert_allclose(moments / contacts.areas[:, None], contacts.centroids, atol=1e-7)
    assert (contacts.outline >= 3).all()
    assert (contacts.outline <= np.diff(contacts.point_start)).all()
    for i in range(len(contacts)):
        outer = contacts.points[contacts.point_start[i] : contacts.point_start[i] + contacts.outline[i]]
        turn = np.cross(outer - outer[0], np.roll(outer, -1, axis=0) - outer[0]).sum(axis=0)
        assert turn @ contacts.normals[i] > 0, "outline runs clockwise"
        assert np.abs((outer - outer[0]) @ contacts.normals[i]).max() < 1e-9


def test_records_are_consistent() -> None:
    wall = contacts_of(moved(running_bond(4, 4), turn=any_rotation()), fixed=[0])
    assert_consistent(wall)
    stack = boxes(([0, 0, 0], [2, 1, 1]), ([0.5, 0, 1], [3, 1, 2]))
    assert_consistent(contacts_of(stack, grounds=(ground(),)))
    order = np.lexsort((wall.bodies[:, 1], wall.bodies[:, 0]))
    np.testing.assert_array_equal(order, np.arange(len(wall)))


def test_normal_points_from_a_to_b() -> None:
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    upwards = contacts_of(stack)
    np.testing.assert_array_equal(upwards.bodies, [[0, 1]])
    np.testing.assert_allclose(upwards.normals, [[0, 0, 1]], atol=1e-15)
    downwards = contacts_of(
        Polyhedra(stack.vertices * [1, 1, -1], stack.vertex_start, stack.loops, stack.loop_start, stack.face_start)
    )
    np.testing.assert_allclose(downwards.normals, [[0, 0, -1]], atol=1e-15)


def test_ground_is_body_a_and_its_normal_points_to_the_block() -> None:
    contacts = contacts_of(boxes(([0, 0, 0], [2, 1, 1])), grounds=(ground(joint="mortar"),))
    np.testing.assert_array_equal(contacts.bodies, [[1, 0]])
    np.testing.assert_allclose(contacts.normals, [[0, 0, 1]], atol=1e-15)
    assert contacts.areas == pytest.approx([2.0])
    assert contacts.joint_names == ("mortar",)
    np.testing.assert_allclose(contacts.point_areas, 0.5, rtol=1e-12)


def test_ground_carries_only_the_blocks_it_is_for() -> None:
    row = boxes(([0, 0, 0], [1, 1, 1]), ([2, 0, 0], [3, 1, 1]))
    contacts = contacts_of(row, grounds=(ground(blocks=[1]),))
    np.testing.assert_array_equal(contacts.bodies, [[2, 1]])


def test_inclined_ground() -> None:
    turn = any_rotation(3)
    block = moved(boxes(([0, 0, 0], [1, 2, 3])), turn=turn, shift=5.0)
    contacts = contacts_of(block, grounds=(ground(point=[5, 5, 5], normal=turn[:, 2].tolist()),))
    assert contacts.areas == pytest.approx([2.0])


def test_contacts_between_fixed_bodies_are_counted_and_left_out() -> None:
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]), ([0, 0, 2], [1, 1, 3]))
    contacts = contacts_of(stack, fixed=[0, 1], grounds=(ground(),))
    np.testing.assert_array_equal(contacts.bodies, [[1, 2]])
    assert contacts.report.fixed_contacts == 2
    assert [notice.identifier for notice in contacts.report.notices] == ["fixed-contacts-left-out"]


def test_gap_and_mean_plane() -> None:
    gap = 4e-4
    contacts = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1 + gap], [1, 1, 2 + gap])))
    assert contacts.gaps == pytest.approx([gap], rel=1e-9)
    np.testing.assert_allclose(contacts.points[:, 2], 1 + gap / 2, atol=1e-12)
    negative = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1 - gap], [1, 1, 2 - gap])))
    assert negative.gaps == pytest.approx([-gap], rel=1e-9)


@pytest.mark.parametrize(("relative", "count"), [(0.999e-3, 1), (1.001e-3, 0)])
def test_tolerance_is_relative_to_the_smaller_block(relative: float, count: int) -> None:
    contacts = contacts_of(
        boxes(([-50, -50, -100], [50, 50, 0]), ([0, 0, relative * 0.1], [0.1, 0.1, 0.1 + relative * 0.1]))
    )
    assert len(contacts) == count


@pytest.mark.parametrize(("tolerance", "count"), [(1e-4, 490), (1e-3, 487), (3e-3, 488), (1e-2, 488)])
def test_cross_vault_as_exported(tolerance: float, count: int) -> None:
    """Faces of 184 blocks that do not match, as a survey gives them."""
    contacts = line_of_file(DECKS / "tutorials" / "crossvault.yaml", f"contacts.tolerance={tolerance}").contacts
    assert len(contacts) == count
    assert_consistent(contacts)


def test_all_blocks_in_one_pile_of_different_sizes() -> None:
    """A slab a thousand times larger than the dice on it."""
    slab = boxes(([-500, -500, -10], [500, 500, 0]))
    dice = boxes(*(([3 * i, 0, 0], [3 * i + 1, 1, 1]) for i in range(20)))
    contacts = contacts_of(moved(join_polyhedra([slab, dice]), turn=any_rotation(7)), fixed=[0])
    assert len(contacts) == 20
    np.testing.assert_allclose(contacts.areas, 1.0, rtol=1e-9)
