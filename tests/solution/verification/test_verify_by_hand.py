"""Verdicts at both sides of every tolerance, and answers of one block of which each thing said is wrong in turn."""

from __future__ import annotations

import math
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from mbla.solution.solution import Checks, Mechanics, Solution, Status
from mbla.solution.verification.residuals import Residuals
from mbla.solution.verification.verify_points import (
    Bounds,
    failures_of,
    meets_what_was_asked,
    tolerances,
    verified_status,
    verify_points,
)
from tests.line import Line
from tests.solution.by_hand import EXACT, claim, cube, found, limits_of, loaded, on_ground, state

RULES = ("associative", "non_associative", "livesley", "dilatancy")
JUST_ABOVE = 1.0 + 1e-12


def answer(load_factor: float = 1.0) -> Mechanics:
    return state(np.zeros((1, 3)), np.zeros((1, 6)), load_factor)


def failures(residuals: Residuals = EXACT, rule: str = "associative", **bounds: Any) -> tuple[str, ...]:
    """With bounds and factor at 1, unless said otherwise."""
    values = {"static": 1.0, "kinematic": 1.0, "size": 1.0, "factor": 1.0} | bounds
    solution = claim(answer(values.pop("factor")), flow_rule=rule)
    return failures_of(residuals, solution, Bounds(**values))


LIMITS = [
    ("equilibrium", "equilibrium residual", 1e-5),
    ("yielding", "yield violation", 1e-4),
    ("penetration", "penetration", 1e-4),
    ("complementarity", "complementarity residual", 1e-4),
    ("power_balance", "power balance", 1e-4),
]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize(("name", "words", "limit"), LIMITS)
def test_a_residual_may_be_its_limit_and_no_more(name: str, words: str, limit: float, rule: str) -> None:
    assert failures(replace(EXACT, **{name: limit}), rule) == ()
    assert failures(replace(EXACT, **{name: limit * JUST_ABOVE}), rule) == (f"{words} {limit:.2g} exceeds {limit:g}",)
    assert failures(replace(EXACT, **{name: np.nan}), rule) == (f"{words} nan exceeds {limit:g}",)


@pytest.mark.parametrize("power", [1.0 + 1.01e-6, 1.0 - 1.01e-6, 0.0, -1.0, np.nan])
def test_the_live_power_is_one(power: float) -> None:
    (failure,) = failures(replace(EXACT, live_power=power))
    assert failure.startswith("deviation of the live power from 1 ")
    assert failure.endswith(" exceeds 1e-06")
    assert failures(replace(EXACT, live_power=1.0 + 0.99e-6)) == ()
    assert failures(replace(EXACT, live_power=1.0 - 0.99e-6)) == ()


def test_parts_of_other_residuals_are_not_told_twice() -> None:
    assert failures(replace(EXACT, tension=1.0, slip=1.0)) == ()


def test_every_residual_has_its_failure() -> None:
    assert len(failures(Residuals(*[np.nan] * 8))) == 6


@pytest.mark.parametrize("size", [0.5, 2.0])
def test_bounds_may_be_a_hundred_thousandth_apart(size: float) -> None:
    assert failures(kinematic=1.0 + 0.99e-5 * size, size=size) == ()
    assert failures(static=1.0 + 0.99e-5 * size, size=size) == ()
    for bounds in ({"kinematic": 1.0 + 1.01e-5 * size}, {"static": 1.0 + 1.01e-5 * size}, {"static": 0.9}):
        (failure,) = failures(EXACT, "associative", size=size, **bounds)
        assert failure.endswith("lie further apart than 1e-05")


@pytest.mark.parametrize("name", ["static", "kinematic", "size"])
def test_a_bound_that_is_not_there_proves_nothing(name: str) -> None:
    (failure,) = failures(EXACT, "associative", **{name: np.nan})
    assert failure.startswith("static bound ")


def test_bounds_exactly_as_far_apart_as_allowed() -> None:
    assert failures(static=0.0, kinematic=1e-5, factor=0.0) == ()


