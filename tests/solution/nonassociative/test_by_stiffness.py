"""Paths of joints of other stiffnesses: which of them is another answer, and what all parts come to together."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from mbla.solution.flow.path_of_part import PathOfPart
from mbla.solution.nonassociative.by_stiffness import another_answer, load_factors
from mbla.solution.parts.deciding_part import least_by_stiffness
from mbla.solution.parts.part_result import PartResult
from mbla.solution.solution import PathByStiffness

NAN = float("nan")


def path(load_factor: float, *, is_answer: bool = True, gain: float = 0.0) -> PathOfPart:
    one = SimpleNamespace(load_factor=load_factor, is_answer=is_answer, gains=lambda share, above: gain > share)
    return cast(PathOfPart, one)


RISES = path(0.8, gain=0.2)
LOST = path(0.2, is_answer=False)


@pytest.mark.parametrize(
    ("others", "doubtful", "another"),
    [
        ({0.2: path(1.03), 1.0: path(0.97)}, False, None),
        ({0.2: path(1.2), 1.0: path(0.9)}, False, 1.0),
        ({0.2: path(0.9), 1.0: path(0.8)}, False, 1.0),
        ({0.2: path(1.2), 1.0: path(1.0)}, False, 0.2),
        ({0.2: LOST, 1.0: path(1.0)}, False, None),
        ({0.2: RISES, 1.0: path(1.0)}, False, None),
        ({1.0: LOST}, True, 1.0),
        ({0.2: path(NAN, is_answer=False), 1.0: path(0.9)}, True, 1.0),
    ],
)
def test_the_least_that_is_more_than_a_twentieth_off_is_another_answer(
    others: dict[float, PathOfPart], doubtful: bool, another: float | None
) -> None:
    assert another_answer({0.4: path(1.0), **others}, 0.4, 1e-9, np.inf, doubtful=doubtful) == another


def test_a_path_that_was_lost_or_still_rises_has_no_load_factor_and_the_one_shown_is_not_among_them() -> None:
    rows = load_factors({0.4: path(1.0), 1.0: path(0.9), 0.2: LOST, 0.3: RISES}, 0.4, 2.0, np.inf)
    assert [row.ratio for row in rows] == [0.2, 0.3, 1.0]
    np.testing.assert_equal([row.load_factor for row in rows], [NAN, NAN, 1.8])


def test_of_parts_that_are_not_connected_the_least_counts_with_joints_of_every_stiffness() -> None:
    def part(*rows: PathByStiffness) -> PartResult:
        return cast(PartResult, SimpleNamespace(flow=SimpleNamespace(by_stiffness=rows)))

    def factors(*rows: PathByStiffness) -> Sequence[PathByStiffness]:
        parts = [part(*rows), part(PathByStiffness(0.2, 0.49), PathByStiffness(1.0, 0.6))]
        return least_by_stiffness([*parts, cast(PartResult, SimpleNamespace(flow=None))], rows)

    first = PathByStiffness(0.2, 0.5), PathByStiffness(1.0, 0.5)
    assert factors(*first) == (PathByStiffness(0.2, 0.49), PathByStiffness(1.0, 0.5))
