"""Friction cones replaced by polyhedra: linear programs that bracket the load factor of the true cone.

The polygon of ``sides`` corners in the friction circle allows less shear than the circle, the one about it allows
more. Forces within the inscribed polyhedron are within the cone: its load factor is a static bound. A mechanism
compatible with the circumscribed one is compatible with the cone: its load factor is a kinematic bound::

    λ(inscribed) ≤ λ ≤ λ(circumscribed)

Each polygon is within 1 − cos(π/k) of the circle: 7.6 % of the friction for 8 sides, 1.9 % for 16, 0.48 % for 32. Both
are exact where the inscribed one has corners, the first of them on the first tangent of each joint; structures whose
joints slide along their tangents, or do not slide at all, leave no gap. Programs in a plane have two directions of
shear and no approximation.

Each of the two is solved by the other solver too. Load factors that two libraries find for one program must agree to
1e-6; verdicts without a load factor come with a certificate that is verified instead.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.kinematic import friction_polygon
from mbla.program.program import Program
from mbla.solution.associative.associative_form import FORMS, AssociativeForm
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.choice import cone_solver, other_solver
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

AGREE = 1e-6
"""Relative difference of two solvers on one program that is within their tolerances."""

AGREE_SHORT = 1e-4
"""The same where the second one ended short of its tolerance."""

SMALL_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""

WRITTEN = {"highs": "HiGHS"}
"""How a solver writes its name, where that is not its key."""

DECIDED = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)


@dataclass(frozen=True)
class SecondOpinion:
    """What another solver says of a program.

    agrees : None where it came to no answer
    remark : both figures in one sentence
    """

    agrees: bool | None
    remark: Message
    record: ProgramRecord


@dataclass(frozen=True)
class PolyhedralResult:
    """Answers with the inscribed and the circumscribed polyhedron, the same in a planar program.

    inner    : the claim: its state where both have one, no equilibrium where even the circumscribed polyhedron has
               none, unbounded where even the inscribed one is
    remarks  : bracket and second opinions, one sentence each
    programs : all that were solved
    """

    inner: AssociativeResult
    outer: AssociativeResult
    remarks: tuple[Message, ...]
    programs: tuple[ProgramRecord, ...]


def solve_polyhedral(
    program: Program, sides: int, form: str, settings: SolverSettings, log: Log, *, first: int = 1
) -> PolyhedralResult:
    """Both polyhedra, each with a second opinion.

    sides : of the friction polygon
    form  : kinematic or static
    first : number of the first program in the sequence of the load case
    """
    if program.components == 2:
        alone, remark = solve_with_opinion(program, None, form, "", settings, log, first)
        return PolyhedralResult(alone, alone, _texts(remark), alone.programs)
    polygons = (friction_polygon(sides, circumscribed=False), friction_polygon(sides, circumscribed=True))
    inner, inner_remark = solve_with_opinion(program, polygons[0], form, "inscribed", settings, log, first)
    second = first + len(inner.programs)
    outer, outer_remark = solve_with_opinion(program, polygons[1], form, "circumscribed", settings, log, second)
    bracket = None if inner.state is None or outer.state is None else _bracket(program, sides, inner.state, outer.state)
    remarks = _texts(bracket, inner_remark, outer_remark)
    return PolyhedralResult(_claim(sides, inner, outer), outer, remarks, inner.programs + outer.programs)


def solve_with_opinion(
    program: Program,
    facets: FloatArray | None,
    form: str,
    kind: str,
    settings: SolverSettings,
    log: Log,
    first: int = 1,
) -> tuple[AssociativeResult, Message | None]:
    """The associative program, and a remark on what the other solver says of it.

    facets : directions that bound shear instead of cones
    kind   : which polyhedron they are, for the remark; may be empty

    A status that the other solver does not confirm is lowered.
    """
    settings = replace(settings, gap=min(settings.gap, AGREE))  # what is rougher could not agree
    made = FORMS[form](program, facets)
    result = solve_associative(program, settings, log, form=made, first=first)
    if result.state is None:
        return result, None
    number = first + len(result.programs)
    opinion = second_opinion(made, result.state.load_factor, result.solver, kind, settings, log, number)
    result = replace(result, programs=(*result.programs, opinion.record))
    if opinion.agrees is False:
        result = replace(result, status=Status.NOT_VERIFIED, reason=opinion.remark, apart="")
    elif opinion.agrees is None:
        reason = result.reason if result.status is not Status.SOLVED else opinion.remark
        result = replace(result, status=Status.APPROXIMATE, reason=reason, apart="")
    return result, opinion.remark


def second_opinion(
    form: AssociativeForm, load_factor: float, by: str, kind: str, settings: SolverSettings, log: Log, number: int
) -> SecondOpinion:
    """Solve a program by another solver and compare.

    load_factor : non-dimensional
    by          : the solver that it comes from
    kind        : which program it is, for the remark; may be empty
    number      : in the sequence of the load case
    """
    live, other = form.program.scaling.live, other_solver(by, form.cone_program)
    settings = replace(settings, solver=other, tolerance=form.tolerance(settings.tolerance))
    solution = form.read(cone_solver(form.cone_program, settings, log).solve(number, form.sign * live))
    has_value = solution.status in (Status.SOLVED, Status.APPROXIMATE)
    value = solution.objective if has_value else np.nan
    size = max(abs(load_factor), SMALL_FACTOR * form.program.dead_over_live)
    apart = abs(value - load_factor) / (
        size if size > 0 else 1.0
    )  # guides may take all dead load: units of the program
    within = AGREE if solution.status is Status.SOLVED else AGREE_SHORT
    agrees = bool(apart <= within) if has_value else None
    record = solution.record(number, "second opinion", value * live, apart)
    which = f"{kind} polyhedron: " if kind else ""
    first = f"{which}{WRITTEN.get(by, by)} gives a load factor of {load_factor * live:.9g}, "
    if not has_value:
        none = Message("second-opinion-missing", f"{first}{solution.solver} came to no answer ({solution.verdict})")
        return SecondOpinion(None, none, record)
    verdict = "they agree" if agrees else f"they differ by {apart:.1g} and should by {within:g} at most"
    remark = Message(
        "second-opinion-agrees" if agrees else "second-opinion-differs",
        f"{first}{solution.solver} {value * live:.9g}: {verdict}",
    )
    return SecondOpinion(agrees, remark, record)


def _claim(sides: int, inner: AssociativeResult, outer: AssociativeResult) -> AssociativeResult:
    """The inner result with what both together say of the true cone."""
    if inner.state is not None and outer.state is not None:
        worse = outer if inner.status is Status.SOLVED else inner
        return replace(inner, status=worse.status, reason=worse.reason, apart=worse.apart)
    if inner.status is Status.UNBOUNDED:
        return inner
    if outer.status is Status.NO_EQUILIBRIUM:
        return outer
    undecided = [result for result in (inner, outer) if result.status not in DECIDED and result.state is None]
    if undecided:
        return replace(undecided[0], state=None)
    if inner.status is Status.NO_EQUILIBRIUM:
        reason = (
            f"whether the dead load alone is carried is not decided: with {sides} sides it is by the circumscribed "
            "friction polyhedron, not by the inscribed one; raise analysis.sides"
        )
        return replace(inner, status=Status.NOT_VERIFIED, certificate=None, reason=reason)  # none for the true cone
    reason = (
        f"whether there is a load factor is not decided: with {sides} sides the inscribed friction polyhedron has one, "
        "the circumscribed one locks; raise analysis.sides"
    )
    return replace(inner, status=Status.NOT_VERIFIED, state=None, reason=reason)


def _bracket(program: Program, sides: int, inner: LawState, outer: LawState) -> Message:
    least, greatest = (program.scaling.load_factor(state.load_factor) for state in (inner, outer))
    width = (outer.load_factor - inner.load_factor) / max(abs(outer.load_factor), SMALL_FACTOR * program.dead_over_live)
    return Message(
        "polyhedral-bracket",
        f"with friction polyhedra of {sides} sides the load factor of the true cone lies between {least:.6g} "
        f"(inscribed, the figure reported) and {greatest:.6g} (circumscribed), {100 * max(width, 0.0):.2g} % apart; "
        "more sides narrow it",
    )


def _texts(*texts: Message | None) -> tuple[Message, ...]:
    return tuple(text for text in texts if text)
