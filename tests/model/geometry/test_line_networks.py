from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.geometry import dxf as line_networks
from mbla.model.geometry.dxf import enclosed_fields
from mbla.model.geometry.geometry import GeometryFileError


def lines(*places: list[tuple[float, float]]) -> list[FloatArray]:
    return [np.array(each, dtype=float) for each in places]


def corners(outlines: list[FloatArray]) -> list[list[tuple[float, float]]]:
    """Corners of each outline, sorted."""
    return [sorted((float(x), float(z)) for x, z in outline) for outline in outlines]


def test_a_diagonal_bounds_a_field() -> None:
    fields, loose = enclosed_fields(lines([(0, 0), (1, 1)], [(1, 1), (1, 0)], [(1, 0), (0, 0)]))
    assert corners(fields) == [[(0, 0), (1, 0), (1, 1)]]
    assert loose == 0


def test_open_polylines_bound_fields_as_lines_do() -> None:
    fields, loose = enclosed_fields(lines([(0, 0), (2, 0), (2, 1), (0, 1)], [(0, 1), (0, 0)], [(1, -1), (1, 2)]))
    assert corners(fields) == [[(0, 0), (0, 1), (1, 0), (1, 1)], [(1, 0), (1, 1), (2, 0), (2, 1)]]
    assert loose == 2


def test_a_line_without_length_bounds_nothing() -> None:
    fields, loose = enclosed_fields(lines([(0, 0), (2, 0), (2, 1), (0, 0)], [(3, 1), (3, 1)]))
    assert corners(fields) == [[(0, 0), (2, 0), (2, 1)]]
    assert loose == 0


@pytest.mark.parametrize("far", [0.0, 1e6])
def test_ends_meet_by_the_size_of_the_drawing_wherever_it_lies(far: float) -> None:
    def triangle(gap: float) -> list[FloatArray]:
        return lines([(far, 0), (far + 1, 0)], [(far + 1, 0), (far + 1, 1)], [(far + 1, 1), (far, gap)])

    fields, loose = enclosed_fields(triangle(5e-7))
    assert corners(fields) == [[(far, 0), (far + 1, 0), (far + 1, 1)]]
    assert loose == 0
    assert enclosed_fields(triangle(5e-6)) == ([], 3)


@pytest.mark.parametrize("first", [0, 3])
def test_meetings_are_counted_at_every_line(monkeypatch: pytest.MonkeyPatch, first: int) -> None:
    """Three lines that one line crosses, be it the first of the drawing or the last."""
    network = lines(*([(x, -1.0), (x, 1.0)] for x in (0.0, 1.0, 2.0)))
    network.insert(first, np.array([[-1.0, 0.0], [3.0, 0.0]]))
    monkeypatch.setattr(line_networks, "MOST_MEETINGS", 3)
    assert enclosed_fields(network) == ([], 10)
    monkeypatch.setattr(line_networks, "MOST_MEETINGS", 2)
    with pytest.raises(GeometryFileError, match="has lines that meet each other more than 2 times"):
        enclosed_fields(network)


@pytest.mark.parametrize(("said", "expected"), [("std::bad_alloc", "MemoryError"), ("TopologyError", "GEOSException")])
def test_only_want_of_memory_is_told_as_such(monkeypatch: pytest.MonkeyPatch, said: str, expected: str) -> None:
    import shapely

    def refuse(_: Any) -> None:
        raise shapely.GEOSException(said)

    monkeypatch.setattr(shapely, "unary_union", refuse)
    with pytest.raises((MemoryError, shapely.GEOSException)) as caught:
        enclosed_fields(lines([(0, 0), (1, 1)]))
    assert type(caught.value).__name__ == expected
