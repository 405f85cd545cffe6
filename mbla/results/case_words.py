"""The result of one load case in words: how it collapses, how well that is known, where the forces go."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.mechanics import (
    live_load_in_g,
    load_on_structure,
    power_shares,
    support_reactions,
)
from mbla.results.mechanism_words import certificate_lines, mechanism_lines, mechanism_summary
from mbla.results.results import CaseResult
from mbla.results.text import counted, entry, heading, number, sentence, small, table
from mbla.solution.solution import Checks, Mechanics, Solution, Status


def load_factor_words(model: Model, load_case: LoadCase, load_factor: float) -> str:
    """``0.145 g`` where the live load is an acceleration, else ``0.643 times the live load``."""
    size = live_load_in_g(model, load_case)
    if size is None:
        return f"{number(load_factor)} times the live load"
    return f"{number(load_factor * size)} g"


def verdict(model: Model, case: CaseResult) -> str:
    """The outcome of a case in one line."""
    solution = case.solution
    if solution.mechanics is None:
        words = {
            Status.NO_EQUILIBRIUM: "no equilibrium: the structure cannot carry its dead load",
            Status.UNBOUNDED: "no collapse: the live load never brings the structure down",
            Status.ITERATION_LIMIT: "not solved: out of iterations",
            Status.TIME_LIMIT: "not solved: out of time",
            Status.NUMERICAL_ERROR: "not solved: numerical failure",
        }
        return words.get(case.status, f"not solved ({case.status.value})")
    at = f"collapses at {load_factor_words(model, case.load_case, solution.mechanics.load_factor)}"
    remarks = {
        Status.SOLVED: f"{at}, verified",
        Status.APPROXIMATE: f"{at}, approximately",
        Status.NOT_VERIFIED: f"NOT VERIFIED; the solver says that it {at}",
    }
    return remarks.get(case.status, f"NOT SOLVED ({case.status.value}); last value: {at}")


def beside_associative(case: CaseResult) -> str:
    """`` (associative 0.646)`` where the deck's flow rule is another one and both answers are there, else nothing."""
    own, associative = case.solution.mechanics, case.solution.associative
    if own is None or associative is None or associative is own:
        return ""
    return f" (associative load factor {number(associative.load_factor)})"


def case_lines(model: Model, contacts: Contacts, case: CaseResult) -> list[str]:
    """The section of one load case."""
    lines = heading(f"Load case {case.load_case.name}")
    mechanics = case.solution.mechanics
    says = verdict(model, case)
    if mechanics is not None:
        says += f": {mechanism_summary(model, contacts, mechanics)}"
    lines += sentence(says + ".")
    if case.solution.reason:
        lines += sentence(case.solution.reason)
    if mechanics is None and case.solution.certificate is not None:
        lines += certificate_lines(model, case.solution.certificate)
    lines += ["", *figures(model, case)]
    if mechanics is not None:
        lines += ["", *mechanism_lines(model, contacts, mechanics)]
        lines += _power(model, case.load_case, mechanics)
        lines += ["", *_reactions(model, contacts, case.load_case, mechanics)]
    return lines + _programs(case.solution)


def figures(model: Model, case: CaseResult) -> list[str]:
    """Load factors by both flow rules, bounds, residuals, verdict of the verification."""
    solution, checks = case.solution, case.checks
    lines = entry("status", case.status.value)
    if solution.mechanics is not None:
        lines += entry(f"load factor, {solution.flow_rule}", number(solution.mechanics.load_factor))
    if solution.associative is not None and solution.flow_rule != "associative":
        lines += entry("load factor, associative", _beside(solution.associative, solution.mechanics))
    if not np.isnan(checks.static_bound) or not np.isnan(checks.kinematic_bound):
        lines += entry("associative, static bound", _digits(checks.static_bound))
        lines += entry("associative, kinematic bound", _digits(checks.kinematic_bound))
        lines += entry("relative gap", small(checks.gap))
    for name, value in _residuals(checks):
        if not np.isnan(value):
            lines += entry(name, small(value))
    return lines + _verification(case)