@pytest.mark.parametrize("size", [0.5, 2.0])
def test_an_associative_factor_lies_between_its_bounds(size: float) -> None:
    for off in (0.99e-5 * size, -0.99e-5 * size, 0.0):
        assert failures(factor=1.0 + off, size=size) == ()
    for off in (1.01e-5 * size, -1.01e-5 * size, 1.0, np.nan):
        (failure,) = failures(factor=1.0 + off, size=size)
        assert "does not lie between its bounds 1 and 1" in failure


def test_the_factor_reported_is_judged_and_not_that_of_the_state_beside_it() -> None:
    """Forces that were asked for beside those of the proof have a load factor of their own."""
    for reported, proved, right in ((1.0, 1.0, True), (1.0 + 2e-5, 1.0, False), (1.0 - 2e-5, 1.0, False)):
        solution = replace(claim(answer(reported)), associative=answer(proved))
        assert (failures_of(EXACT, solution, Bounds(1.0, 1.0, 1.0)) == ()) == right


def test_factors_exactly_as_far_from_their_bounds_as_allowed() -> None:
    for factor in (1e-5, -1e-5):
        assert failures(static=0.0, kinematic=0.0, factor=factor) == ()


@pytest.mark.parametrize("rule", RULES[1:])
def test_another_factor_is_not_above_the_kinematic_bound(rule: str) -> None:
    assert failures(rule=rule, factor=-5.0) == ()
    assert failures(rule=rule, factor=2.0, kinematic=np.nan) == ()
    for size in (0.5, 2.0):
        assert failures(rule=rule, factor=1.0 + 0.99e-4 * size, size=size) == ()
        (failure,) = failures(rule=rule, factor=1.0 + 1.01e-4 * size, size=size)
        assert "exceeds the kinematic bound 1 of the associative one" in failure
    assert failures(rule=rule, factor=1e-4, kinematic=0.0) == ()


def test_tolerances_by_name() -> None:
    others = dict.fromkeys(("yield_violation", "penetration", "complementarity_residual", "power_balance"), 0.0001)
    expected = {"equilibrium_residual": 1e-5, **others, "live_power": 1e-6}
    assert tolerances("associative") == {**expected, "gap": 1e-5}
    for rule in RULES[1:]:
        assert tolerances(rule) == {**expected, "elastic_residual": 1e-4}


def test_dilatancy_that_a_rule_claims() -> None:
    limits = limits_of(2, friction=0.5, dilatancy=0.25)
    claimed = {rule: limits.dilatancy_by(rule).tolist() for rule in RULES}
    assert claimed == {
        "associative": [0.5, 0.5],
        "non_associative": [0.0, 0.0],
        "livesley": [0.0, 0.0],
        "dilatancy": [0.25, 0.25],
    }


MEASURES = (
    "equilibrium_residual",
    "yield_violation",
    "penetration",
    "complementarity_residual",
    "power_balance",
)


def status(checks: Checks, claimed: Status = Status.SOLVED, rule: str = "associative", **changes: Any) -> Status:
    factor = changes.pop("factor", 1.0)
    return verified_status(claim(answer(factor), claimed, flow_rule=rule, **changes), checks)


@pytest.mark.parametrize("verified", [True, False])
@pytest.mark.parametrize("claimed", Status)
def test_what_is_claimed_is_never_raised(claimed: Status, verified: bool) -> None:
    expected = claimed
    if claimed is Status.SOLVED and not verified:
        expected = Status.APPROXIMATE  # no residual is far off
    if claimed in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED) and not verified:
        expected = Status.NOT_VERIFIED
    assert status(found(verified=verified), claimed) is expected


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("name", MEASURES)
def test_a_hundredth_is_approximate_and_no_more(name: str, rule: str) -> None:
    for value, expected in ((1e-2, Status.APPROXIMATE), (1e-2 * JUST_ABOVE, Status.NOT_VERIFIED)):
        for claimed in (Status.SOLVED, Status.APPROXIMATE):
            assert status(found(verified=False, **{name: value}), claimed, rule) is expected
    assert status(found(verified=False, **{name: np.nan}), rule=rule) is Status.NOT_VERIFIED


