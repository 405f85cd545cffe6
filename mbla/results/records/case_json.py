"""One load case as an object of the JSON record; values that do not exist are None, numbers are finite."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.listing.answers import reaction_json
from mbla.results.listing.solving import solver_json
from mbla.results.outcome import associative_of, best_iterate, factor_unique, least_and_greatest, range_of, result_of
from mbla.results.records.mechanism_json import mechanism_json, mechanism_on_demand
from mbla.results.records.numbers import number
from mbla.results.records.power_json import powers_json
from mbla.results.records.reactions_json import reactions_json
from mbla.results.records.reduction_json import reductions_json
from mbla.results.results import CaseResult
from mbla.results.tilt_angle import angle_bounds, angle_of
from mbla.solution.solution import Checks, Mechanics, Solution


def case_json(model: Model, contacts: Contacts, case: CaseResult, *, on_demand: bool = False) -> dict[str, Any]:
    """Everything that is said of a case; ``load_factor`` and ``mechanism`` only where they are results.

    on_demand : values of the mechanism, which take longer than all others, are found when they are asked for
    """
    mechanism = mechanism_on_demand if on_demand else mechanism_json
    solution, checks, model = case.solution, case.checks, model.of_case(case.load_case)
    mechanics = result_of(case)
    solver = float(sum(program.seconds for program in solution.programs))
    return {
        "name": case.load_case.name,
        "status": case.status.value,
        "reason": solution.reason or None,
        "remarks": list(solution.remarks),
        "flow_rule": solution.flow_rule,
        "scheme": solution.scheme or None,
        **_load_factors(model, case),
        **_single_checks(checks),
        "residuals": residuals_json(checks),
        "verified": checks.verified,
        "failures": list(checks.failures),
        "standing": _standing(model, solution),
        "certificate": _certificate(solution),
        "programs": len(solution.programs),
        "iterations": sum(program.iterations for program in solution.programs),
        "solver": solver_json(solution),
        "size": None if solution.size is None else asdict(solution.size),
        "reductions": reductions_json(solution.reductions),
        "path": [{name: finite(value) for name, value in asdict(point).items()} for point in solution.path],
        "mechanism": None
        if mechanics is None
        else mechanism(model, contacts, case.load_case, mechanics, _dimension(case)),
        "reactions": None if mechanics is None else reactions_json(model, contacts, case.load_case, mechanics),
        "time": {"total": number(solution.seconds), "solver": number(solver)},
    }


def _dimension(case: CaseResult) -> int:
    """In which it was solved."""
    return 3 if case.solution.size is None else case.solution.size.dimension


def _load_factors(model: Model, case: CaseResult) -> dict[str, Any]:
    """The load factor, what it means, and everything that stands beside it."""
    solution, checks = case.solution, case.checks
    mechanics, associative, ends = result_of(case), associative_of(case), range_of(case)
    least, greatest = least_and_greatest(model, case)
    return {
        "load_factor": None if mechanics is None else number(mechanics.load_factor),
        "least_load_factor": number(least),
        "greatest_load_factor": number(greatest),
        "angle": number(angle_of(case)),
        "angle_bounds": _angle_bounds(case),
        "reaction": reaction_json(case),
        "factor_unique": factor_unique(model, case),
        "range": None if ends is None else [number(end) for end in ends],
        "peak": number(checks.peak_load_factor),
        "spread": None if solution.spread is None else [number(end) for end in solution.spread],
        "best_iterate": _best_iterate(case),
        "static_bound": number(checks.static_bound),
        "kinematic_bound": number(checks.kinematic_bound),
        "gap": number(checks.gap),
        "asked": None if solution.asked is None else number(solution.asked),
        "associative_load_factor": None if associative is None else number(associative.load_factor),
        "bracket": _bracket(solution, associative),
        "powers": powers_json(model, case),
    }


def _single_checks(checks: Checks) -> dict[str, float | None]:
    """What was measured of forces and mechanism, a key each."""
    return {
        "equilibrium_residual": number(checks.equilibrium_residual),
        "yield_violation": number(checks.yield_violation),
        "tension_violation": number(checks.tension_violation),
        "penetration": number(checks.penetration),
        "complementarity_residual": number(checks.complementarity_residual),
        "slip_residual": number(checks.slip_residual),
        "live_power": number(checks.live_power),
        "power_balance": number(checks.power_balance),
    }


def finite(value: float | int) -> float | int | None:
    """The same, whole numbers left whole."""
    return value if isinstance(value, int) else number(value)


def residuals_json(checks: Checks) -> dict[str, float | None]:
    """The residuals of forces and mechanism in one object."""
    return {
        "equilibrium": number(checks.equilibrium_residual),
        "yield": number(checks.yield_violation),
        "tension": number(checks.tension_violation),
        "penetration": number(checks.penetration),
        "complementarity": number(checks.complementarity_residual),
        "slip": number(checks.slip_residual),
    }


def _angle_bounds(case: CaseResult) -> list[float | None] | None:
    return None if case.load_case.tilt is None else [number(angle) for angle in angle_bounds(case)]


def _best_iterate(case: CaseResult) -> dict[str, Any] | None:
    best = best_iterate(case)
    if best is None:
        return None
    return {"load_factor": number(best.load_factor), "residuals": residuals_json(case.checks)}


def _bracket(solution: Solution, associative: Mechanics | None) -> dict[str, float | int | None] | None:
    """Polyhedral friction: associative factors with the inscribed and the circumscribed polyhedron."""
    if solution.outer is None or associative is None:
        return None
    inner, outer = number(associative.load_factor), number(solution.outer.load_factor)
    return {"inner": inner, "outer": outer, "sides": solution.sides}


def _standing(model: Model, solution: Solution) -> dict[str, str | None] | None:
    standing = solution.standing
    if standing is None:
        return None
    block = None if standing.block is None else model.blocks.name(standing.block)
    return {"verdict": standing.verdict.value, "block": block, "reason": standing.reason or None}


def _certificate(solution: Solution) -> str | None:
    """What proves that there is no load factor: a motion, or forces that balance the live load alone."""
    if solution.certificate is not None:
        return "motion"
    return "forces" if solution.lock is not None else None
