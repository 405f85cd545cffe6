"""Round faces whose corners lie within the tolerance of their outline: the remark, and where it is not made."""

from __future__ import annotations

import math

import pytest

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
