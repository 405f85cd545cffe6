"""Which results are drawn, and which parameter comes first."""

import pytest

from mbla.sweeps.pictures.plot import SweepPictures, pictures_of
from mbla.sweeps.pictures.view import chosen_results
from tests.sweeps.pictures.hand_made import Row, grid


def over(mu: float, **results: object) -> Row:
    return {"status": "solved", **results}


@pytest.mark.parametrize(
    ("results", "chosen"),
    [
        ({"hinges": 3.0, "load_factor": 0.5}, "load_factor"),
        ({"mechanism.class": "sliding", "hinges": 3.0, "sliding": 2.0}, "hinges"),
        ({"mechanism.class": "sliding"}, "status"),
    ],
)
def test_without_a_load_factor_the_first_number_is_drawn_or_else_the_first_text(
    results: dict[str, object], chosen: str
) -> None:
    table = grid({"mu": [1.0, 2.0]}, lambda mu: over(mu, **results))
    assert [column.name for column in chosen_results(table, None)] == [chosen]


def test_the_map_of_classes_is_made_of_itself_alone_where_no_result_is_named() -> None:
    table = grid({"mu": [1.0, 2.0, 3.0], "thickness": [1.0, 2.0, 3.0]}, lambda mu, thickness: mu)
    named = pictures_of(table, SweepPictures(result="load_factor"))
    assert [picture.name for picture in named] == ["curve_load_factor", "map_load_factor", "tornado_load_factor"]
    usual = pictures_of(table, SweepPictures())
    assert [picture.name for picture in usual] == [*(picture.name for picture in named), "map_mechanism.class"]
