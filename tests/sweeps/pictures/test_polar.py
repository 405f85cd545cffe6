"""Diagrams around the horizon, and maps of a sphere."""

import pytest

from mbla.errors import UsageError
from mbla.sweeps.pictures.plot import SweepPictures, pictures_of
from mbla.sweeps.tables.sweep_table import SweepTable
from tests.sweeps.pictures.hand_made import Row, grid, sample, sphere

QUARTERS = [0.0, 90.0, 180.0, 270.0]
OVER = [(0.0, 0.0), (120.0, 0.0), (240.0, 0.0), (0.0, 89.0)]


def text_of(**values: float) -> Row:
    return {"status": "solved", "load_factor": 1.0, "mechanism.class": "sliding"}


@pytest.mark.parametrize(
    ("swept", "result", "told"),
    [
        (grid({"azimuth": QUARTERS}, text_of), "mechanism.class", "the result is text; scatter shows it"),
        (grid({"mu": [1.0, 2.0]}, text_of), "mechanism.class", "the result is text; scatter shows it"),
        (grid({"azimuth": QUARTERS, "mu": [1.0, 2.0]}, text_of), "mechanism.class",
         "the result is text; map and scatter show it"),
        (grid({"azimuth": QUARTERS[:2]}, text_of), None, "needs three directions"),
        (sphere(OVER[:2], {}, text_of), None, "needs three directions"),
        (sphere(OVER, {"mu": [1.0, 2.0]}, text_of), None,
         "a map of a sphere has one point for each direction; this sweep has other parameters too"),
        (sample({"to_azimuth": [0.0, 100.0, 200.0], "to_elevation": [0.0, 10.0, 20.0]}, text_of), None,
         "no parameter is a direction around the horizon of a grid, or over a sphere"),
    ],
)  # fmt: skip
def test_what_is_not_drawn_is_refused_with_the_reason(swept: SweepTable, result: str | None, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        pictures_of(swept, SweepPictures(("polar",), result=result))
