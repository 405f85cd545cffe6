"""The failure as it is told: clusters that move, and the hinge lines, sliding planes and cracks between them."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.cluster_joints import cluster_joints
from mbla.results.collapse.clusters import clusters_of
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.cracks import Crack, cracks
from mbla.results.collapse.hinge_lines import HingeLine, hinge_lines
from mbla.results.collapse.kept import kept
from mbla.results.collapse.main_parts import FEW, MainParts, main_parts
from mbla.results.collapse.rigid_parts import PartMotion, part_motions
from mbla.results.collapse.sliding_planes import SlidingPlane, sliding_planes
from mbla.results.collapse.yield_lines import YieldLine, yield_lines
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
