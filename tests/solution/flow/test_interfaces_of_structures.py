"""The path with stress blocks and torsion on structures: what it says, and that it says the same of equivalent forms.

References are paths in converged steps: dome .4737 and, in shorter ones, .4775 with torsion, .5342 with stress blocks
of 1 MPa; vault on piers .1235 and, of 3 MPa, .1339; wall of 20 × 20 .4750. Corners alone say .541, .1535, .4903.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.solution.law.interfaces import Interfaces
from tests.decks.folder import DECKS
from tests.line import Line, line_of_file
from tests.solution.flow.paths import load_factor_of, stress_blocks, torsion

pytestmark = pytest.mark.long

DOME, PIERS = DECKS / "tutorials" / "dome.yaml", DECKS / "structures" / "cross_vault_on_piers.yaml"
WALL = DECKS / "benchmarks" / "closed_forms" / "wall_20x20.yaml"


def both(line: Line, strength: float) -> Interfaces:
    return Interfaces(stress_blocks(line, strength).crushing, torsion(line).twisting)


@pytest.mark.parametrize(
    ("path", "strength", "expected", "within"),
    [(DOME, 1e6, 0.5342, 3e-3), (PIERS, 3e6, 0.1339, 5e-3), (WALL, 1e6, 0.4750, 3e-3)],
    ids=["dome", "piers", "wall"],
)
def test_stress_blocks(path: Path, strength: float, expected: float, within: float) -> None:
    line = line_of_file(path)
    assert load_factor_of(line, interfaces=stress_blocks(line, strength)) == pytest.approx(expected, rel=within)


@pytest.mark.parametrize(("path", "expected", "within"), [(DOME, 0.4756, 5e-3), (PIERS, 0.1235, 0.03)])
def test_torsion(path: Path, expected: float, within: float) -> None:
    """On the vault on piers the path is blocked where an interface twists at two bounds of R at once."""
    line = line_of_file(path)
    assert load_factor_of(line, interfaces=torsion(line)) == pytest.approx(expected, rel=within)


def test_with_both_a_dome_starts_to_move_near_what_torsion_allows() -> None:
    line = line_of_file(DOME)
    assert load_factor_of(line, interfaces=both(line, 1e6)) == pytest.approx(0.4759, rel=5e-3)


def test_without_a_strength_that_is_reached_corners_alone_decide() -> None:
    line = line_of_file(DOME)
    assert load_factor_of(line, interfaces=stress_blocks(line, 1e10)) == pytest.approx(load_factor_of(line), rel=5e-3)
