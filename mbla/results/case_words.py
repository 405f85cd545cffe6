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

WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)
"""statuses whose load factor is a result"""
STOPPED_BY = {
    Status.ITERATION_LIMIT: "out of iterations",
    Status.TIME_LIMIT: "out of time",
    Status.NUMERICAL_ERROR: "numerical failure",
}
"""what ended a case without a result"""
PURPOSES = {
    "associative": "associative",
    "reverse": "reversed live load",
    "published": "reduced dilatancy",
    "gravity": "dead load alone",
    "proximal": "step without dilatancy",
    "exact law": "exact joint law",
}
"""what a cone program is for, in words"""


def load_factor_words(model: Model, load_case: LoadCase, load_factor: float) -> str:
    """``0.145 g`` where the live load is an acceleration, else ``0.643 times the live load``."""
    size = live_load_in_g(model, load_case)
    if size is None:
        return f"{number(load_factor)} times the live load"
    return f"{number(load_factor * size)} g"


def verdict(model: Model, case: CaseResult) -> str:
    """The outcome of a case in one line; only a solved case reads as a collapse."""
    mechanics = case.solution.mechanics
    if mechanics is None:
        return _without_load_factor(case)
    value = load_factor_words(model, case.load_case, mechanics.load_factor)
    if case.status is Status.SOLVED:
        return f"collapses at {value}, verified"
    if case.status is Status.APPROXIMATE:
        return f"collapses at about {value}, approximate"
    if case.status is Status.NOT_VERIFIED:
        return f"NOT VERIFIED: the last value, {value}, is no result"
    return f"NOT SOLVED ({_stopped(case)}): the last value, {value}, is no result"


def _without_load_factor(case: CaseResult) -> str:
    if case.status is Status.NO_EQUILIBRIUM:
        return "no equilibrium: the structure cannot carry its dead load"
    if case.status is Status.UNBOUNDED and case.solution.flow_rule == "associative":
        return "no collapse: no multiple of the live load brings the structure down"
    if case.status is Status.UNBOUNDED:
        return f"no collapse by associative flow; undecided for {case.solution.flow_rule.replace('_', '-')} flow"
    if case.status is Status.NOT_VERIFIED:
        return "NOT VERIFIED: the lack of equilibrium could not be confirmed"
    return f"NOT SOLVED ({_stopped(case)})"


def _stopped(case: CaseResult) -> str:
    return STOPPED_BY.get(case.status, case.status.value)


def bound_words(model: Model, case: CaseResult) -> str:
    """What is known although a case has no verified load factor; nothing for others.

    The kinematic bound limits the associative load factor, and that limits the load factor of any other flow rule.
    """
    if case.status is Status.SOLVED or case.solution.mechanics is None or np.isnan(case.checks.kinematic_bound):
        return ""
    value = load_factor_words(model, case.load_case, case.checks.kinematic_bound)
    return f"certain all the same: it collapses at no more than {value} (kinematic bound, valid for every flow rule)"


def reasons(case: CaseResult) -> list[str]:
    """Why a case is not plainly solved, each reason once."""
    reason = [] if case.status is Status.SOLVED or not case.solution.reason else [case.solution.reason]
    return list(dict.fromkeys([*reason, *case.checks.failures]))


def case_lines(model: Model, contacts: Contacts, case: CaseResult) -> list[str]:
    """The section of one load case."""
    lines = heading(f"Load case {case.load_case.name}")
    mechanics = case.solution.mechanics
    says = verdict(model, case)
    if mechanics is not None:
        says += f"{_mechanism_label(case)}: {mechanism_summary(model, contacts, mechanics)}"
    lines += sentence(says + ".")
    lines += [line for text in (case.solution.reason, bound_words(model, case)) for line in sentence(text)]
    if mechanics is None and case.solution.certificate is not None:
        lines += certificate_lines(model, case.solution.certificate)
    lines += ["", *figures(model, case)]
    if mechanics is not None:
        lines += ["", *mechanism_lines(model, contacts, mechanics)]
        lines += _power(model, case.load_case, mechanics)
        lines += ["", *_reactions(model, contacts, case.load_case, mechanics)]
    return lines + _programs(case.solution)


def _mechanism_label(case: CaseResult) -> str:
    return "" if case.status in WITH_VALUE else "; its mechanism, for what it is worth"


def figures(model: Model, case: CaseResult) -> list[str]:
    """Load factors by both flow rules, bounds, residuals, verdict of the verification."""
    solution, checks = case.solution, case.checks
    lines = entry("status", case.status.value)
    if solution.mechanics is not None:
        remark = "" if case.status in WITH_VALUE else "   (the last value, no result)"
        lines += entry(f"load factor, {solution.flow_rule}", number(solution.mechanics.load_factor) + remark)
    if solution.associative is not None and solution.flow_rule != "associative":
        lines += entry("load factor, associative", _beside(solution.associative, solution.mechanics))
    if not np.isnan(checks.static_bound) or not np.isnan(checks.kinematic_bound):
        lines += entry("associative, static bound", _digits(checks.static_bound))
        lines += entry("associative, kinematic bound", _digits(checks.kinematic_bound))
        lines += entry("relative gap", small(checks.gap))
    for name, value, measure in _residuals(checks):
        if not np.isnan(value):
            lines += entry(name, f"{small(value)}   {measure}")
    return lines + _verification(case)


def _digits(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.8g}"


def _beside(associative: Mechanics, own: Mechanics | None) -> str:
    text = number(associative.load_factor)
    if own is None or associative.load_factor == 0:
        return text
    difference = round(100 * (own.load_factor / associative.load_factor - 1), 2) + 0.0
    return f"{text}   (the one above differs by {difference:+.2f} %)" if difference else text


def _residuals(checks: Checks) -> tuple[tuple[str, float, str], ...]:
    """Name, value and what each residual is relative to."""
    return (
        ("equilibrium residual", checks.equilibrium_residual, "of the mean load of a block"),
        ("yield violation", checks.yield_violation, "of the mean load of a block"),
        ("penetration", checks.penetration, "of the largest contact velocity"),
        ("complementarity residual", checks.complementarity_residual, "of the power"),
        ("power balance", checks.power_balance, "of the power"),
    )


def _verification(case: CaseResult) -> list[str]:
    if case.checks.verified and case.solution.mechanics is not None:
        return entry("verification", "passed: everything recomputed from model, contacts and solution")
    if case.checks.verified:
        return entry("verification", "nothing contradicts the status")
    lines = entry("verification", "NOT PASSED")
    told = (case.solution.reason,)
    return lines + [line for text in case.checks.failures if text not in told for line in sentence(text, "    ")]


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
            PURPOSES.get(program.kind, program.kind),
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
    lines = ["", *sentence(says), *table(head, rows, left=3)]
    if any(program.kind == "reverse" for program in solution.programs):
        lines += sentence("The program with the live load reversed shows whether the dead load alone is carried.")
    return lines
