from __future__ import annotations

import pytest

from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.reductions import allowed_reductions
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.solution import Status
from tests.line import WALL, line_of, verified


def test_without_reason_to_the_contrary_the_deck_is_followed() -> None:
    assert allowed_reductions(AnalysisSection()) == ReductionSwitches()
    assert not any(vars(allowed_reductions(AnalysisSection(reductions=False))).values())


@pytest.mark.parametrize(
    ("analysis", "off"),
    [
        (AnalysisSection(flow_rule="associative", friction_cone="polyhedral"), {"mirror"}),
        (AnalysisSection(flow_rule="associative", force_ranges=True), {"mirror", "points"}),
    ],
)
def test_what_would_change_the_answer_is_off(analysis: AnalysisSection, off: set[str]) -> None:
    allowed = vars(allowed_reductions(analysis))
    assert {name for name, switched_on in allowed.items() if not switched_on} == off


def test_a_pentagon_is_no_mirror_image_of_itself() -> None:
    """One half with its mirror image gave 0.1176 for the circumscribed pentagon, which verification refused."""
    overrides = ("parameters.n=3", "parameters.mu=0.1", "load_cases.push.live=[{acceleration: [0, 1, 0]}]")
    pentagon = ("analysis.friction_cone=polyhedral", "analysis.sides=5", "analysis.standing=false")
    solution, checks, status = verified(line_of(WALL, *overrides, *pentagon))
    assert status is Status.APPROXIMATE, checks.failures
    assert checks.verified
    assert solution.size is not None
    assert solution.size.mirror_planes == 0
    assert checks.static_bound < 0.1 < checks.kinematic_bound < 0.106
