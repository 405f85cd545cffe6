"""What does not go with ``contact_model: convex`` is refused in one line each."""

import pytest

from mbla.errors import DeckError
from tests.line import BLOCK, line_of

CONVEX = BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {contact_model: convex}")


@pytest.mark.parametrize(
    "override",
    [
        "analysis.flow_rule=associative",
        "analysis.scheme=proximal",
        "analysis.solver=clarabel",
        "contacts.points.per_edge=2",
    ],
)
def test_what_goes_with_it(override: str) -> None:
    assert line_of(CONVEX, override).deck.analysis.contact_model == "convex"


@pytest.mark.parametrize(
    ("override", "key"),
    [
        ("analysis.flow_rule=dilatancy", "flow_rule"),
        ("analysis.flow_rule=livesley", "flow_rule"),
        ("analysis.scheme=path", "scheme"),
        ("analysis.scheme=interior", "scheme"),
        ("analysis.solver=mbla", "solver"),
        ("analysis.force_ranges=true", "force_ranges"),
        ("contacts.points.inset=0.1", "inset"),
    ],
)
def test_what_does_not(override: str, key: str) -> None:
    with pytest.raises(DeckError) as raised:
        line_of(CONVEX, override)
    (fault,) = raised.value.faults
    assert key in fault.key
    assert "contact_model: con" in fault.message
