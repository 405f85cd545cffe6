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
from mbla.results.collapse.rigid_parts import PartMotion, part_motions
from mbla.results.collapse.sliding_planes import SlidingPlane, sliding_planes
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class Failure:
    """What pictures, report and words say of a mechanism.

    clusters       : (n_blocks,) cluster of each block, 0 at rest
    merged         : share of the largest contact speed up to which rigid parts were taken for one, 0 where none were
    motions        : of the clusters that move, the heaviest first
    hinge_lines    : the one that moves most first
    sliding_planes : the one that dissipates most first
    cracks         : the one that opens most first
    """

    clusters: IntArray
    merged: float
    motions: tuple[PartMotion, ...]
    hinge_lines: tuple[HingeLine, ...]
    sliding_planes: tuple[SlidingPlane, ...]
    cracks: tuple[Crack, ...]


@kept
def failure_of(model: Model, contacts: Contacts, collapse: Collapse, mechanics: Mechanics) -> Failure:
    """From the exact rigid parts and interfaces of a mechanism."""
    found = clusters_of(model, contacts, collapse.parts, mechanics.mechanism)
    clusters = found.of_block
    joints = cluster_joints(model, contacts, clusters, mechanics)
    return Failure(
        clusters=clusters,
        merged=found.merged,
        motions=part_motions(model, clusters, mechanics.mechanism),
        hinge_lines=hinge_lines(contacts, collapse.interfaces, joints, collapse.work, found.merged),
        sliding_planes=sliding_planes(contacts, collapse.interfaces, joints, collapse.work, found.merged),
        cracks=cracks(contacts, collapse.interfaces, joints, mechanics),
    )
