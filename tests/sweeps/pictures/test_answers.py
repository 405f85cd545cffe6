from typing import Any

from mbla.sweeps.answers import Answer, answers_of
from mbla.sweeps.pictures.sheet import count_words
from mbla.sweeps.pictures.view import chosen_results
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid

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
