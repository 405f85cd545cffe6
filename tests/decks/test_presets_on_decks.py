"""The presets keep the error that they promise on a sample of the decks of this repository, under both flow rules.

Measured: a draft is off by at most 1.8e-5 with associative flow, an arch that hardly stands, and by 0.4 % without
dilatancy, the arch on piers of the tutorials; standard by 5e-8, and by 7e-5, a wall of Ferris and Tin-Loi under the
published scheme, which does not settle. Bounds of the reference lie within 1.03e-7 of each other.
"""

from __future__ import annotations

from pathlib import Path

import pytest

import mbla
from mbla.deck import read_deck
from mbla.errors import MblaError
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from tests.decks.folder import BENCHMARKS, DECKS
from tests.performance.standard_set import FLOW_RULES

pytestmark = pytest.mark.long

PROMISED = {"draft": 1e-2, "standard": 1e-4}
PROVED = 1e-7
"""distance of the bounds of the reference"""
ROUNDING = 1e-9
"""distance of the bounds, as a factor, that is rounding where the factor is a thousandth (overhang_stack)"""
UNSETTLED = 1e-3
"""of sequences of the published scheme that do not settle and end approximate: their last factors lie that far apart"""
SAMPLE = [
    *(BENCHMARKS[name] for name in ("groove", "overhang_stack", "torque", "wall_5x5", "ferris_wall_3")),
    *(BENCHMARKS[name] for name in ("beam_on_three_supports", "tilting_block", "mortar_joint", "oppenheim_arch")),
    *(DECKS / "tutorials" / f"{name}.yaml" for name in ("arch", "block", "column", "trilithon", "dolmen")),
]


def cases_of(deck: Path, accuracy: str, rule: str) -> tuple[CaseResult, ...]:
    settings = (f"analysis.accuracy={accuracy}", f"analysis.flow_rule={rule}")
    return tuple(mbla.run(deck, set=settings).records.cases)


@pytest.mark.parametrize("rule", FLOW_RULES)
@pytest.mark.parametrize("deck", SAMPLE, ids=lambda path: path.stem)
def test_presets_keep_their_promise(deck: Path, rule: str) -> None:
    try:
        read_deck(deck, (f"analysis.flow_rule={rule}",))
    except MblaError as error:
        pytest.skip(f"the deck does not take it: {error}")
    reference = cases_of(deck, "reference", rule)
    for case in reference:
        circular = read_deck(deck).analysis.friction_cone == "circular"
        if rule == "associative" and circular and result_of(case) is not None:
            apart = case.checks.kinematic_bound - case.checks.static_bound
            assert case.checks.gap <= PROVED or apart <= ROUNDING, case.load_case.name
    for accuracy, share in PROMISED.items():
        for case, sharp in zip(cases_of(deck, accuracy, rule), reference, strict=True):
            found, exact = result_of(case), result_of(sharp)
            assert (found is None) == (exact is None), case.load_case.name
            if found is not None and exact is not None:
                unsettled = UNSETTLED if sharp.status is Status.APPROXIMATE else 0.0
                expected = pytest.approx(exact.load_factor, rel=max(share, unsettled), abs=ROUNDING)
                assert found.load_factor == expected, f"{accuracy}, {case.load_case.name}"
