"""What was found for a load case as the flat content of a result file: path below the case -> array, text or number."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import collapse_of
from mbla.results.hdf5.mechanism_fields import MECHANICS_GROUPS
from mbla.results.outcome import least_and_greatest
from mbla.results.results import CaseResult
from mbla.solution.solution import Mechanics, ReductionStep, Solution, StandingResult
from mbla.solution.verification.verification import residual_of

Value: TypeAlias = "np.typing.NDArray[np.generic] | str | Sequence[str] | float | int | bool"
Content: TypeAlias = dict[str, Value]

CHECKED = (
    "equilibrium_residual",
    "yield_violation",
    "tension_violation",
    "penetration",
    "complementarity_residual",
    "slip_residual",
    "live_power",
    "power_balance",
    "static_bound",
    "kinematic_bound",
    "gap",
    "peak_load_factor",
)
"""numbers of Checks, each with a dataset of its own"""
MECHANICS_FIELDS = ("load_factor", "contact_forces", "contact_velocities", "mechanism", "modes")
PROGRAM_FIELDS = ("program", "kind", "status", "load_factor", "change", "iterations", "seconds")
SOLVER_FIELDS = ("solver", "factorization")
ITERATION_FIELDS = (
    "program",
    "iteration",
    "load_factor",
    "gap",
    "primal_residual",
    "dual_residual",
    "step",
    "seconds",
)
PATH_FIELDS = ("step", "load_factor", "open", "slide", "residual")
SIZE_FIELDS = ("dimension", "mirror_planes", "parts", "free_blocks", "contact_points", "dropped_points")
STEP_SIZES, STEP_ENDS = ("unknowns", "cones", "entries", "largest"), ("before", "after")
TEXT_COLUMNS = ("kind", "status", *SOLVER_FIELDS)


def case_content(model: Model, contacts: Contacts, case: CaseResult) -> Content:
    """Everything of one load case but its loads."""
    solution, checks, model = case.solution, case.checks, model.of_case(case.load_case)
    content: Content = {
        "status": case.status.value,
        "claimed_status": solution.status.value,
        "flow_rule": solution.flow_rule,
        "scheme": solution.scheme,
        "reason": solution.reason,
        "remarks": solution.remarks,
        "contact_model": solution.contact_model,
        "stress_blocks": solution.stress_blocks,
        "seconds": solution.seconds,
        "sides": solution.sides,
        "solver": solution.solver,
        **{name: getattr(checks, name) for name in CHECKED},
        "range": np.array([checks.lower, checks.upper]),
        "verified": checks.verified,
        "failures": checks.failures,
        **_table("path", PATH_FIELDS, solution.path, whole=("step", "open", "slide")),
        **_table("programs", (*PROGRAM_FIELDS, *SOLVER_FIELDS), solution.programs, whole=("program", "iterations")),
        **_table("iterations", ITERATION_FIELDS, solution.iterations, whole=("program", "iteration")),
    }
    settlement = case.load_case.settlement
    if settlement is not None and solution.mechanics is not None:
        content["reaction"] = settlement.reaction(solution.mechanics.load_factor)
    least, greatest = least_and_greatest(model, case)
    content |= {"least_load_factor": least, "greatest_load_factor": greatest}
    return content | _answers(model, contacts, case) | _collapse(model, contacts, case) | _further(solution)


def _answers(model: Model, contacts: Contacts, case: CaseResult) -> Content:
    """Forces and velocities of every answer there is, and how badly they fit the joint law."""
    content: Content = {}
    for group, part, _ in MECHANICS_GROUPS:
        mechanics: Mechanics | None = getattr(case.solution, part)
        if mechanics is None or (part == "associative" and associative_is_own(case)):
            continue
        content |= {group + name: getattr(mechanics, name) for name in MECHANICS_FIELDS}
        content[f"{group}residual"] = residual_of(model, contacts, case.load_case, case.solution, part)
        if mechanics.resultants is not None:
            content[f"{group}resultants"] = mechanics.resultants
        if mechanics.interface_motions is not None:
            content[f"{group}torsion_motions"] = mechanics.interface_motions[:, 0]
            content[f"{group}crushing_motions"] = mechanics.interface_motions[:, 1]
    return content


def _collapse(model: Model, contacts: Contacts, case: CaseResult) -> Content:
    """What follows from the mechanism, for readers of the file."""
    mechanics = case.solution.mechanics
    if mechanics is None:
        return {}
    collapse = collapse_of(model, contacts, case.load_case, mechanics)
    motion = collapse.interfaces
    return {
        "parts": collapse.parts,
        "interfaces/modes": motion.modes,
        "interfaces/translations": motion.translation,
        "interfaces/rotations": motion.rotation,
        "interfaces/hinge_points": motion.hinge_points,
        "interfaces/hinge_directions": motion.hinge_directions,
        "interfaces/work": collapse.work.dissipated,
    }


def associative_is_own(case: CaseResult) -> bool:
    """The associative answer is the case's own answer, so that the file need not hold it twice."""
    solution = case.solution
    return solution.flow_rule == "associative" and solution.associative is solution.mechanics


def _further(solution: Solution) -> Content:
    content: Content = {
        name: getattr(solution, name)
        for name in ("certificate", "lock", "force_ranges")
        if getattr(solution, name) is not None
    }
    if solution.level_lock is not None:
        content["level/lock"] = solution.level_lock
    if solution.certificate_motions is not None:
        content["certificate_torsion_motions"] = solution.certificate_motions[:, 0]
        content["certificate_crushing_motions"] = solution.certificate_motions[:, 1]
    if solution.spread is not None:
        content["spread"] = np.array(solution.spread, dtype=float)
    if solution.asked is not None:
        content["asked"] = solution.asked
    if solution.reductions:
        content |= _reductions(solution.reductions)
    if solution.size is not None:
        content |= {f"size/{name}": getattr(solution.size, name) for name in SIZE_FIELDS}
    return content if solution.standing is None else content | _standing(solution.standing)


def _reductions(steps: Sequence[ReductionStep]) -> Content:
    """A column for each figure of the reductions."""
    columns: Content = {
        "reductions/name": [step.name for step in steps],
        "reductions/state": [step.state.value for step in steps],
        "reductions/found": np.array([step.found for step in steps], dtype=np.int64),
    }
    for when in STEP_ENDS:
        for name in STEP_SIZES:
            values = [getattr(getattr(step, when), name) for step in steps]
            columns[f"reductions/{name}_{when}"] = np.array(values, dtype=np.int64)
    return columns


def _standing(standing: StandingResult) -> Content:
    falls = [] if standing.block is None else [standing.block]
    return {
        "standing/verdict": standing.verdict.value,
        "standing/falls": np.array(falls, dtype=np.int64),
        "standing/reason": standing.reason,
        **({} if standing.forces is None else {"standing/contact_forces": standing.forces}),
        **({} if standing.settlement is None else {"standing/settlement": standing.settlement}),
    }


def _table(group: str, fields: Sequence[str], records: Sequence[object], whole: Sequence[str]) -> Content:
    """Columns of a list of records: texts as lists, the others as arrays, of whole numbers where named."""
    columns: Content = {}
    for field in fields:
        column = [getattr(record, field) for record in records]
        if field in TEXT_COLUMNS:
            columns[f"{group}/{field}"] = [str(value) for value in column]
        else:
            columns[f"{group}/{field}"] = np.array(column, dtype=np.int64 if field in whole else np.float64)
    return columns
