"""Verification of polyhedral friction: a bracket of the true cone, and each polyhedron by its own law.

The static bound is what the forces of the inscribed polyhedron prove of the true cone, the kinematic bound what the
mechanism of the circumscribed one proves of it (``proofs``). Their distance is that of the polyhedra,
not an error: it is reported and not judged. What is judged is whether each program was solved:

- forces and mechanism of each fit its own law, by which sliding dissipates (c + μN) max g·v_T over the corners g of the
  polygon; a part in a plane has the circle, and may fit that instead;
- the forces of the inscribed polyhedron keep to the true cone, those of the circumscribed one to their polygon;
- the forces of the first prove its load factor at least, the mechanism of the second its own at most, and the bounds
  do not cross. Forces are mended within the true cone, so that they may prove a little more.

With k sides the inscribed polygon has its corners at the angles 2πi/k from the first tangent, the circumscribed one
touches the circle there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.proofs import associative_bounds
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.thresholds import GAP_TOLERANCE
from mbla.solution.verification.case import Case
from mbla.solution.verification.residuals import Residuals, residuals_of
from mbla.solution.verification.verify_points import Bounds, checks_of, residual_failures, verify_points


def verify_polyhedral(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Checks:
    """Recompute residuals and bounds of a solution with ``outer``."""
    inner, outer = solution.associative, solution.outer
    assert inner is not None
    assert outer is not None
    if solution.flow_rule != "associative":
        between = replace(inner, mechanism=outer.mechanism, contact_velocities=outer.contact_velocities)
        return verify_points(model, contacts, load_case, replace(solution, associative=between))
    case = Case(model, contacts, load_case)
    proved = associative_bounds(case, replace(inner, mechanism=outer.mechanism))
    bounds = Bounds.of(*proved, case.scale.least_factor(outer.mechanism))
    residuals = _own_residuals(case, inner, _corners(solution.sides, circumscribed=False))
    circumscribed = _of_the_circumscribed(case, outer, solution.sides)
    failures = residual_failures(residuals, "associative")
    failures += residual_failures(circumscribed, "associative", "circumscribed polyhedron: ")
    failures += _bound_failures(inner, outer, bounds)
    return checks_of(residuals, bounds, tuple(failures))


def _corners(sides: int, circumscribed: bool) -> FloatArray:
    """Corners of the friction polygon of a unit circle in the joint's tangents, (sides, 2)."""
    half = np.pi / sides
    angles = 2.0 * half * np.arange(sides) + (half if circumscribed else 0.0)
    return np.column_stack([np.cos(angles), np.sin(angles)]) / (np.cos(half) if circumscribed else 1.0)


def _own_residuals(case: Case, mechanics: Mechanics, polygon: FloatArray) -> Residuals:
    """Residuals by the law of the polygon, or by that of the circle where they are less."""
    friction = case.limits.friction
    by_polygon = residuals_of(case, mechanics, friction, polygon)
    by_circle = residuals_of(case, mechanics, friction)
    return min(by_polygon, by_circle, key=lambda residuals: residuals.complementarity)


def _of_the_circumscribed(case: Case, outer: Mechanics, sides: int) -> Residuals:
    """The same with the excess of shear over the circumscribed polygon in place of that over the circle.

    Its sides touch the circle at the corners e of the inscribed one: −T·e ≤ c + μN for each of them.
    """
    forces, residuals = outer.contact_forces, _own_residuals(case, outer, _corners(sides, circumscribed=True))
    shear = np.maximum((-forces[:, 1:] @ _corners(sides, circumscribed=False).T).max(axis=1), 0.0)
    excess = yield_violation(np.column_stack([forces[:, 0], shear]), case.limits)
    size = case.scale.point_scale(case.contacts, forces)
    return replace(residuals, yielding=float((excess / size).max(initial=0.0)))


def _bound_failures(inner: Mechanics, outer: Mechanics, bounds: Bounds) -> list[Message]:
    room = GAP_TOLERANCE * bounds.size
    failures = []
    if not bounds.static >= inner.load_factor - room:
        failures.append(
            f"the load factor {inner.load_factor:.8g} of the inscribed polyhedron is more than its forces prove, "
            f"{bounds.static:.8g}"
        )
    if not bounds.kinematic <= outer.load_factor + room:
        failures.append(
            f"the load factor {outer.load_factor:.8g} of the circumscribed polyhedron is less than its mechanism "
            f"proves, {bounds.kinematic:.8g}"
        )
    if not bounds.static <= bounds.kinematic + room:
        failures.append(f"the static bound {bounds.static:.8g} lies above the kinematic bound {bounds.kinematic:.8g}")
    return [Message("bracket-not-proved", words) for words in failures]
