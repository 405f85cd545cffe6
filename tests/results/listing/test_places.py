"""Names of blocks and labels of places."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.model.solids.blocks import join_labels, labels_of
from mbla.results.listing.places import group_words, label_words
from tests.results.synthetic import cuboids, tower_model


@pytest.mark.parametrize(
    ("blocks", "words"),
    [
        ([0], "wall[0]"),
        ([0, 1, 2], "wall[0..2]"),
        ([2, 0, 1], "wall[0..2]"),
        ([0, 2, 3], "3 blocks of wall"),
        ([5, 6], "2 blocks of wall, arch"),  # groups are not run together though blocks may follow each other
    ],
)
def test_blocks_by_their_groups(blocks: list[int], words: str) -> None:
    lower = np.array([[i, 0, 0] for i in range(9)], float)
    model = tower_model()
    model = type(model)(**{**vars(model), "blocks": cuboids(lower, lower + 1, ["wall"] * 6 + ["arch"] * 3)})
    assert group_words(model, np.array(blocks)) == words


# ---  ---------------------------------------------------------------------------------------------------------------


WALL = labels_of(4, ["pier", "lintel", "pier", ""], {"course": np.array([0, 5, 2, 3])})


def test_members_are_counted_and_positions_given_as_ranges() -> None:
    assert label_words(WALL, np.arange(4)) == "members pier (2), lintel (1); course 0 .. 5"
    assert label_words(WALL, np.array([1])) == "member lintel (1); course 5 .. 5"


def test_many_members_are_not_all_named() -> None:
    names = [f"stone_{number}" for number in range(20)]
    words = label_words(labels_of(20, names, {}), np.arange(20))
    assert words.startswith("members stone_0 (1), stone_1 (1)")
    assert words.endswith("stone_7 (1) and 12 more")


def test_blocks_without_labels() -> None:
    assert label_words(join_labels([WALL, labels_of(2)]), np.array([4, 5])) == ""
