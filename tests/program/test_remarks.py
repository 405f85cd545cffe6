from __future__ import annotations

import pytest

from mbla.program.remarks import program_notices
from tests.line import BLOCK, line_of


def test_compressive_strength_at_corner_points_is_warned_of() -> None:
    line = line_of(BLOCK, "joints.dry.compressive_strength=1e6")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.severity == "warning"
    assert notice.identifier == "eccentric-crushing-overstated"
    assert "dry" in notice.message


@pytest.mark.parametrize(
    ("points", "identifier"),
    [
        ("contacts.points.per_edge=2", "crushing-at-points"),
        ("contacts.points.spacing=0.5", "crushing-at-points"),
        ("contacts.points.spacing=1.0", "eccentric-crushing-overstated"),
        ("contacts.points.per_edge=1", "eccentric-crushing-overstated"),
        ("contacts.points.inset=0.1", "eccentric-crushing-overstated"),
    ],
)
def test_points_between_the_corners_bound_what_they_overstate(points: str, identifier: str) -> None:
    line = line_of(BLOCK, "joints.dry.compressive_strength=1e6", points)
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.identifier == identifier


def test_a_single_edge_without_points_is_enough_for_the_warning() -> None:
    """1 m along x, 0.4 m along y."""
    text = BLOCK.replace('max: ["=b", 1, "=h"]', 'max: ["=b", 0.4, "=h"]')
    line = line_of(text, "joints.dry.compressive_strength=1e6", "contacts.points.spacing=0.5")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.identifier == "eccentric-crushing-overstated"


def test_joints_without_it_are_not() -> None:
    line = line_of(BLOCK)
    assert program_notices(line.model, line.contacts) == ()
