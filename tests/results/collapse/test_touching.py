"""Which interfaces touch, with axes of the deck along the structure and across it."""

import numpy as np
import pytest

from mbla.results.collapse.cracks import touching_pairs
from tests.results.collapse.solved_state import State, moved
from tests.results.collapse.test_invariance import TURN
from tests.results.synthetic import horizontal_contacts, tower_mechanics, tower_model, tower_results


@pytest.mark.parametrize("turn", [np.eye(3), TURN])
def test_neighbours_touch_and_others_do_not(turn: np.ndarray) -> None:
    """Unit squares: side by side, at a corner, a tenth apart in the plane, a tenth above."""
    squares = [(0, 1, 0, 1, 0), (1, 2, 0, 1, 0), (2, 3, 1, 2, 0), (3.1, 4.1, 1, 2, 0), (0, 1, 0, 1, 0.1)]
    contacts = horizontal_contacts([[0, 1]] * 5, squares)
    load_case = tower_results().cases[0].load_case
    state = State(tower_model(), contacts, load_case, tower_mechanics(), "concave", 3)
    contacts = moved(state, turn, np.array([7.0, -3.0, 2.0])).contacts
    first, second = touching_pairs(contacts, np.arange(5))
    assert list(zip(first.tolist(), second.tolist(), strict=True)) == [(0, 1), (1, 2)]
    assert len(touching_pairs(contacts, np.array([0]))[0]) == 0
