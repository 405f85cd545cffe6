"""What collapses and how: modes of interfaces, rigid parts and work of a case; and the first block to fall.

Listing, summary, JSON record, result file and pictures all show the same failure, which takes seconds to find in a
large model. Records are known by identity: their arrays cannot be hashed, and nobody changes them.

What a contact point does follows from its velocity alone. The motion is one of associative flow, so that a point that
slides lifts by the friction coefficient; only what lifts more opens. Nothing is known of the work of the joints.

The motion obeys normality, v_N ≥ μ s with the slip s: what a joint opens by more than sliding
lifts it is a gap.


How a structure fails: parts, hinge lines, sliding planes, cracks, and the class of the mechanism.

Described for the clusters of a failure (:mod:`mbla.results.collapse.collapse`), by joints whose contact speed is a
notable share of the largest:

- sliding: joints slide and none hinges;
- twisting: the same, and each of them slides by turning about its normal;
- overturning: parts turn about hinges on what is at rest, each by itself;
- hinging: parts hinge on each other, as in an arch;
- sliding and hinging: both;
- opening: joints only open, as under a block that is lifted off, or above a support that gives way and is not missed.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.model.ties.ties import FILL
from mbla.program.assemble import yield_limits
from mbla.results.collapse.clusters import clusters_of
from mbla.results.collapse.cracks import Crack, YieldLine, cracks, yield_lines
from mbla.results.collapse.interface_modes import InterfaceMotion, interface_motion, together_of
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane, cluster_joints, hinge_lines, sliding_planes
from mbla.results.collapse.mechanics import Work, work_of
from mbla.results.collapse.rigid_parts import PartMotion, part_motions, rigid_parts
from mbla.results.collapse.slip_lines import SlipLine, slip_lines
from mbla.results.collapse.ties import TieState, tie_rows
from mbla.solution.full_model.contact_modes import contact_modes
from mbla.solution.solution import Mechanics
from mbla.solution.verification.statics import contact_velocities

P = ParamSpec("P")
T = TypeVar("T")


def kept(function: Callable[P, T]) -> Callable[P, T]:
    """The same function of records and integers, by position, called once for the same ones.

    Its result must not hold any of them, or they would never be freed.
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


# --- A mechanism as it is listed -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Collapse:
    """Everything that follows from forces and velocities; result files hold it for others, mbla recomputes it.

    interfaces : what each interface does
    parts      : (n_blocks,) part of each block, 0 at rest
    motions    : of the parts that move, the heaviest first
    work       : where the power goes
    yielding   : ties that yield
    soil       : faces on which fill is at its passive and at its active limit
    """

    interfaces: InterfaceMotion
    parts: IntArray
    motions: tuple[PartMotion, ...]
    work: Work
    yielding: int = 0
    soil: tuple[int, int] = (0, 0)


@kept
def collapse_of(assembly: Assembly, load_case: LoadCase, mechanics: Mechanics) -> Collapse:
    """The mechanism of one load case."""
    model, contacts = assembly.model.of_case(load_case), assembly.contacts
    parts = rigid_parts(model, assembly.glued(load_case), mechanics.mechanism, together_of(mechanics))
    rows = tie_rows(model, mechanics)
    states, soil = [row.state for row in rows], [row.state for row in rows if row.form == FILL]
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, mechanics.mechanism),
        work=work_of(model, contacts, load_case, mechanics),
        yielding=states.count(TieState.YIELDS),
        soil=(soil.count(TieState.PASSIVE), soil.count(TieState.ACTIVE)),
    )


# --- How a structure without equilibrium falls ----------------------------------------------------------------------


