import pytest

from mbla.errors import UsageError
from mbla.results.series import chosen_cases
from tests.results.synthetic import tower_results


def test_cases_come_in_the_order_of_the_deck() -> None:
    results = tower_results()
    assert chosen_cases(results, None) == results.cases
    assert chosen_cases(results, ["fall", "push_x"]) == results.cases
    assert chosen_cases(results, ["fall"]) == results.cases[1:]


def test_a_case_that_is_not_there_is_named_with_those_that_are() -> None:
    with pytest.raises(UsageError, match=r"^no load case pull in the result; it has push_x, fall$"):
        chosen_cases(tower_results(), ["push_x", "pull"])
