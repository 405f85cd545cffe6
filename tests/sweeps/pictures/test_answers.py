from typing import Any

import numpy as np

from mbla.sweeps.answers import Answer, answers_of
from mbla.sweeps.pictures.sheet import count_words
from mbla.sweeps.pictures.view import chosen_results
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid
from tests.sweeps.tables import synthetic

STATES: dict[str, dict[str, Any]] = {
    "solved": {"status": "solved", "load_factor": 0.5, "static_bound": 0.49},
    "fallen": {**FALLEN, "static_bound": None},
    "unbounded": {**UNBOUNDED, "static_bound": None},
    "failed": {**FAILED, "static_bound": None},
    "unsure": {"status": "not_verified", "load_factor": None, "static_bound": 0.3},
    "none": {"status": "solved", "load_factor": None, "static_bound": None},
    "not run": {"status": None, "load_factor": None, "static_bound": None},
}


def states(state: str) -> Row:
    row = {"status": None, "load_factor": None, "static_bound": None, "mechanism.class": None} | STATES[state]
    return {name: row[name] for name in ("status", "load_factor", "static_bound", "mechanism.class")}


def test_each_point_has_its_answer() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, None)[0])
    assert found.answer.tolist() == [
        Answer.VALUE, Answer.NO_EQUILIBRIUM, Answer.UNBOUNDED, Answer.FAILED, Answer.FAILED, Answer.NONE,
        Answer.NOT_RUN,
    ]  # fmt: skip


def test_a_bound_of_a_point_that_is_not_verified_is_not_verified() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, "static_bound")[0])
    assert found.answer[4] == Answer.UNVERIFIED
    assert found.values[4] == 0.3
    assert found.good.tolist() == [True, False, False, False, False, False, False]


def test_counts_name_every_answer() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    words = count_words(answers_of(table, chosen_results(table, None)[0]))
    assert words == (
        "7 points: 1 with a verified value, 1 no equilibrium (does not stand), 1 unbounded (no collapse), "
        "1 has no such value, 2 failed, 1 not solved yet"
    )


def test_texts_are_places_among_categories() -> None:
    table = grid({"state_of": ["solved", "fallen", "solved"]}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, "status")[0])
    assert found.categories == ("no_equilibrium", "solved")
    assert found.values.tolist() == [1.0, 0.0, 1.0]
    assert found.good.all()  # that nothing stands is what the column says, not a value that it lacks


def test_of_other_results_nothing_lies_below_every_value() -> None:
    """A structure that does not stand has the load factor of none, but not the fewest hinges."""
    table = grid({"state_of": list(STATES)}, lambda state_of: {**states(state_of), "hinges": None})
    factor, hinges = (answers_of(table, chosen_results(table, name)[0]) for name in ("load_factor", "hinges"))
    assert (factor.below.sum(), factor.above.sum()) == (1, 1)
    assert not hinges.below.any()
    assert np.array_equal(hinges.of(Answer.NO_EQUILIBRIUM), factor.below)


def test_a_result_of_the_run_has_no_state_of_a_load_case() -> None:
    """A weight is known though the load case has no equilibrium; of a point that is not verified it is not there."""
    swept = synthetic.table()
    found = answers_of(swept, chosen_results(swept, "model.total_weight")[0])
    assert found.answer.tolist() == [Answer.VALUE, Answer.NONE, Answer.VALUE, Answer.FAILED, Answer.VALUE]
    assert found.values[found.good].tolist() == [65.0, 65.0, 65.0]
