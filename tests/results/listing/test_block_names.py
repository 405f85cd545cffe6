import numpy as np
import pytest

from mbla.results.listing.places import block_names
from tests.results.synthetic import cuboids, tower_model


@pytest.mark.parametrize(
    ("blocks", "words"),
    [
        ([0], "wall[0]"),
        ([0, 1, 2], "wall[0..2]"),
        ([2, 0, 1], "wall[0..2]"),
        ([0, 2, 3], "wall[2..3], wall[0]"),
        ([2, 6], "arch[0], wall[2]"),  # groups are not run together though blocks may follow each other
        ([5, 6], "arch[0], wall[5]"),
        ([0, 2, 4, 6, 7], "arch[0..1], wall[0] and 2 more"),
    ],
)
def test_stretches(blocks: list[int], words: str) -> None:
    lower = np.array([[i, 0, 0] for i in range(9)], float)
    model = tower_model()
    model = type(model)(**{**vars(model), "blocks": cuboids(lower, lower + 1, ["wall"] * 6 + ["arch"] * 3)})
    assert block_names(model, np.array(blocks)) == words
