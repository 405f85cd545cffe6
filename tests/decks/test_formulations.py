"""The exact formulations of one statement give one load factor: cone and linear programs, in the plane and in space.

What each formulation is for is told in decks/benchmarks/README.md.
"""

from __future__ import annotations

import pytest

from tests.decks.folder import BENCHMARKS, run_deck

pytestmark = pytest.mark.long

ASSOCIATIVE = "analysis.flow_rule=associative"
SPATIAL = "analysis.reductions=false"
CONE, HIGHS = (ASSOCIATIVE,), (ASSOCIATIVE, "analysis.solver=highs")
OCTAGON = (ASSOCIATIVE, "analysis.friction_cone=polyhedral", "analysis.sides=8")
CONVEX = (ASSOCIATIVE, "analysis.contact_model=convex")
SETTLED = ("analysis.flow_rule=non_associative", "analysis.scheme=proximal")
INTERIOR = ("analysis.flow_rule=non_associative", "analysis.scheme=interior")
CASES = {
    "ferris_wall_1_associative": (CONE, HIGHS, OCTAGON, CONVEX, (*CONE, SPATIAL)),
    "ferris_wall_3_associative": (CONE, HIGHS, OCTAGON, CONVEX, (*CONE, SPATIAL), (*OCTAGON, SPATIAL)),
    "ferris_wall_5_associative": (CONE, HIGHS, OCTAGON, CONVEX, (*CONE, SPATIAL)),
    "oppenheim_arch": (CONE, CONVEX, SETTLED, INTERIOR),
    "arch_50_voussoirs": (CONE, HIGHS, CONVEX, SETTLED, INTERIOR, (*CONE, SPATIAL)),
    "wall_10x10": (CONE, HIGHS, (*CONE, SPATIAL)),
    "leaning_block_rough_wall": (CONE, CONVEX),
    "eccentric_compression": (CONE, CONVEX),
    "block_rocking": (CONE, CONVEX),
}
"""of the first load case of a benchmark deck: overrides of its analysis"""


@pytest.mark.parametrize("name", CASES)
def test_exact_formulations_agree(name: str) -> None:
    for overrides in CASES[name]:
        case, *_ = run_deck(BENCHMARKS[name], *(word for each in overrides for word in ("--set", each))).record["cases"]
        assert case["status"] == "solved", overrides
        if overrides is CASES[name][0]:
            figure = case["load_factor"]
        assert case["load_factor"] == pytest.approx(figure, rel=1e-6), overrides
