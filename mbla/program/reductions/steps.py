"""What each reduction did for one load case: its name, what it found, and the size of the programs before and after.

Reductions are counted in the order in which they are applied, each on the programs that the reduction before it made.
Only programs with a live load are counted: the others only have to show that the dead load is carried.

Glue comes first: blocks that are one rigid body have the unknowns of one (:mod:`mbla.assembly.rigid_bodies`). It cannot
be switched off. A glued joint has no law and no strength, and equilibrium does not determine its forces: without
merging these forces would be undetermined unknowns. Joints with finite strengths high enough give the same load factor,
which the tests show.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np

from mbla.assembly.rigid_bodies import RigidBodies
from mbla.deck.sections.analysis import AnalysisSection

if TYPE_CHECKING:
    from mbla.program.program import Program


class ReductionOutcome(StrEnum):
    """Outcome of a reduction: applied; nothing found; switched off; on, but it would change what is asked for."""

    APPLIED = "applied"
    NONE = "nothing found"
    OFF = "switched off"
    BARRED = "would change the answer"


@dataclass(frozen=True)
class ModelSize:
    """What reached the solver.

    dimension     : 2 where the structure was solved as planar, else 3
    mirror_planes : planes of symmetry that were used besides, largest number of any part
    parts         : parts that cannot interact, solved apart
    free_blocks   : blocks with unknowns
    contact_points: points with unknowns
    dropped_points: points of the model that cannot matter, or follow from others by symmetry
    """

    dimension: int
    mirror_planes: int
    parts: int
    free_blocks: int
    contact_points: int
    dropped_points: int


@dataclass(frozen=True)
class ProgramSize:
    """Size of the programs of a load case that have a live load in them.

    unknowns : velocities, rows of the equilibrium matrices
    cones    : friction cones, one a contact point; in a plane each is a pair of half-lines
    entries  : of the equilibrium matrices, other than zero
    largest  : unknowns of the largest program
    """

    unknowns: int
    cones: int
    entries: int
    largest: int


@dataclass(frozen=True)
class ReductionStep:
    """One reduction of one load case.

    name  : planar, mirror, parts, unloaded, points, or glued
    found : how many contact points, blocks, parts it left out or took apart; 0 unless applied
    """

    name: str
    state: ReductionOutcome
    found: int
    before: ProgramSize
    after: ProgramSize


def size_of(programs: Iterable[Program]) -> ProgramSize:
    """Size of those of the programs that have a live load in them."""
    loaded = [program for program in programs if np.any(program.live_load)]
    unknowns = [len(program.dead_load) for program in loaded]
    return ProgramSize(
        unknowns=sum(unknowns),
        cones=sum(program.n_points for program in loaded),
        entries=sum(int(program.equilibrium_matrix.nnz) for program in loaded),
        largest=max(unknowns, default=0),
    )


def glued_step(bodies: RigidBodies, left: ProgramSize) -> ReductionStep:
    """Blocks that glue makes part of a larger body or holds; contact points inside of these were never set up.

    left : size of the program in which glued blocks are bodies
    """
    label = bodies.body_of_block
    held = len(bodies.contacts.report.held)
    joined = 0
    saved = held
    if label is not None:
        sizes = np.bincount(label)
        joined = int(sizes[sizes > 1].sum())
        saved += len(label) - len(sizes)  # a load cell is none of them
    unknowns = left.unknowns + 6 * saved
    before = replace(left, unknowns=unknowns, largest=unknowns)
    state = ReductionOutcome.APPLIED if saved else ReductionOutcome.NONE
    return ReductionStep("glued", state, joined + held, before, left)


REDUCTIONS = ("planar", "mirror", "parts", "unloaded", "points")
"""Names of what is searched for and left out before the solver; the answer is the same without.

planar structures are solved with three unknowns a block; of a symmetric structure only one half, under associative
flow; parts that cannot interact are solved apart; parts without live load only have to stand, which is shown apart;
contact points that cannot matter under associative flow are left out.
"""


@dataclass(frozen=True)
class ReductionSwitches:
    """Which reductions are used.

    on     : false: none at all
    mirror : halves of symmetric structures may be left out, where the flow rule lets them
    points : contact points may be left out, where the flow rule lets them
    """

    on: bool = True
    mirror: bool = True
    points: bool = True

    def step(self, name: str, allowed: bool, found: int, before: ProgramSize, after: ProgramSize) -> ReductionStep:
        """The record of a reduction that was tried, or not allowed."""
        state = (
            ReductionOutcome.NONE
            if allowed and self.on
            else ReductionOutcome.BARRED
            if self.on
            else ReductionOutcome.OFF
        )
        return ReductionStep(name, ReductionOutcome.APPLIED if found else state, found, before, after)


def allowed_reductions(analysis: AnalysisSection) -> ReductionSwitches:
    """Switches for ``reduce_program``."""
    return ReductionSwitches(analysis.reductions)
