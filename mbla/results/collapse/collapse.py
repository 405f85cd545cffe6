"""What collapses and how: modes of interfaces, rigid parts and work of a case; and the first block to fall.

Listing, summary, JSON record, result file and pictures all tell the same failure, which takes seconds to find in a
large model. Records are known by identity: their arrays cannot be hashed, and nobody changes them.

What a contact point does follows from its velocity alone. The motion is one of associative flow, so that a point that
slides lifts by the friction coefficient; only what lifts more opens. Nothing is known of the work of the joints.

The motion obeys normality, v_N ≥ μ s with the slip s: what a joint opens by more than sliding
lifts it is a gap.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.results.collapse.interface_modes import TOGETHER, InterfaceMotion, interface_motion
from mbla.results.collapse.mechanics import Work, work_of
from mbla.results.collapse.rigid_parts import PartMotion, part_motions, rigid_parts
from mbla.solution.mechanics import contact_modes
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities

P = ParamSpec("P")
T = TypeVar("T")


def kept(function: Callable[P, T]) -> Callable[P, T]:
    """The same function of records and whole numbers, by position, called once for the same ones.

    Its result must not hold any of them, or they would live for ever.
    """
    known: dict[tuple[object, ...], T] = {}

    @wraps(function)
    def once(*args: P.args, **kwargs: P.kwargs) -> T:
        if kwargs:
            return function(*args, **kwargs)
        key = tuple(record if isinstance(record, int) else id(record) for record in args)
        if key not in known:
            known[key] = function(*args, **kwargs)
            for record in args:
                if not isinstance(record, int):  # another may get the same identity later
                    weakref.finalize(record, known.pop, key, None).atexit = False
        return known[key]

    return once


# --- A mechanism as it is told --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Collapse:
    """Everything that follows from forces and velocities; result files hold it for others, mbla finds it anew.

    interfaces : what each interface does
    parts      : (n_blocks,) part of each block, 0 at rest
    motions    : of the parts that move, the heaviest first
    work       : where the power goes
    """

    interfaces: InterfaceMotion
    parts: IntArray
    motions: tuple[PartMotion, ...]
    work: Work


@kept
def collapse_of(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> Collapse:
    """The mechanism of one load case."""
    parts = rigid_parts(model, contacts, mechanics.mechanism)
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, mechanics.mechanism),
        work=work_of(model, contacts, load_case, mechanics),
    )


# --- How a structure without equilibrium falls ----------------------------------------------------------------------


def fall_of(model: Model, contacts: Contacts, certificate: FloatArray) -> tuple[Collapse, Mechanics]:
    """The failure of a motion, (n_blocks, 6), with nan for every power, and the motion as mechanics without forces."""
    velocities = contact_velocities(model, contacts, certificate)
    none, limits = np.zeros_like(velocities), yield_limits(model, contacts)
    dry = replace(limits, cohesion=np.zeros_like(limits.cohesion), tension=np.zeros_like(limits.tension))
    modes = contact_modes(none, velocities, dry, limits.friction)
    mechanics = Mechanics(np.nan, none, velocities, certificate, modes)
    unknown = np.full(len(contacts), np.nan)
    parts = rigid_parts(model, contacts, certificate)
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, certificate),
        work=Work(np.nan, np.nan, unknown, unknown, unknown, np.nan),
    ), mechanics


# --- What interfaces do in the motion that shows a lack of equilibrium ----------------------------------------------


def falling_motion(model: Model, contacts: Contacts, certificate: FloatArray) -> InterfaceMotion:
    """Modes, relative motion and hinge axes of every interface from a motion of the blocks, (n_blocks, 6)."""
    velocities = contact_velocities(model, contacts, certificate)
    limit = TOGETHER * float(np.linalg.norm(velocities, axis=1).max(initial=0.0))
    slip = np.hypot(velocities[:, 1], velocities[:, 2])
    friction = np.array([model.joints[name].friction for name in contacts.joint_names], dtype=float)
    lift = friction[contacts.joints[contacts.interface_of_point]] * slip
    modes = np.full(len(velocities), ContactMode.STICK, dtype=np.int64)
    modes[slip > limit] = ContactMode.SLIDE
    modes[velocities[:, 0] - lift > limit] = ContactMode.OPEN
    return interface_motion(
        model, contacts, Mechanics(float("nan"), np.zeros_like(velocities), velocities, certificate, modes)
    )