@pytest.mark.parametrize("rule", RULES)
def test_so_is_the_live_power(rule: str) -> None:
    for power, expected in (
        (1.0099, Status.APPROXIMATE),
        (0.9901, Status.APPROXIMATE),
        (1.0101, Status.NOT_VERIFIED),
        (0.9899, Status.NOT_VERIFIED),
    ):
        assert status(found(verified=False, live_power=power), rule=rule) is expected


def test_so_is_the_gap_of_associative_flow_alone() -> None:
    assert status(found(verified=False, gap=1e-2)) is Status.APPROXIMATE
    assert status(found(verified=False, gap=1.01e-2)) is Status.NOT_VERIFIED
    assert status(found(verified=False, gap=1.0), rule="non_associative") is Status.APPROXIMATE


@pytest.mark.parametrize("bound", [2.0, -2.0])
def test_so_is_another_factor_above_the_kinematic_bound(bound: float) -> None:
    for above, expected in ((0.0199, Status.APPROXIMATE), (0.0201, Status.NOT_VERIFIED), (-1.0, Status.APPROXIMATE)):
        checks = found(verified=False, kinematic_bound=bound)
        assert status(checks, rule="non_associative", factor=bound + above) is expected
        assert status(checks, factor=bound + above) is Status.APPROXIMATE  # its gap speaks for that


def test_verified_by_the_program_that_gave_up_is_approximate() -> None:
    assert status(found(), Status.APPROXIMATE) is Status.APPROXIMATE


def meets(checks: Checks, rule: str = "associative", asked: float | None = 1e-3, factor: float = 1.0) -> bool:
    return meets_what_was_asked(
        claim(answer(factor), Status.APPROXIMATE, flow_rule=rule, tolerance_requested=asked), checks
    )


def test_what_was_asked_of_associative_flow_is_the_gap() -> None:
    assert meets(found(gap=1e-3))
    assert not meets(found(gap=1e-3 * JUST_ABOVE))
    assert not meets(found(gap=np.nan))
    for name in MEASURES:
        assert meets(found(**{name: 1e-2}))
        assert not meets(found(**{name: 1e-2 * JUST_ABOVE}))
        assert not meets(found(**{name: np.nan}))


@pytest.mark.parametrize("rule", RULES[1:])
def test_what_was_asked_of_other_flow_is_every_residual(rule: str) -> None:
    assert meets(found(gap=1.0), rule)
    for name in MEASURES:
        assert meets(found(**{name: 1e-3}), rule)
        assert not meets(found(**{name: 1e-3 * JUST_ABOVE}), rule)
    for bound in (2.0, -2.0):
        assert meets(found(kinematic_bound=bound), rule, factor=bound + 0.00199)
        assert not meets(found(kinematic_bound=bound), rule, factor=bound + 0.00201)


def test_nothing_is_met_that_was_not_asked_or_not_found() -> None:
    assert not meets(found(), asked=None)
    assert not meets_what_was_asked(claim(None, Status.APPROXIMATE, tolerance_requested=1e-3), found())


@pytest.mark.parametrize("rule", RULES)
def test_a_mechanism_of_another_size_meets_nothing(rule: str) -> None:
    for off in (0.99e-6, -0.99e-6):
        assert meets(found(live_power=1.0 + off), rule)
    for off in (1.01e-6, -1.01e-6, np.nan):
        assert not meets(found(live_power=1.0 + off), rule)


# A block 1 x 1 x 0.5 on the ground, friction 1/2, weight 32, a push of 8 λ at its base; it slides and rises by μ.


@pytest.fixture(scope="module")
def line() -> Line:
    dry = cube()
    return replace(dry, load_case=loaded(dry.load_case, (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, -2, 0)))


def slides(line: Line, factor: float = 2.0, **changes: Any) -> Mechanics:
    found = state(on_ground(line.model, line.contacts, (8, -2 * factor, 0)), np.array([[0.125, 0, 0.0625, 0, 0, 0]]), 2)
    return replace(found, load_factor=factor, **changes)


