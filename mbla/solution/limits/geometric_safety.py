"""The geometric factor of safety: by how much every joint may shrink about its middle before the dead load falls.

With every joint shrunk to s about its centroid, x = c + s (x₁ − c), the dead load is carried from some s on: what a
smaller joint carries, a larger one does. 1/s is the factor (Heyman 1966, doi:10.1016/0020-7683(66)90018-7: of an
arch the thickness over the least one). Strengths stay those of the full joint; only levers shrink.

The measure is the pressure p in all joints (``joint_pressure``), which the shrinking leaves the same as a load: the
factor is its zero. Its slope by s for fixed forces and mechanism is −f·dv/ds, where v grows linearly with s. As levers
times normal forces hold loads, p is nearly linear in the factor k = 1/s, and so it is looked for by k: a step of
Newton's method is one of Dinkelbach's (1967) for the quotient of what levers and loads do, and three or four are mostly
enough. Two more programs prove it: forces on one side that it stands, a mechanism on the other that it does not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_bodies
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.model import Model
from mbla.model.model import LoadCase
from mbla.program.build import crushable_interfaces
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.limits.joint_pressure import JointPressure, joint_pressure, pressed_by, unit_of_pressure
from mbla.solution.limits.samples import Zero
from mbla.solution.limits.zeros import find_zero
from mbla.solution.sensitivity.structures import Structure
from mbla.solution.solution import GeometricSafety, Mechanics, Solution
from mbla.solution.verification.case import Case
from mbla.solution.verification.proofs import associative_bounds
from mbla.solution.verification.statics import contact_velocities

LEAST, MOST = 1.0 / 16.0, 1000.0
"""Factors between which it is looked for"""
TOLERANCE = 1e-6
"""of the factor, relative; it is proved to lie between two that are twice that apart"""
APART = 1e-4
"""of the factor, relative: two further apart prove none; 2e-6 is usual, accuracy draft leaves up to 5e-5"""
STEP = 1.1
"""From one factor to the next at least, until one on the other side is found"""


@dataclass(frozen=True)
class _Try:
    """The pressure at joints of 1/x of their size: a sample of ``zeros``."""

    x: float
    y: float
    slope: float
    found: JointPressure
    known: float = 0.0


def shrunk(assembly: Assembly, size: float) -> Assembly:
    """The assembly with joints of a size."""
    return replace(assembly, contacts=_shrunk(assembly.contacts, size))


def _shrunk(contacts: Contacts, size: float) -> Contacts:
    """The contacts with every point moved towards the centroid of its interface; areas stay."""
    middle = contacts.centroids[contacts.interface_of_point]
    return replace(contacts, points=middle + size * (contacts.points - middle))


def with_geometric_safety(
    assembly: Assembly, load_case: LoadCase, solution: Solution, analysis: AnalysisSection, log: Log
) -> Solution:
    """The solution with the factor of its dead load, verified, or with a remark on why there is none."""
    against = why_no_geometric_safety(assembly.model, assembly.contacts, load_case, analysis)
    found = None if against else geometric_safety(Structure(assembly, load_case), analysis, log)
    if found is None:
        why = (
            against or "forces that carry the dead load are found at no size of the joints, or a wedge holds it at any"
        )
        return replace(solution, remarks=(*solution.remarks, no_geometric_safety(why)))
    verified = proved(assembly, load_case, found)
    return replace(solution, geometric_safety=replace(found, verified=verified))


def no_geometric_safety(why: str) -> Message:
    """The remark on what keeps a geometric factor of safety from being found."""
    return Message("geometric-safety-not-done", f"there is no geometric factor of safety: {why}")


def why_no_geometric_safety(model: Model, contacts: Contacts, load_case: LoadCase, analysis: AnalysisSection) -> str:
    """What keeps it from being looked for, in words; empty where nothing does."""
    if len(model.ties):
        return "there are ties, or soil that holds it sideways, which do not shrink with the joints"
    if load_case.settlement is not None:
        return "a support gives way"
    if analysis.contact_model == "convex" or crushable_interfaces(model, contacts).any():
        return "it is for joints whose points carry all, without compressive strength and contact_model: convex"
    if not np.any(load_case.dead_load[model.free]):
        return "there is no dead load"
    return ""


def geometric_safety(structure: Structure, analysis: AnalysisSection, log: Log | None = None) -> GeometricSafety | None:
    """The factor by which joints may shrink while the dead load is carried; None where none just carries it."""
    solves = 0

    def at(factor: float) -> _Try:
        nonlocal solves
        found = joint_pressure(replace(structure, assembly=shrunk(structure.assembly, 1.0 / factor)), analysis, log)
        solves += found.solves
        return _Try(factor, found.value, _slope(structure, found) / -(factor**2), found)

    before = last = at(1.0)
    while (last.y < 0.0) == (before.y < 0.0) and LEAST < last.x < MOST and not np.isnan(last.y):
        before, last = last, at(_further(last))
    if np.isnan(last.y) or (last.y < 0.0 and before.y < 0.0):
        return None
    if before.y >= 0.0 and last.y >= 0.0:
        return _result((last,), solves)
    zero = find_zero(before, last, at, TOLERANCE * min(before.x, last.x))
    return _result(_proved(zero, at), solves)


def _proved(zero: Zero[_Try], at: Callable[[float], _Try]) -> tuple[_Try, _Try]:
    """Samples that stand and fall, as near to the zero as their bounds tell them apart."""
    (falls, stands), root = zero.bracket, zero.best
    least, most = root.found.bounds
    slope = abs(root.slope) if abs(root.slope) > 0.0 else np.inf
    middle = root.x + root.y / slope if np.isfinite(root.y) else root.x
    room = TOLERANCE * root.x + 3.0 * abs(most - least) / slope
    if stands.found.bounds[0] < 0.0 or middle - stands.x > 2.0 * room:
        tried = at(middle - room)
        stands = tried if tried.y >= 0.0 else stands
    if falls.found.bounds[1] >= 0.0 or falls.x - middle > 2.0 * room:
        tried = at(middle + room)
        falls = tried if tried.y < 0.0 else falls
    return stands, falls


def _further(last: _Try) -> float:
    """Where to look after a factor on the same side as 1: a little beyond the zero of the tangent."""
    known = last.slope < 0.0 and np.isfinite(last.y)
    if last.y < 0.0:
        step = 0.99 * (last.x - last.y / last.slope) if known else 0.5 * last.x
        return float(np.clip(step, max(LEAST, 0.25 * last.x), last.x / STEP))
    return float(np.clip(1.01 * (last.x - last.y / last.slope) if known else MOST, STEP * last.x, MOST))


def _slope(structure: Structure, found: JointPressure) -> float:
    """dp/ds at fixed forces and mechanism: −f·dv/ds; nan without them."""
    mechanics: Mechanics | None = found.solution.mechanics
    if mechanics is None:
        return np.nan
    model, contacts, motion = structure.model, structure.contacts, mechanics.mechanism
    whole, none = (contact_velocities(model, _shrunk(contacts, size), motion) for size in (1.0, 0.0))
    return -float((mechanics.contact_forces * (whole - none)).sum())


def _result(ends: tuple[_Try, ...], solves: int) -> GeometricSafety | None:
    """From the end of the bracket that stands, and the one that falls where there is one; None without their states."""
    states = [end.found.solution.mechanics for end in ends]
    known = [state for state in states if state is not None]
    if len(known) < len(ends):
        return None
    return GeometricSafety(
        sizes=np.array([1.0 / end.x for end in ends]),
        pressed=np.array([end.found.pressed for end in ends]),
        load_factors=np.array([state.load_factor for state in known]),
        forces=np.stack([state.contact_forces for state in known]),
        mechanisms=np.stack([state.mechanism for state in known]),
        solves=solves,
        verified=False,
    )


def proved(assembly: Assembly, load_case: LoadCase, safety: GeometricSafety) -> bool:
    """Whether forces and mechanisms prove that the dead load stands at one end and falls at the other, next to it.

    The load factors are to be those of the forces and mechanisms too; without an end that falls, the one that stands is
    the least size that is looked for.
    """
    next_to_it = safety.most <= (1.0 + APART) * safety.factor
    if not (next_to_it or (len(safety.sizes) == 1 and safety.factor >= (1.0 - TOLERANCE) * MOST)):
        return False
    bounds = []
    for row, size in enumerate(safety.sizes):
        whole = Structure(shrunk(assembly, float(size)), load_case)
        posed = pressed_by(whole, float(safety.pressed[row]), unit_of_pressure(whole))
        bodies = posed.assembly.glued(load_case)
        state = Mechanics(
            load_factor=float(safety.load_factors[row]),
            contact_forces=safety.forces[row],
            contact_velocities=np.zeros_like(safety.forces[row]),
            mechanism=motions_of_bodies(bodies, safety.mechanisms[row]),
            modes=np.zeros(len(assembly.contacts.points), dtype=np.int64),
        )
        case = Case(bodies.model, bodies.contacts, bodies.load_case(posed.load_case))
        bounds.append(associative_bounds(case, state))
    for own, (least, most) in zip(safety.load_factors, bounds, strict=True):
        room = TOLERANCE * abs(own)
        if not np.isfinite(own) or own < least - room or own > most + room:
            return False
    stands = bounds[0][0] >= safety.pressed[0]
    return bool(stands and (len(bounds) == 1 or bounds[1][1] < safety.pressed[1]))
