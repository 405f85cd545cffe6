from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import moving_share, part_motions, parts_of_one_twist, reach, rigid_parts
from mbla.results.listing.sections.mechanism_words import part_table
from tests.results.synthetic import cuboids, horizontal_contacts, tower_contacts, tower_model


def stack(n: int) -> tuple[Model, Contacts]:
    """Unit cubes one on the other, the lowest fixed, each heavier than the one below."""
    lower = np.array([[0, 0, i] for i in range(n)], float)
    model = replace(
        tower_model(),
        blocks=cuboids(lower, lower + 1, ["stack"] * n, np.arange(1.0, n + 1)),
        fixed=np.arange(n) == 0,
        grounds=(),
    )
    contacts = horizontal_contacts([[i, i + 1] for i in range(n - 1)], [(0, 1, 0, 1, i + 1) for i in range(n - 1)])
    return model, contacts


def rigid(model: Model, blocks: Any, point: Any, rotation: Any, velocity: Any = (0, 0, 0)) -> Any:
    """Motion in which these blocks turn about a point, and move besides."""
    motion = np.zeros((len(model.blocks), 6))
    motion[blocks, 3:] = rotation
    motion[blocks, :3] = velocity + np.cross(rotation, model.blocks.centroids[blocks] - np.asarray(point, float))
    return motion


def test_blocks_that_turn_together_are_one_part() -> None:
    model, contacts = stack(6)
    motion = rigid(model, [3, 4, 5], (1, 0.5, 3), (0.0, 1.0, 0.0))
    parts = rigid_parts(model, rigid_bodies(model, contacts), motion)
    assert parts.tolist() == [0, 0, 0, 1, 1, 1]
    (part,) = part_motions(model, parts, motion)
    assert part.blocks.tolist() == [3, 4, 5]
    assert part.weight == pytest.approx((4 + 5 + 6) * 9.81)
    assert part.turns
    assert part.direction == pytest.approx([0, 1, 0])
    assert part.axis_point == pytest.approx([1, 0.5, 3])


def test_contacts_that_hardly_move_add_up_along_a_part() -> None:
    model, contacts = stack(7)
    motion = rigid(model, [1, 2, 3, 4, 5, 6], (0, 0, 0), (0, 0, 0), (1.0, 0, 0))
    motion[3:, 0] += 5e-5 * np.arange(4)  # each against the one below
    assert rigid_parts(model, rigid_bodies(model, contacts), motion).tolist() == [0, 1, 1, 1, 1, 1, 1]
    assert parts_of_one_twist(model, rigid_bodies(model, contacts), motion).tolist() == [0, 1, 1, 1, 4, 3, 2]
    motion[3:, 0] = 1.0 + 1e-8
    assert parts_of_one_twist(model, rigid_bodies(model, contacts), motion).tolist() == [0, 1, 1, 1, 1, 1, 1]
    motion[1:3, 0] = 5e-5  # almost at rest
    assert rigid_parts(model, rigid_bodies(model, contacts), motion).tolist() == [0, 0, 0, 1, 1, 1, 1]
    assert parts_of_one_twist(model, rigid_bodies(model, contacts), motion).tolist() == [0, 2, 2, 1, 1, 1, 1]


def test_nothing_moves_nothing_but_rest() -> None:
    model, contacts = stack(3)
    still = np.zeros((3, 6))
    parts = rigid_parts(model, rigid_bodies(model, contacts), still)
    assert parts.tolist() == [0, 0, 0]
    assert part_motions(model, parts, still) == ()
    assert part_table(model, ()) == []


def test_blocks_without_contact_move_alone() -> None:
    model, _ = stack(3)
    apart = replace(
        tower_contacts(),
        bodies=np.zeros((0, 2), dtype=np.int64),
        normals=np.zeros((0, 3)),
        areas=np.zeros(0),
        centroids=np.zeros((0, 3)),
        point_start=np.zeros(1, dtype=np.int64),
        points=np.zeros((0, 3)),
        frames=np.zeros((0, 3, 3)),
    )
    motion = rigid(model, [1, 2], (0, 0, 0), (0, 0, 0), (0, 0, -1.0))
    assert rigid_parts(model, rigid_bodies(model, apart), motion).tolist() == [0, 2, 1]


def test_a_turn_too_slight_for_its_size_is_a_travel() -> None:
    model, contacts = stack(3)
    for rotation, turns in ((1e-3, False), (0.1, True)):
        motion = rigid(model, [1, 2], (0.5, 0.5, 2), (0, rotation, 0), (1.0, 0, 0))
        (part,) = part_motions(model, rigid_parts(model, rigid_bodies(model, contacts), motion), motion)
        assert part.turns is turns
    assert part.axis_point == pytest.approx([0.5, 0.5, 2 - 1 / 0.1])  # the centre of rotation lies below


def test_share_of_the_weight_that_moves_and_its_name() -> None:
    model = tower_model()
    assert moving_share(model, np.array([0, 1, 0])) == pytest.approx(0.5)  # the base is fixed and does not count
    assert moving_share(replace(model, fixed=np.ones(3, dtype=bool)), np.zeros(3, dtype=np.int64)) == 0.0
    assert [reach(share) for share in (0.0, 0.1, 0.3, 0.5, 1.0)] == ["local", "local", "partial", "global", "global"]


def test_equal_parts_are_numbered_by_their_first_block_though_weights_differ_by_rounding() -> None:
    model, contacts = stack(5)
    model = replace(model, blocks=replace(model.blocks, densities=1 + 1e-15 * np.array([0, 1, 5, 2, 4])))
    motion = np.zeros((5, 6))
    motion[1:, 0] = [1, 2, 3, 4]
    assert rigid_parts(model, rigid_bodies(model, contacts), motion).tolist() == [0, 1, 2, 3, 4]