def judged(line: Line, solution: Solution) -> Checks:
    return verify_points(line.model, line.contacts, line.load_case, solution)


def test_the_exact_answer(line: Line) -> None:
    checks = judged(line, claim(slides(line)))
    assert checks.verified, checks.failures
    bounds = (checks.static_bound, checks.kinematic_bound, checks.live_power)
    assert bounds == pytest.approx((2.0, 2.0, 1.0), abs=1e-8)
    left = (checks.equilibrium_residual, checks.yield_violation, checks.complementarity_residual, checks.gap)
    assert left == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-8)
    assert (checks.penetration, checks.power_balance) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert (checks.tension_violation, checks.slip_residual) == pytest.approx((0.0, 0.0), abs=1e-12)


@pytest.fixture
def bounds(monkeypatch: pytest.MonkeyPatch) -> dict[str, tuple[float, float]]:
    """What the proofs find of the associative state: set by the test."""
    of: dict[str, tuple[float, float]] = {}
    monkeypatch.setattr(
        import_module("mbla.solution.verification.verify_points"), "associative_bounds", lambda *_: of["bounds"]
    )
    return of


@pytest.mark.parametrize(
    ("static", "kinematic", "told", "gap"),
    [
        (2.0, 2.0, 2.0, 0.0),
        (2.0 + 1.9e-9, 2.0, 2.0, 0.0),  # they have met
        (2.0 + 2.1e-9, 2.0, 2.0 + 2.1e-9, 1.05e-9),
        (1.0, 2.0, 1.0, 0.5),
        (-1.0, -2.0, -1.0, 0.5),
        (0.0, 0.001, 0.0, math.hypot(8.0, 2.0 / 0.75) / 32.0),  # over a thousandth of dead over live load
        (np.nan, 2.0, np.nan, np.nan),
        (2.0, np.nan, 2.0, np.nan),
    ],
)
def test_bounds_as_they_are_told(
    static: float, kinematic: float, told: float, gap: float, line: Line, bounds: dict[str, tuple[float, float]]
) -> None:
    bounds["bounds"] = static, kinematic
    checks = judged(line, claim(slides(line)))
    assert checks.static_bound == pytest.approx(told, abs=1e-15, nan_ok=True)
    assert checks.kinematic_bound == pytest.approx(kinematic, nan_ok=True)
    assert checks.gap == pytest.approx(gap, rel=1e-5, nan_ok=True)
    assert checks.verified == (gap <= 1e-5)


def test_without_an_associative_state_there_are_no_bounds(line: Line) -> None:
    still = slides(line, mechanism=np.array([[0.125, 0, 0, 0, 0, 0]]))
    checks = judged(line, claim(still, flow_rule="non_associative", associative=None))
    assert checks.verified, checks.failures
    assert np.isnan([checks.static_bound, checks.kinematic_bound, checks.gap]).all()


def test_an_answer_without_mechanics_is_judged_by_its_reason(line: Line) -> None:
    for status, failures in ((Status.TIME_LIMIT, ("time is up",)), (Status.UNBOUNDED, ())):
        checks = judged(line, claim(None, status, reason="time is up"))
        assert checks.failures == failures
        assert checks.verified == (not failures)
        assert np.isnan([checks.equilibrium_residual, checks.live_power, checks.static_bound, checks.gap]).all()


def test_a_certificate_speaks_for_itself(line: Line) -> None:
    """Pushed beyond its friction by the dead load alone, the block slides and rises."""
    pushed = replace(line, load_case=loaded(line.load_case, (20, 0, -32, 0, -5, 0), (8, 0, 0, 0, -2, 0)))
    slipping = np.array([[2.0, 0, 1.0, 0, 0, 0]])
    for motion, failures in ((slipping, 0), (-slipping, 1)):
        checks = judged(pushed, claim(None, Status.NO_EQUILIBRIUM, certificate=motion, reason="it falls"))
        assert len(checks.failures) == failures
        assert checks.verified == (not failures)
        assert "it falls" not in checks.failures
