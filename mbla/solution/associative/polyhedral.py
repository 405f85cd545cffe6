"""Friction cones replaced by polyhedra: linear programs that bracket the load factor of the true cone.

The polygon of ``sides`` corners in the friction circle allows less shear than the circle, the one about it allows
more. Forces within the inscribed polyhedron are within the cone: its load factor is a static bound. A mechanism
compatible with the circumscribed one is compatible with the cone: its load factor is a kinematic bound::

    λ(inscribed) ≤ λ ≤ λ(circumscribed)

Each polygon is within 1 − cos(π/k) of the circle: 7.6 % of the friction for 8 sides, 1.9 % for 16, 0.48 % for 32. Both
are exact where the inscribed one has corners, the first of them on the first tangent of each joint; structures whose
joints slide along their tangents, or do not slide at all, leave no gap. Programs in a plane have two directions of
shear and no approximation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.errors import Message
from mbla.program.kinematic import friction_polygon
from mbla.program.program import Program
from mbla.solution.associative.bounds import ZERO_FACTOR
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

DECIDED = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)


@dataclass(frozen=True)
class PolyhedralResult:
    """Answers with the inscribed and the circumscribed polyhedron.

    inner    : the claim: its state where both have one, no equilibrium where even the circumscribed polyhedron has
               none, unbounded where even the inscribed one is
    bracket  : both load factors in one sentence, None where there are not two
    programs : all that were solved
    """

    inner: AssociativeResult
    outer: AssociativeResult
    bracket: Message | None
    programs: tuple[ProgramRecord, ...]


def solve_polyhedral(
    program: Program, sides: int, settings: SolverSettings, log: Log, *, first: int = 1
) -> PolyhedralResult:
    """Both polyhedra of a spatial program.

    sides : of the friction polygon
    first : number of the first program in the sequence of the load case
    """
    polygons = (friction_polygon(sides, circumscribed=False), friction_polygon(sides, circumscribed=True))
    inner = solve_associative(program, settings, log, facets=polygons[0], first=first)
    second = first + len(inner.programs)
    outer = solve_associative(program, settings, log, facets=polygons[1], first=second)
    bracket = None if inner.state is None or outer.state is None else _bracket(program, sides, inner.state, outer.state)
    return PolyhedralResult(_claim(sides, inner, outer), outer, bracket, inner.programs + outer.programs)


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
    width = (outer.load_factor - inner.load_factor) / max(abs(outer.load_factor), ZERO_FACTOR * program.dead_over_live)
    return Message(
        "polyhedral-bracket",
        f"with friction polyhedra of {sides} sides the load factor of the true cone lies between {least:.6g} "
        f"(inscribed, the figure reported) and {greatest:.6g} (circumscribed), {100 * max(width, 0.0):.2g} % apart; "
        "more sides narrow it",
    )
