"""The geometric factor of safety of a dead load, from its zero of the pressure in joints that shrink.

With every joint shrunk to s about its centroid, x = c + s (x₁ − c), the dead load is carried from some s on: what a
smaller joint carries, a larger one does. 1/s is the factor (Heyman 1966, doi:10.1016/0020-7683(66)90018-7: of an
arch the thickness over the least one). Strengths stay those of the full joint; only levers shrink.

The measure is the pressure p in all joints (``joint_pressure``), which the shrinking leaves the same as a load: the
factor is its zero. Its slope by s for fixed forces and mechanism is −f·dv/ds, where v grows linearly with s. As levers
times normal forces hold loads, p is nearly linear in the factor k = 1/s, and so it is looked for by k: a step of
Newton's method is one of Dinkelbach's (1967) for the quotient of what levers and loads do, and three or four are mostly
enough. Two more programs prove the factor: forces show that the structure stands on one side of it, a mechanism that
it falls on the other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Message
from mbla.model import Model
from mbla.model.model import LoadCase
from mbla.program.build import crushable_interfaces
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.further.geometric_safety.geometric_safety import (
    LEAST,
    MOST,
    TOLERANCE,
    GeometricSafety,
    shrunk,
    shrunk_contacts,
)
from mbla.solution.further.geometric_safety.joint_pressure import JointPressure, joint_pressure
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.further.zeros.samples import Zero
from mbla.solution.further.zeros.zeros import find_zero
from mbla.solution.solution import Mechanics
from mbla.solution.verification.geometric_safety import proved
from mbla.solution.verification.statics import contact_velocities

STEP = 1.1
"""From one factor to the next at least, until one on the other side is found"""


@dataclass(frozen=True)
class _Try:
    """The pressure at joints of 1/x of their size: a sample of ``zeros``."""

    x: float
    y: float
    slope: float
    found: JointPressure
    uncertainty: float = 0.0
    scatter: float = 0.0


def geometric_safety_of(
    assembly: Assembly, load_case: LoadCase, analysis: AnalysisSection, log: Log
) -> tuple[GeometricSafety | None, tuple[Message, ...]]:
    """The factor of the dead load of a case, verified; None without, and a remark on why there is none."""
    against = why_no_geometric_safety(assembly.model, assembly.contacts, load_case, analysis)
    found = None if against else geometric_safety(LoadedAssembly(assembly, load_case), analysis, log)
    if found is None:
        why = (
            against or "forces that carry the dead load are found at no size of the joints, or a wedge holds it at any"
        )
        return None, (no_geometric_safety(why),)
    return replace(found, verified=proved(assembly, load_case, found)), ()


def no_geometric_safety(why: str) -> Message:
    """The remark on what keeps a geometric factor of safety from being found."""
    return Message("geometric-safety-not-done", f"there is no geometric factor of safety: {why}")


def why_no_geometric_safety(model: Model, contacts: Contacts, load_case: LoadCase, analysis: AnalysisSection) -> str:
    """What keeps it from being looked for, in words; empty where nothing does."""
    if len(model.ties):
        return "there are ties, or soil that holds it sideways, which do not shrink with the joints"
    if against := load_case.question.no_safety:
        return against
    if analysis.contact_model == "convex" or crushable_interfaces(model, contacts).any():
        return "it is for joints whose points carry all, without compressive strength and contact_model: convex"
    if not np.any(load_case.dead_load[model.free]):
        return "there is no dead load"
    if not len(contacts.points):
        return "no joints carry it"
    return ""


def geometric_safety(
    structure: LoadedAssembly, analysis: AnalysisSection, log: Log | None = None
) -> GeometricSafety | None:
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


def _slope(structure: LoadedAssembly, found: JointPressure) -> float:
    """dp/ds at fixed forces and mechanism: −f·dv/ds; nan without them."""
    mechanics: Mechanics | None = found.solution.mechanics
    if mechanics is None:
        return np.nan
    model, contacts, motion = structure.model, structure.contacts, mechanics.mechanism
    whole, none = (contact_velocities(model, shrunk_contacts(contacts, size), motion) for size in (1.0, 0.0))
    return -float((mechanics.contact_forces * (whole - none)).sum())


def _result(ends: tuple[_Try, ...], solves: int) -> GeometricSafety | None:
    """From the end of the bracket that stands, and the one that falls where there is one; None without their states."""
    states = [end.found.solution.mechanics for end in ends]
    known = [state for state in states if state is not None]
    if len(known) < len(ends):
        return None
    return GeometricSafety(
        sizes=np.array([1.0 / end.x for end in ends]),
        pressed=np.array([end.found.reference_pressure for end in ends]),
        load_factors=np.array([state.load_factor for state in known]),
        forces=np.stack([state.contact_forces for state in known]),
        mechanisms=np.stack([state.mechanism for state in known]),
        solves=solves,
        verified=False,
    )
