"""The geometric factor of safety: by how much every joint may shrink about its middle before the dead load falls.

With every joint shrunk to s about its centroid, x = c + s (x₁ − c), the dead load is carried from some s on: what a
smaller joint carries, a larger one does. 1/s is the factor (Heyman 1966, doi:10.1016/0020-7683(66)90018-7: of an
arch the thickness over the least one). Strengths stay those of the full joint; only levers shrink.

The measure is the pressure p(s) in all joints (``joint_pressure``), which the shrinking leaves the same as a load: the
least s is its zero. Its slope for fixed forces and mechanism is −f·dv/ds, where v grows linearly with s, so that a step
of Newton's method is one of Dinkelbach's (1967) for the quotient of what levers and loads do: four to six programs.
Forces at the upper end of the bracket prove that it stands, a mechanism at the lower end that it does not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import solids_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.model import Model
from mbla.model.model import LoadCase
from mbla.program.build import crushable_interfaces
from mbla.solution.associative.proofs import associative_bounds
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.limits.joint_pressure import JointPressure, joint_pressure, pressed_by, unit_of_pressure
from mbla.solution.limits.zeros import Zero, find_zero
from mbla.solution.sensitivity.structures import Structure
from mbla.solution.solution import GeometricSafety, Mechanics, Solution
from mbla.solution.verification.case import Case
from mbla.solution.verification.statics import contact_velocities

LEAST, MOST = 1e-3, 16.0
"""Size of joints, over their own, below which nothing is looked for, and above: factors of 1000 and 1/16"""
TOLERANCE = 1e-6
"""of s, relative; the bracket is twice that wide"""
FIRST = 0.9
"""size that is tried after 1, at most, where it stands"""


@dataclass(frozen=True)
class _Try:
    """The pressure at one size of joints: a sample of ``zeros``."""

    x: float
    y: float
    slope: float
    found: JointPressure


def shrunk(contacts: Contacts, size: float) -> Contacts:
    """The contacts with every point moved towards the centroid of its interface; areas stay."""
    middle = contacts.centroids[contacts.interface_of_point]
    return replace(contacts, points=middle + size * (contacts.points - middle))


def with_geometric_safety(
    model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution, analysis: AnalysisSection, log: Log
) -> Solution:
    """The solution with the factor of its dead load, verified, or with a remark on why there is none.

    model : as it may move under the load case
    """
    against = _against(model, contacts, load_case, analysis)
    found = None if against else geometric_safety(Structure(model, contacts, load_case), analysis, log)
    if found is None:
        words = f"there is no geometric factor of safety: {against or 'no size of the joints was found to be enough'}"
        return replace(solution, remarks=(*solution.remarks, Message("geometric-safety-not-done", words)))
    verified = proved(model, contacts, load_case, found)
    return replace(solution, geometric_safety=replace(found, verified=verified))


def _against(model: Model, contacts: Contacts, load_case: LoadCase, analysis: AnalysisSection) -> str:
    if load_case.settlement is not None:
        return "a support gives way"
    if analysis.contact_model == "convex" or crushable_interfaces(model, contacts).any():
        return "it is for joints whose points carry all, without compressive strength and contact_model: convex"
    if not np.any(load_case.dead_load[model.free]):
        return "there is no dead load"
    return ""


def geometric_safety(structure: Structure, analysis: AnalysisSection, log: Log | None = None) -> GeometricSafety | None:
    """The least size of all joints at which the dead load is carried; None where none up to ``MOST`` is enough."""
    solves = 0

    def at(size: float) -> _Try:
        nonlocal solves
        found = joint_pressure(replace(structure, contacts=shrunk(structure.contacts, size)), analysis, log)
        solves += found.solves
        return _Try(size, found.value, _slope(structure, found), found)

    here = at(1.0)
    other = here
    while (other.y < 0.0) == (here.y < 0.0):
        if np.isnan(other.y) or (other.x <= LEAST and here.y >= 0.0) or other.x >= MOST:
            break
        nearest, other = other, at(_further(other))
        here = nearest
    if np.isnan(other.y) or np.isnan(here.y):
        return None
    if (other.y < 0.0) == (here.y < 0.0):
        return None if other.y < 0.0 else _result((other,), solves)
    zero = find_zero(here, other, at, TOLERANCE * min(1.0, other.x, here.x))
    below, above = _both_proved(zero, at)
    return _result((above, below), solves)


def _both_proved(zero: Zero[_Try], at: Callable[[float], _Try]) -> tuple[_Try, _Try]:
    """Samples as near to the zero as their bounds tell that one falls and the other stands."""
    (below, above), root = zero.bracket, zero.best
    slope = root.slope if root.slope > 0.0 else np.inf
    least, most = root.found.bounds
    zero_at = root.x - root.y / slope if np.isfinite(root.y) else root.x
    room = TOLERANCE * root.x + 3.0 * abs(most - least) / slope
    if below.found.bounds[1] >= 0.0 or zero_at - below.x > 2.0 * room:
        tried = at(zero_at - room)
        below = tried if tried.y < 0.0 else below
    if above.found.bounds[0] < 0.0 or above.x - zero_at > 2.0 * room:
        tried = at(zero_at + room)
        above = tried if tried.y >= 0.0 else above
    return below, above


def _further(last: _Try) -> float:
    """Where to look after a size that is on the same side as 1: a little beyond the zero of the tangent."""
    step = last.x - last.y / last.slope if last.slope > 0.0 and np.isfinite(last.y) else np.nan
    if last.y < 0.0:
        return float(np.clip(2.0 * last.x if np.isnan(step) else 1.01 * step, 1.1 * last.x, 4.0 * last.x))
    return float(np.clip(LEAST if np.isnan(step) else 0.99 * step, LEAST, FIRST * last.x))


def _slope(structure: Structure, found: JointPressure) -> float:
    """dp/ds at fixed forces and mechanism: −f·dv/ds; nan without them."""
    mechanics: Mechanics | None = found.solution.mechanics
    if mechanics is None:
        return np.nan
    whole, none = (
        contact_velocities(structure.model, shrunk(structure.contacts, size), mechanics.mechanism)
        for size in (1.0, 0.0)
    )
    return -float((mechanics.contact_forces * (whole - none)).sum())


def _result(ends: tuple[_Try, ...], solves: int) -> GeometricSafety | None:
    """From the end of the bracket that stands, and the one that falls where there is one; None without their states."""
    states = [end.found.solution.mechanics for end in ends]
    known = [state for state in states if state is not None]
    if len(known) < len(ends):
        return None
    return GeometricSafety(
        sizes=np.array([end.x for end in ends]),
        pressed=np.array([end.found.pressed for end in ends]),
        load_factors=np.array([state.load_factor for state in known]),
        forces=np.stack([state.contact_forces for state in known]),
        mechanisms=np.stack([state.mechanism for state in known]),
        solves=solves,
        verified=False,
    )


def proved(model: Model, contacts: Contacts, load_case: LoadCase, safety: GeometricSafety) -> bool:
    """Whether forces and mechanisms prove that the dead load stands at one end and falls at the other."""
    bounds = []
    for row, size in enumerate(safety.sizes):
        whole = Structure(model, shrunk(contacts, float(size)), load_case)
        posed = pressed_by(whole, float(safety.pressed[row]), unit_of_pressure(whole))
        solids = solids_of(posed.model, posed.contacts)
        state = Mechanics(
            load_factor=float(safety.load_factors[row]),
            contact_forces=safety.forces[row],
            contact_velocities=np.zeros_like(safety.forces[row]),
            mechanism=solids.solid_motions(safety.mechanisms[row]),
            modes=np.zeros(len(contacts.points), dtype=np.int64),
        )
        case = Case(solids.model, solids.contacts, solids.load_case(posed.load_case))
        bounds.append(associative_bounds(case, state))
    stands = bounds[0][0] >= safety.pressed[0]
    return bool(stands and (len(bounds) == 1 or bounds[1][1] < safety.pressed[1]))
