from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.model.blocks.generated import ItemContext, ItemRefused
from mbla.model.blocks.wall import WallItem, generate
from mbla.model.solids.polyhedra import Polyhedra

SITE = ItemContext(1e-3, lambda path, name: Path(name))
A, B = [0.5, 1, 1, 1, 1, 0.5], [1, 1, 1, 1, 1]
FE3, FU3, WU3, WE3 = [1, 1, 1, 1], [0.5, 1, 1, 1, 0.5], [0.5, 1, -1, 1, 0.5], [1, 0.5, -1, 0.5, 1]
FE5, FU5, WU5, WE5 = [0.5, 1, 1, 0.5], [1, 1, 1], [1, -1, 1], [0.5, 0.5, -1, 0.5, 0.5]


def wall(**keys: Any) -> Polyhedra:
    item = WallItem.model_validate({"material": "stone", "unit": (0.4, 0.2, 0.175), **keys})
    (part,) = generate(item, SITE).parts
    return part.polyhedra


def rows(polyhedra: Polyhedra, unit: tuple[float, float, float] = (0.4, 0.2, 0.175)) -> list[list[float]]:
    """Widths in units course by course, gaps negative."""
    corners = polyhedra.vertices.reshape(-1, 8, 3)
    least, greatest = corners.min(axis=1) / unit, corners.max(axis=1) / unit
    assert least[:, 1] == pytest.approx(0)
    assert greatest[:, 1] == pytest.approx(1)
    courses: dict[int, list[float]] = {}
    ends: dict[int, float] = {}
    for low, high in zip(least, greatest, strict=True):
        course = round(low[2])
        assert [low[2], high[2]] == pytest.approx([course, course + 1])
        gap = low[0] - ends.get(course, 0.0)
        row = courses.setdefault(course, [])
        if gap > 1e-9:
            row.append(-round(gap, 9))
        row.append(round(high[0] - low[0], 9))
        ends[course] = high[0]
    assert list(courses) == sorted(courses)
    return list(courses.values())


def test_first_wall_of_ferris_and_tin_loi() -> None:
    built = wall(length=2.0, courses=6, start="half")
    assert len(built) == 33
    assert rows(built) == [A, B] * 3


@pytest.mark.parametrize(("n", "count"), [(5, 27), (10, 105), (20, 410)])
def test_running_bond_walls(n: int, count: int) -> None:
    assert len(wall(length=0.4 * n, courses=n)) == count


def test_stack_bond_has_no_offset() -> None:
    assert rows(wall(length=1.2, courses=3, bond="stack")) == [[1, 1, 1]] * 3
    assert rows(wall(length=1.2, courses=2, bond="stack", start="half")) == [[0.5, 1, 1, 0.5]] * 2


def test_closing_units_are_cut_to_fit() -> None:
    assert rows(wall(length=1.0, courses=2)) == [[1, 1, 0.5], [0.5, 1, 1]]
    assert rows(wall(length=0.9, courses=2)) == [[1, 1, 0.25], [0.5, 1, 0.75]]
    assert rows(wall(length=0.1, courses=2)) == [[0.25], [0.25]]


@pytest.mark.parametrize("excess", [1e-8, -1e-8])
def test_a_remainder_of_nothing_is_no_unit(excess: float) -> None:
    built = wall(length=0.8 + excess, courses=2)
    assert len(built) == 2 + 3
    assert built.vertices[:, 0].max() == 0.8 + excess


def test_openings_cut_units_and_pierce_them() -> None:
    opening = {"from": (0.5, 0.0), "to": (0.7, 0.175)}
    assert rows(wall(length=1.2, courses=1, openings=[opening])) == [[1, 0.25, -0.5, 0.25, 1]]


def test_openings_at_ends_bottom_and_top() -> None:
    left = {"from": (0, 0), "to": (0.4, 0.175)}
    right = {"from": (0.8, 0.35), "to": (1.2, 0.525)}
    built = wall(length=1.2, courses=3, bond="stack", openings=[left, right])
    assert rows(built) == [[-1, 1, 1], [1, 1, 1], [1, 1]]


def test_openings_may_overlap() -> None:
    openings = [{"from": (0.4, 0), "to": (0.8, 0.35)}, {"from": (0.6, 0.175), "to": (1.2, 0.525)}]
    built = wall(length=1.6, courses=3, bond="stack", openings=openings)
    assert rows(built) == [[1, -1, 1, 1], [1, -2, 1], [1, 0.5, -1.5, 1]]


def test_an_opening_through_a_whole_course() -> None:
    openings = [{"from": (0, 0.175), "to": (0.8, 0.35)}]
    assert rows(wall(length=0.8, courses=3, bond="stack", openings=openings)) == [[1, 1], [1, 1]]


def test_heights_within_the_tolerance_are_bed_joints() -> None:
    opening = {"from": (0.4, 0.1751), "to": (0.8, 0.3499)}
    built = wall(length=1.2, courses=3, bond="stack", openings=[opening])
    assert rows(built) == [[1, 1, 1], [1, -1, 1], [1, 1, 1]]


@pytest.mark.parametrize(
    ("keys", "findings"),
    [
        (
            {"openings": [{"from": (0.4, 0), "to": (0.8, 0.1)}, {"from": (0.4, 0.2), "to": (0.8, 0.4)}]},
            [
                (("openings", 0, "to", 1), "must lie on a bed joint; the nearest are 0 and 0.175"),
                (("openings", 1, "from", 1), "must lie on a bed joint; the nearest are 0.175 and 0.35"),
                (("openings", 1, "to", 1), "must lie on a bed joint; the nearest are 0.35 and 0.525"),
            ],
        ),
        (
            {"openings": [{"from": (0.4, 0.175), "to": (0.4 + 1e-8, 0.35)}]},
            [(("openings", 0, "to", 0), "the opening is too narrow to separate two units")],
        ),
    ],
)
def test_refused(keys: dict[str, Any], findings: list[Any]) -> None:
    with pytest.raises(ItemRefused) as caught:
        wall(**{"length": 1.2, "courses": 3, "bond": "stack", **keys})
    assert list(caught.value.findings) == findings


def test_units_know_their_course_and_their_place_in_it() -> None:
    item = WallItem.model_validate(
        {"material": "stone", "unit": (0.4, 0.2, 0.175), "length": 1.2, "courses": 3, "bond": "running"}
    )
    (part,) = generate(item, SITE).parts
    assert part.labels["course"].tolist() == [0] * 3 + [1] * 4 + [2] * 3
    assert part.labels["unit"].tolist() == [0, 1, 2, 0, 1, 2, 3, 0, 1, 2]
    assert part.labels["leaf"].tolist() == [0] * 10
