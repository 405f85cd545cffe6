"""The figures of a case, one to a line: load factors, bounds, residuals, what was solved, what was verified."""

from __future__ import annotations

import numpy as np

from mbla.model.model import Model
from mbla.results.listing.answers import LEAST_AND_GREATEST, answer_head, extent_figures, settlement_lines, status_name
from mbla.results.listing.solving import solver_lines
from mbla.results.listing.text import counted, entry, number, sentence, small
from mbla.results.outcome import associative_of, best_iterate, extent_of, locked_in, range_of, result_of
from mbla.results.results import CaseResult
from mbla.results.tilt_angle import angle_bounds, angle_of
from mbla.solution.solution import Checks, Mechanics, ModelSize, Status


def figures(model: Model, case: CaseResult) -> list[str]:
    """Load factors by both flow rules, bounds, residuals, size of the program, verdict of the verification."""
    lines = (
        entry("status", status_name(case.status))
        + settlement_lines(model, case)
        + _factors(model, case)
        + _bounds(case)
    )
    for name, value, measure in residual_figures(case.checks):
        if not np.isnan(value):
            lines += entry(name, f"{small(value)}   {measure}")
    lines += _standing(model, case)
    if case.solution.size is not None:
        lines += entry("solved as", size_words(case.solution.size))
    return lines + solver_lines(case.solution) + _verification(case)


def _factors(model: Model, case: CaseResult) -> list[str]:
    """The factor by the deck's flow rule with all that surrounds it, then the associative one."""
    solution = case.solution
    own, best, associative = result_of(case), best_iterate(case), associative_of(case)
    rule = solution.flow_rule
    lines = entry("scheme", solution.scheme) if solution.scheme else []
    if own is not None:
        lines += entry(f"load factor, {rule}", number(own.load_factor))
    if best is not None:
        lines += entry(f"best iterate, {rule}", f"{number(best.load_factor)}   (no load factor)")
    lines += _angle(case)
    if extent_of(model, case) is not None:
        for which, figure in zip(LEAST_AND_GREATEST, extent_figures(model, case), strict=True):
            lines += entry(f"{answer_head(model, case.load_case)}, {which}", figure)
    ends = range_of(case)
    if ends is not None:
        lines += entry("range for this mechanism", f"{_digits(ends[0])} .. {_digits(ends[1])}   (verified)")
    elif own is not None and (solution.lower is not None or solution.upper is not None):
        claimed = [number(np.nan if end is None else end.load_factor) for end in (solution.lower, solution.upper)]
        lines += entry("range for this mechanism", f"{' .. '.join(claimed)}   (NOT verified)")
    if solution.spread is not None:
        lines += entry("spread of several tries", " .. ".join(number(end) for end in solution.spread))
    if associative is not None and solution.flow_rule != "associative":
        lines += entry("load factor, associative", _beside(associative, own))
    return lines + _bracket(case)


def _angle(case: CaseResult) -> list[str]:
    """A tilting table: the angle, and those between which it is proved to lie."""
    if case.load_case.tilt is None:
        return []
    lines = entry("angle", f"{_digits(angle_of(case))} degrees")
    low, high = angle_bounds(case)
    if np.isnan(low) and np.isnan(high):
        return lines
    return lines + entry("angle, associative bounds", f"{_digits(low)} .. {_digits(high)} degrees")


def _bracket(case: CaseResult) -> list[str]:
    """Polyhedral friction: the factor with the inscribed and the circumscribed polyhedron."""
    solution = case.solution
    if solution.outer is None:
        return []
    inner = "-" if solution.associative is None else _digits(solution.associative.load_factor)
    outer = f"{_digits(solution.outer.load_factor)}   ({solution.sides} sides; the cone lies between)"
    return entry("inscribed polyhedron", inner) + entry("circumscribed polyhedron", outer)


def _bounds(case: CaseResult) -> list[str]:
    checks = case.checks
    if np.isnan(checks.static_bound) and np.isnan(checks.kinematic_bound):
        return []
    lines = entry("associative, static bound", _digits(checks.static_bound))
    lines += entry("associative, kinematic bound", _digits(checks.kinematic_bound))
    return lines + entry("relative gap", small(checks.gap))


def _digits(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.8g}"


def _beside(associative: Mechanics, own: Mechanics | None) -> str:
    text = number(associative.load_factor)
    if own is None or associative.load_factor == 0:
        return text
    difference = round(100 * (own.load_factor / associative.load_factor - 1), 2) + 0.0
    return f"{text}   (the one above differs by {difference:+.2f} %)" if difference else text


def residual_figures(checks: Checks) -> tuple[tuple[str, float, str], ...]:
    """Name, value and what each residual is relative to."""
    return (
        ("equilibrium residual", checks.equilibrium_residual, "of the mean load of a block"),
        ("yield violation", checks.yield_violation, "of the mean load of a block"),
        ("tension violation", checks.tension_violation, "of the mean load of a block"),
        ("penetration", checks.penetration, "of the largest contact velocity"),
        ("complementarity residual", checks.complementarity_residual, "of the power"),
        ("slip residual", checks.slip_residual, "of the power"),
        ("power balance", checks.power_balance, "of the power"),
    )


def _standing(model: Model, case: CaseResult) -> list[str]:
    """Whether it stands before any live load, and the block that falls."""
    standing = case.solution.standing
    if standing is None:
        return []
    block = "" if standing.block is None else f": {model.blocks.name(standing.block)} would fall first"
    lines = entry("stands under dead load", f"{standing.verdict.value}{block}")
    lines += sentence(standing.reason, "    ")
    if locked_in(case) and case.solution.mechanics is not None:
        lines += sentence("WARNING: the load factor presumes a self-stressed state; it is no collapse load", "    ")
    return lines


def size_words(size: ModelSize) -> str:
    """What reached the solver."""
    words = ["planar" if size.dimension == 2 else "spatial"]
    dropped = f" ({size.dropped_points} more left out)" if size.dropped_points else ""
    words += [counted(size.free_blocks, "free block"), counted(size.contact_points, "contact point") + dropped]
    if size.mirror_planes:
        words.append(f"{counted(size.mirror_planes, 'mirror plane')} used")
    if size.parts > 1:
        words.append(f"{size.parts} independent parts")
    return ", ".join(words)


def verification_verdict(case: CaseResult) -> str:
    """``passed`` is said of an answer; of a case that has none only that its status is confirmed."""
    if not case.checks.verified:
        return "NOT PASSED"
    if case.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        return f"confirmed: {status_name(case.status)}"
    return "passed" if case.solution.mechanics is not None else "nothing contradicts the status"


def _verification_words(case: CaseResult) -> str:
    """The same with what was recomputed."""
    told = verification_verdict(case)
    if case.checks.verified and case.status is Status.NO_EQUILIBRIUM:
        return f"{told}, recomputed from the motion in which the dead load falls"
    if case.checks.verified and case.solution.lock is not None and case.status is Status.UNBOUNDED:
        return f"{told}, recomputed from forces that carry any multiple of the live load"
    recomputed = case.checks.verified and case.solution.mechanics is not None
    return f"{told}: everything recomputed from model, contacts and solution" * recomputed or told


def _verification(case: CaseResult) -> list[str]:
    lines = entry("verification", _verification_words(case))
    if case.checks.verified:
        return lines
    told = (case.solution.reason,)
    return lines + [line for text in case.checks.failures if text not in told for line in sentence(text, "    ")]
