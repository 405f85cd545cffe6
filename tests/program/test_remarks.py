from __future__ import annotations

from mbla.program.remarks import program_notices
from tests.line import BLOCK, line_of


def test_compressive_strength_at_corner_points_is_warned_of() -> None:
    line = line_of(BLOCK, "joints.dry.compressive_strength=1e6")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.severity == "warning"
    assert notice.identifier == "eccentric-crushing-overstated"
    assert "dry" in notice.message


def test_joints_without_it_are_not() -> None:
    line = line_of(BLOCK)
    assert program_notices(line.model, line.contacts) == ()
