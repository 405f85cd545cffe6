"""Labels cover neither points nor each other, and stay inside."""

from __future__ import annotations

from itertools import combinations

from mbla.sweeps.tradeoff.label_places import Box, label_places

FRAME = Box(0.0, 0.0, 1000.0, 600.0)


def test_crowded_points_get_labels_apart() -> None:
    points = [(500.0 + 7.0 * place, 300.0) for place in range(10)] + [(995.0, 5.0), (2.0, 598.0)]
    boxes = label_places(points, [(120.0, 16.0)] * len(points), FRAME, 5.0)
    assert all(box is not None and box.within(FRAME) for box in boxes)
    assert not any(one.overlaps(two) for one, two in combinations([box for box in boxes if box is not None], 2))
    marks = [Box(x - 5.0, y - 5.0, x + 5.0, y + 5.0) for x, y in points]
    assert not any(box is not None and box.overlaps(mark) for box in boxes for mark in marks)


def test_a_lonely_point_has_its_label_to_the_right_and_one_too_large_has_none() -> None:
    (box,) = label_places([(500.0, 300.0)], [(100.0, 20.0)], FRAME, 5.0)
    assert box is not None
    assert box.left > 505.0
    assert box.bottom < 300.0 < box.top
    assert label_places([(500.0, 300.0)], [(1200.0, 20.0)], FRAME, 5.0) == [None]
