"""A key that is given and has no effect is said to have none; one that has an effect is not."""

from __future__ import annotations

import pytest

from mbla.deck.sections.analysis import APPLIES, AnalysisSection
from tests.line import BLOCK, line_of

WITHOUT = BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {}")


def idle(*overrides: str) -> list[str]:
    notices = line_of(WITHOUT, *overrides).deck.notices
    return [notice.message for notice in notices if notice.identifier == "key-idle"]


@pytest.mark.parametrize(
    ("key", "idle_with", "used_with"),
    [
        ("analysis.sides=6", "flow_rule=associative", "friction_cone=polyhedral"),
        ("analysis.scheme=path", "flow_rule=associative", "flow_rule=non_associative"),
        ("analysis.proximal.max_programs=9", "scheme=path", "scheme=proximal"),
        ("analysis.interior.tries=2", "contact_model=convex", "scheme=interior"),
        ("analysis.path.steps=9", "scheme=auto", "scheme=path"),
        ("analysis.lowest.seed=2", "scheme=auto", "scheme=lowest"),
        ("analysis.published.slope=0.01", "scheme=auto", "scheme=published"),
        ("analysis.gap=1e-5", "contact_model=convex", "contact_model=concave"),
        ("analysis.residual=1e-5", "flow_rule=associative", "flow_rule=dilatancy"),
        ("analysis.residual=1e-5", "scheme=published", "scheme=interior"),
        ("analysis.peak=false", "flow_rule=dilatancy", "flow_rule=non_associative"),
        ("analysis.range=false", "flow_rule=associative", "flow_rule=livesley"),
        ("analysis.reductions=false", "contact_model=convex", "contact_model=concave"),
        ("joints.dry.dilatancy=5", "flow_rule=non_associative", "flow_rule=dilatancy"),
    ],
)
def test_with_what_a_key_has_an_effect(key: str, idle_with: str, used_with: str) -> None:
    linear = ["analysis.flow_rule=associative"] if "polyhedral" in used_with else []
    (message,) = idle(key, f"analysis.{idle_with}")
    assert "has no effect: it applies to" in message
    assert idle(key, f"analysis.{used_with}", *linear) == []


def test_keys_that_are_not_given_are_not_mentioned() -> None:
    assert idle() == idle("analysis.flow_rule=associative") == []


def test_every_entry_is_a_key() -> None:
    assert set(APPLIES) <= set(AnalysisSection.model_fields)
