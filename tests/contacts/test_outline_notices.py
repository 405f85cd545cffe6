"""Round faces whose corners lie within the tolerance of their outline: the remark, and where it is not made."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from mbla.contacts.corners import Corners
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.notices import outline_notices
from mbla.contacts.overlay import Overlays
from tests.contacts.structures import blocks_of, boxes, model_of, section
from tests.line import line_of

DRUMS = """\
mbla: 1
parameters: {n: 360, eps: 1.e-3}
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - column: {group: column, material: stone, radius: 0.5, height: 4, drums: 2, sides: "=n", polygon: inscribed}
contacts: {joint: dry, tolerance: "=eps"}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""


def remarks(*overrides: str) -> list[str]:
    notices = line_of(DRUMS, *overrides).contacts.report.notices
    return [notice.message for notice in notices if notice.identifier == "outlines-simplified"]


def test_the_share_of_the_area_is_told() -> None:
    contacts = line_of(DRUMS).contacts
    (text,) = remarks()
    corners = int(contacts.point_start[1])
    assert corners < 180
    whole = 180 * math.sin(math.pi / 180) * 0.25
    assert f"by {100 * (1 - contacts.areas[0] / whole):.2g} %" in text
    assert "2 common surfaces" in text
    assert f"drawn by {corners} corners" in text


@pytest.mark.parametrize("overrides", [("parameters.n=24",), ("parameters.eps=1.e-5",)])
def test_nothing_is_said_where_every_corner_stays(overrides: tuple[str, ...]) -> None:
    assert not remarks(*overrides)


def told(*drawn: float) -> list[str]:
    """Of three unit squares drawn by four, five and six corners, with these areas."""
    n = len(drawn)
    nothing = np.zeros(n)
    overlays = Overlays(
        np.array([[k, k + 1] for k in range(n)]), np.zeros((n, 2), dtype=np.int64), np.zeros((n, 3)),
        np.zeros((n, 3, 3)), np.ones(n), np.zeros((n, 3)),
    )  # fmt: skip
    squares = np.array([shapely.box(0, 0, 1, 1)] * n, dtype=object)
    patches = Patches(overlays, squares, np.ones(n), nothing, nothing, nothing)
    counts = np.arange(n) + 4
    corners = Corners(np.zeros((counts.sum(), 2)), np.append(0, np.cumsum(counts)), np.arange(n))
    model = model_of(blocks_of(boxes(*(([k, 0, 0], [k + 1, 1, 1]) for k in range(n + 1)))))
    return [one.message for one in outline_notices(model, section(), patches, corners, np.array(drawn))]


def test_the_outline_that_changed_most_is_told() -> None:
    (text,) = told(1.0, 0.97, 1.01)
    assert "the area of 2 common surfaces, most that of block[1] and block[2], drawn by 5 corners, by 3 %" in text
    (alone,) = told(1.0, 1.0, 1.0 - 1.1e-4)
    assert "the area of 1 common surface, most that of block[2] and block[3], drawn by 6 corners, by 0.011 %" in alone
    assert "by 75 %" in told(0.25)[0]
    assert told(1.0, 1.0 + 0.9e-4, 1.0 - 0.9e-4) == []
