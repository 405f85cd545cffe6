import numpy as np
import pytest

from mbla.studies.sweep.answers import answers_of
from mbla.studies.sweep.pictures.distribution import cumulative
from mbla.studies.sweep.pictures.view import chosen_results
from tests.studies.sweep.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, sample


def test_the_band_holds_the_whole_curve_as_often_as_it_says() -> None:
    """Of uniform numbers, whose curve is the diagonal; the inequality promises at least 95 %: 300 samples, 3σ below."""
    rng, held = np.random.default_rng(3), 0
    for _ in range(300):
        table = sample({"mu": list(rng.uniform(size=50))}, lambda mu: mu)
        found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(50, dtype=bool))
        before = np.concatenate([[found.high[0] - 1 / 50], found.high[:-1]])  # up to a value the curve is the earlier
        held += bool(np.all(found.low <= found.values) and np.all(found.values <= np.maximum(before, 0)))
    assert held / 300 > 0.95 - 3 * np.sqrt(0.95 * 0.05 / 300)


def test_what_does_not_stand_lies_below_and_what_nothing_brings_down_above() -> None:
    answers: list[Row | float] = [FALLEN, 0.2, 0.4, UNBOUNDED]
    table = sample({"mu": [0.0, 1.0, 2.0, 3.0]}, lambda mu: answers[int(mu)])
    found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(4, dtype=bool), band=False)
    assert found.share.tolist() == pytest.approx([0.5, 0.75])
    assert (found.below, found.above, found.unknown) == (1, 1, 0)


def test_a_failed_point_may_lie_anywhere() -> None:
    answers: list[Row | float] = [0.2, 0.4, FAILED, 0.6]
    table = sample({"mu": [0.0, 1.0, 2.0, 3.0]}, lambda mu: answers[int(mu)])
    found = cumulative(answers_of(table, chosen_results(table, None)[0]), np.ones(4, dtype=bool), band=False)
    assert found.low.tolist() == pytest.approx([0.25, 0.5, 0.75])
    assert found.high.tolist() == pytest.approx([0.5, 0.75, 1.0])
    assert found.share.tolist() == pytest.approx([1 / 3, 2 / 3, 1.0])