def fall_of(assembly: Assembly, load_case: LoadCase, certificate: FloatArray) -> tuple[Collapse, Mechanics]:
    """The failure of a motion, (n_blocks, 6), with nan for every power, and the motion as mechanics without forces."""
    model, contacts = assembly.model.of_case(load_case), assembly.contacts
    velocities = contact_velocities(model, contacts, certificate)
    none, limits = np.zeros_like(velocities), yield_limits(model, contacts)
    dry = replace(limits, cohesion=np.zeros_like(limits.cohesion), tension=np.zeros_like(limits.tension))
    modes = contact_modes(none, velocities, dry, limits.friction)
    mechanics = Mechanics(np.nan, none, velocities, certificate, modes)
    unknown = np.full(len(contacts), np.nan)
    parts = rigid_parts(model, assembly.glued(load_case), certificate)
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, certificate),
        work=Work(np.nan, np.nan, unknown, unknown, unknown, np.nan, np.nan),
    ), mechanics


@dataclass(frozen=True)
class Failure:
    """What pictures, report and words show of a mechanism.

    clusters       : (n_blocks,) listed part of each block, 0 at rest
    motions        : of these parts, the heaviest first
    explained      : share of the motion that they reproduce, 1 where they are the rigid parts themselves
    hinge_lines    : the one that moves most first
    sliding_planes : the one that dissipates most first
    cracks         : the one that opens most first
    yield_lines    : along which parts that stand for many break off, the longest first
    slip_lines     : in soil of cells, whose joints are in none of the lines before; the one that moves most first
    """

    clusters: IntArray
    motions: tuple[PartMotion, ...]
    explained: float
    hinge_lines: tuple[HingeLine, ...]
    sliding_planes: tuple[SlidingPlane, ...]
    cracks: tuple[Crack, ...]
    yield_lines: tuple[YieldLine, ...]
    slip_lines: tuple[SlipLine, ...] = ()


@kept
def failure_of(model: Model, contacts: Contacts, collapse: Collapse, mechanics: Mechanics) -> Failure:
    """From the exact rigid parts and interfaces of a mechanism."""
    found = clusters_of(model, collapse.parts, mechanics.mechanism)
    every = cluster_joints(model, contacts, found.of_block, mechanics)
    soil = collapse.interfaces.in_soil
    joints = replace(every, between=every.between & ~soil)
    return Failure(
        clusters=found.of_block,
        motions=found.motions,
        explained=found.explained,
        hinge_lines=hinge_lines(contacts, collapse.interfaces, joints, collapse.work, found.neglected),
        sliding_planes=sliding_planes(contacts, collapse.interfaces, joints, collapse.work, found.neglected),
        cracks=cracks(contacts, collapse.interfaces, joints, mechanics),
        yield_lines=yield_lines(contacts, found.of_block, len(model.grounds)),
        slip_lines=slip_lines(model, contacts, every, soil, collapse.work),
    )


# --- A mechanism in one word, to count and colour many of them: what its joints do that moves notably ---------------


NOTABLE = 0.1
"""share of the largest contact speed, or of the power put in, from which a joint counts: a tenth is seen in a picture,
and the residuals up to which a case counts as solved are far below"""


class MechanismClass(StrEnum):
    """The words."""

    SLIDING = "sliding"
    TWISTING = "twisting"
    OVERTURNING = "overturning"
    HINGING = "hinging"
    SLIDING_AND_HINGING = "sliding and hinging"
    OPENING = "opening"


def mechanism_class(failure: Failure) -> MechanismClass:
    """The class of a mechanism."""
    lines = [line for line in failure.hinge_lines if line.share >= NOTABLE]
    planes = [plane for plane in failure.sliding_planes if plane.share >= NOTABLE]
    slips = any(line.share >= NOTABLE for line in failure.slip_lines)
    slides = bool(planes) or slips or any(_slides(line) for line in lines)
    if lines and slides:
        return MechanismClass.SLIDING_AND_HINGING
    if lines:
        on_rest = all(0 in line.clusters for line in lines)
        return MechanismClass.OVERTURNING if on_rest else MechanismClass.HINGING
    if slides:
        return (
            MechanismClass.TWISTING if not slips and all(plane.twists for plane in planes) else MechanismClass.SLIDING
        )
    return MechanismClass.OPENING


def _slides(line: HingeLine) -> bool:
    """Whether a hinge slides notably too: its shear forces take some of the power."""
    return line.slides and bool(np.nan_to_num(line.shear_power_share) >= NOTABLE)
