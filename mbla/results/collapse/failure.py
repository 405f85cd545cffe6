"""How a structure fails: parts, hinge lines, sliding planes, cracks, and the class of the mechanism.

Told of the clusters of a failure (:mod:`mbla.results.collapse.failure`), by joints whose contact speed is a notable
share of the largest:

- sliding: joints slide and none hinges;
- twisting: the same, and each of them slides by turning about its normal;
- overturning: parts turn about hinges on what is at rest, each by itself;
- hinging: parts hinge on each other, as in an arch;
- sliding and hinging: both;
- opening: joints only open, as under a block that is lifted off, or above a support that gives way and is not missed.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.clusters import FEW, MainParts, clusters_of, main_parts
from mbla.results.collapse.collapse import Collapse, kept
from mbla.results.collapse.cracks import Crack, YieldLine, cracks, yield_lines
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane, cluster_joints, hinge_lines, sliding_planes
from mbla.results.collapse.rigid_parts import PartMotion, part_motions
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class MovingJoints:
    """Hinge lines and sliding planes between clusters: enough to name the class of a mechanism.

    clusters       : (n_blocks,) cluster of each block, 0 at rest
    merged         : share of the largest contact speed up to which rigid parts were taken for one, 0 where none were
    hinge_lines    : the one that moves most first
    sliding_planes : the one that dissipates most first
    """

    clusters: IntArray
    merged: float
    hinge_lines: tuple[HingeLine, ...]
    sliding_planes: tuple[SlidingPlane, ...]


@dataclass(frozen=True)
class Failure(MovingJoints):
    """What pictures, report and words say of a mechanism.

    motions     : of the clusters that move, the heaviest first
    cracks      : the one that opens most first
    main        : the few parts as which it moves to the eye; the clusters where these are few, or no few parts do
    yield_lines : along which these break off, the longest first
    """

    motions: tuple[PartMotion, ...]
    cracks: tuple[Crack, ...]
    main: MainParts
    yield_lines: tuple[YieldLine, ...]

    @property
    def spreads(self) -> bool:
        """Whether the clusters are so many that main parts are told in their place."""
        return len(self.motions) > len(self.main.motions)


@kept
def moving_joints(model: Model, contacts: Contacts, collapse: Collapse, mechanics: Mechanics) -> MovingJoints:
    """From the exact rigid parts and interfaces of a mechanism."""
    found = clusters_of(model, contacts, collapse.parts, mechanics.mechanism)
    joints = cluster_joints(model, contacts, found.of_block, mechanics)
    return MovingJoints(
        clusters=found.of_block,
        merged=found.merged,
        hinge_lines=hinge_lines(contacts, collapse.interfaces, joints, collapse.work, found.merged),
        sliding_planes=sliding_planes(contacts, collapse.interfaces, joints, collapse.work, found.merged),
    )


@kept
def failure_of(model: Model, contacts: Contacts, collapse: Collapse, mechanics: Mechanics) -> Failure:
    """All of it, from the exact rigid parts and interfaces of a mechanism."""
    moving = moving_joints(model, contacts, collapse, mechanics)
    joints = cluster_joints(model, contacts, moving.clusters, mechanics)
    motions = part_motions(model, moving.clusters, mechanics.mechanism)
    main = MainParts(moving.clusters, motions, 1.0)
    if len(motions) > FEW:
        main = main_parts(model, moving.clusters, motions, mechanics.mechanism)
    return Failure(
        **vars(moving),
        motions=motions,
        cracks=cracks(contacts, collapse.interfaces, joints, mechanics),
        main=main,
        yield_lines=yield_lines(contacts, main.of_block, len(model.grounds)),
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


def mechanism_class(joints: MovingJoints) -> MechanismClass:
    """The class of a mechanism."""
    lines = [line for line in joints.hinge_lines if line.share >= NOTABLE]
    planes = [plane for plane in joints.sliding_planes if plane.share >= NOTABLE]
    slides = bool(planes) or any(_slides(line) for line in lines)
    if lines and slides:
        return MechanismClass.SLIDING_AND_HINGING
    if lines:
        on_rest = all(0 in line.clusters for line in lines)
        return MechanismClass.OVERTURNING if on_rest else MechanismClass.HINGING
    if planes:
        return MechanismClass.TWISTING if all(plane.twists for plane in planes) else MechanismClass.SLIDING
    return MechanismClass.OPENING


def _slides(line: HingeLine) -> bool:
    """Whether a hinge slides notably too: its shear forces take some of the power."""
    return line.slides and bool(np.nan_to_num(line.shear_power_share) >= NOTABLE)