def _digits(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.8g}"


def _beside(associative: Mechanics, own: Mechanics | None) -> str:
    text = number(associative.load_factor)
    if own is None or associative.load_factor == 0:
        return text
    difference = round(100 * (own.load_factor / associative.load_factor - 1), 2) + 0.0
    return f"{text}   (the one above differs by {difference:+.2f} %)" if difference else text


def _residuals(checks: Checks) -> tuple[tuple[str, float], ...]:
    return (
        ("equilibrium residual", checks.equilibrium_residual),
        ("yield violation", checks.yield_violation),
        ("penetration", checks.penetration),
        ("complementarity residual", checks.complementarity_residual),
        ("power balance", checks.power_balance),
    )


def _verification(case: CaseResult) -> list[str]:
    if case.checks.verified and case.solution.mechanics is not None:
        return entry("verification", "passed: everything recomputed from model, contacts and solution")
    if case.checks.verified:
        return entry("verification", "nothing contradicts the status")
    lines = entry("verification", "NOT PASSED")
    return lines + [line for failure in case.checks.failures for line in sentence(failure, "    ")]


def _power(model: Model, load_case: LoadCase, mechanics: Mechanics) -> list[str]:
    """Where the power of the live load goes."""
    shares = power_shares(model, load_case, mechanics)
    if shares.live <= 0:
        return []
    powers = (-shares.dead, shares.friction, shares.joints)
    lifted, friction, joints = (round(100 * power / shares.live, 1) + 0.0 for power in powers)
    text = f"Of the power of the live load {lifted:.1f} % goes into the dead load, {friction:.1f} % into friction"
    rest = f", {joints:.1f} % into the joints' normal forces" if joints else ""
    return sentence(text + rest + ".")


def _reactions(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> list[str]:
    """Forces of the supports on the structure, and how they balance the loads on the free blocks."""
    reactions = support_reactions(model, contacts, mechanics.contact_forces)
    total = np.sum([reaction.wrench for reaction in reactions], axis=0) if reactions else np.zeros(6)
    load = load_on_structure(model, load_case, mechanics.load_factor)
    named = [(reaction.support, reaction.wrench) for reaction in reactions]
    named += [("sum of reactions", total), ("loads on free blocks", load), ("out of balance", total + load)]
    force, length = model.units.force, model.units.length
    head = ["reaction on the structure", *(f"F{axis}" for axis in "xyz"), *(f"M{axis}" for axis in "xyz")]
    return [
        *sentence(f"Reactions at collapse, forces in {force}, moments about the origin in {force} {length}:"),
        *table(head, [[name, *_components(wrench, load)] for name, wrench in named]),
        *sentence("Single forces are not unique where the structure is statically indeterminate."),
    ]


def _components(wrench: FloatArray, load: FloatArray) -> list[str]:
    """Six numbers; what is below 1e-9 of the load is noise of the last digits."""
    sizes = np.repeat([np.abs(load[:3]).max(), max(np.abs(load[3:]).max(), np.abs(load[:3]).max())], 3)
    return [f"{0.0 if abs(v) < 1e-9 * s else v:.5g}" for v, s in zip(wrench, sizes, strict=True)]


def _programs(solution: Solution) -> list[str]:
    if not solution.programs:
        return []
    total = sum(program.iterations for program in solution.programs)
    rows = [
        [
            str(program.program),
            program.kind,
            program.status.value,
            number(program.load_factor),
            small(program.change),
            str(program.iterations),
            f"{program.seconds:.3f}",
        ]
        for program in solution.programs
    ]
    says = f"{counted(len(rows), 'cone program')}, {counted(total, 'iteration')}, {solution.seconds:.3f} s:"
    head = ["program", "for", "status", "load factor", "change", "iterations", "seconds"]
    return ["", *sentence(says), *table(head, rows, left=3)]
