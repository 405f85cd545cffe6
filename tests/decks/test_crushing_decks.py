"""Decks of joints that crush have their figures with either flow rule and contact model."""

from __future__ import annotations

import pytest

from mbla.deck import read_deck
from tests.decks.folder import DECKS
from tests.line import factor_of

pytestmark = pytest.mark.long

CLOSED_FORMS: tuple[tuple[str, int, tuple[str, ...]], ...] = (
    ("regressions/two_footings_crushing", 0, ()),
    ("regressions/two_footings_crushing", 1, ()),
    ("regressions/block_crushing_a_corner", 0, ()),
    ("regressions/trapezium_crushing", 0, ()),
    ("regressions/trapezium_crushing", 1, ("t=1.5",)),
    ("regressions/ground_given_twice_crushing", 0, ()),
    *(
        ("benchmarks/closed_forms/eccentric_compression", 1, (f"ecc={ecc}", f"fc={fc}"))
        for ecc, fc in ((0.1, 1e6), (0.4, 3e5), (0.0, 1e7))
    ),
)
WAYS = (("associative", "concave"), ("non_associative", "concave"), ("associative", "convex"))


@pytest.mark.parametrize(("flow_rule", "contact_model"), WAYS)
@pytest.mark.parametrize(("name", "case", "values"), CLOSED_FORMS)
def test_closed_forms_of_stress_blocks(
    name: str, case: int, values: tuple[str, ...], flow_rule: str, contact_model: str
) -> None:
    path = DECKS / f"{name}.yaml"
    ways = [f"parameters.{value}" for value in values]
    expected = list(read_deck(path, ways).content.expected.values())[case].load_factor
    ways += [f"analysis.flow_rule={flow_rule}", f"analysis.contact_model={contact_model}"]
    assert factor_of(path.read_text(encoding="utf-8"), *ways, case=case) == pytest.approx(expected, rel=1e-6)
