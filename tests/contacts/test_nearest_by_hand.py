"""What lies nearest to a part that nothing holds, in words: distances of boxes, by hand."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

import numpy as np
import pytest

from mbla.contacts.report import nearest_words
from mbla.deck.units import Units
from mbla.model.model import Ground
from tests.contacts.structures import blocks_of, boxes, ground, model_of

CUBE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
Box = tuple[Sequence[float], Sequence[float]]


def words(part: Sequence[int], *extremes: Box, grounds: tuple[Ground, ...] = ()) -> str:
    names = [f"b{number}" for number in range(len(extremes))]
    return nearest_words(model_of(blocks_of(boxes(*extremes), names), grounds=grounds), np.array(part))


def at(*corner: float) -> Box:
    return corner, [place + 1.0 for place in corner]


@pytest.mark.parametrize(
    ("corner", "gap"),
    [
        ((4.0, 0.0, 0.0), "3"),
        ((-4.0, 0.5, 0.5), "3"),
        ((4.0, 5.0, 0.0), "5"),
        ((0.0, -4.0, 5.0), "5"),
        ((3.0, -3.0, 2.0), "3"),
        ((1.0 + 1e-6, 0.0, 0.0), "1e-06"),
    ],
)
def test_distance_of_two_boxes(corner: tuple[float, ...], gap: str) -> None:
    assert words([1], CUBE, at(*corner)) == f"; nearest to it is b0[0], {gap} m from b1[0], by the boxes around them"


def test_boxes_that_meet_or_overlap() -> None:
    met = "; nearest to it is b0[0], which b1[0] meets or overlaps without a common surface"
    assert words([1], CUBE, at(1.0, 1.0, 1.0)) == met
    assert words([1], CUBE, at(0.5, 0.5, 0.5)) == met
    assert words([1], CUBE, at(1.0 + 0.9e-9, 0.0, 0.0)) == met
    assert "by the boxes" in words([1], CUBE, at(1.0 + 1.1e-9, 0.0, 0.0))


def test_the_nearest_of_many_and_of_the_part() -> None:
    row = [at(3.0 * x, 0.0, 0.0) for x in range(4)]
    assert words([2, 3], *row).startswith("; nearest to it is b1[0], 2 m from b2[0]")
    assert words([0, 3], *row).startswith("; nearest to it is b1[0], 2 m from b0[0]")
    assert words([1], *row[:2], at(4.5, 0.0, 0.0)).startswith("; nearest to it is b2[0], 0.5 m from b1[0]")


def test_ground_is_as_far_as_the_lowest_corner() -> None:
    apart = (at(0.0, 0.0, 0.25), at(5.0, 0.0, 0.5))
    assert words([0, 1], *apart, grounds=(ground(),)) == (
        "; nearest to it is ground, 0.25 m from b0[0], by the boxes around them"
    )
    assert words([1], *apart, grounds=(ground(),)).startswith("; nearest to it is ground, 0.5 m from b1[0]")
    only_other = (ground(blocks=[1]),)
    assert words([0, 1], *apart, grounds=only_other).startswith("; nearest to it is ground, 0.5 m from b1[0]")
    assert words([0], *apart, grounds=only_other).startswith("; nearest to it is b1[0], 4 m from b0[0]")
    sunk = (at(0.0, 0.0, -0.125),)
    assert words([0], *sunk, grounds=(ground(),)).startswith("; nearest to it is ground, 0.125 m")
    wall = (ground(point=(3, 0, 0), normal=(-1, 0, 0)),)
    assert words([0], CUBE, grounds=wall).startswith("; nearest to it is ground, 2 m")


def test_alone() -> None:
    assert words([0], CUBE) == ""


def test_lengths_are_those_of_the_deck() -> None:
    blocks = blocks_of(boxes(CUBE, at(3.0, 0.0, 0.0)))
    model = model_of(blocks, units=Units(length="mm"))
    assert nearest_words(model, np.array([1])).startswith("; nearest to it is block[0], 2 mm from block[1]")


def test_of_many_blocks_only_the_nearest_are_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    """The two boxes of each side that are nearest to the box around the other side."""
    monkeypatch.setattr(import_module("mbla.contacts.report"), "NEAREST_COMPARED", 2)
    part = [at(-3.0 * x, 0.0, 0.0) for x in range(4)]
    others = [at(4.0 + 3.0 * x, 0.0, 0.0) for x in range(4)]
    assert words([0, 1, 2, 3], *part, *others).startswith("; nearest to it is b4[0], 3 m from b0[0]")
    assert words([4, 5, 6, 7], *part, *others).startswith("; nearest to it is b0[0], 3 m from b4[0]")


def test_the_box_around_many_reaches_to_its_farthest(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the part only the block that is nearest to the whole box of the others is looked at."""
    monkeypatch.setattr(import_module("mbla.contacts.report"), "NEAREST_COMPARED", 1)
    others = [at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0)]
    assert words([2, 3], *others, at(11.5, 0.0, 0.0), at(-3.0, 0.0, 0.0)).startswith(
        "; nearest to it is b1[0], 0.5 m from b2[0]"
    )
    assert words([2, 3], *others, at(13.0, 0.0, 0.0), at(-1.5, 0.0, 0.0)).startswith(
        "; nearest to it is b0[0], 0.5 m from b3[0]"
    )
