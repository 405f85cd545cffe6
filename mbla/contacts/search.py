"""The contacts stage in one page: from the model to its interfaces, contact points and the report on both."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.broad_phase import find_block_pairs
from mbla.contacts.contacts import Contacts
from mbla.contacts.corners import areas_and_centroids, needed_corners
from mbla.contacts.facets import build_facets
from mbla.contacts.given import patches_of
from mbla.contacts.glue import Glue, glue_blocks
from mbla.contacts.interface_points import interface_points
from mbla.contacts.joints import Sites, joints_of_interfaces
from mbla.contacts.narrow_phase import Patches, Verdicts, find_patches, judge
from mbla.contacts.near_misses import without_covered
from mbla.contacts.overlaps import find_overlaps
from mbla.contacts.polygons import centroids
from mbla.contacts.refine import point_starts
from mbla.contacts.report import Findings, both_fixed, build_report
from mbla.deck.types import ContactsSection
from mbla.model.model import Model

# Interfaces of one pair of bodies are sorted along a direction that no building is likely to be square to, so that
# rounding does not turn their order.
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])


def find_contacts(model: Model, section: ContactsSection) -> Contacts:
    """Find the interfaces between all blocks, and between blocks and ground planes.

    Tolerances are relative to block size, the cube root of the volume of the smaller block of a pair. Contacts between
    two bodies that are both fixed are counted in the report and left out: nothing depends on their forces. So are open
    interfaces, and those inside of the rigid bodies that glued ones make.
    """
    blocks, tolerance = model.blocks, section.tolerance
    facets = build_facets(blocks)
    pairs = find_block_pairs(blocks, tolerance)
    verdicts = judge(find_patches(blocks, facets, pairs, model.grounds, tolerance), tolerance)
    if model.interfaces is not None:
        nothing = np.empty(0, dtype=np.int64)
        slivers, near_misses = verdicts.slivers.take(nothing), verdicts.near_misses.take(nothing)
        verdicts = Verdicts(patches_of(model, model.interfaces), slivers, near_misses)
    touching = verdicts.contacts.overlays.bodies
    overlaps = find_overlaps(blocks, facets, pairs, tolerance)
    movable = _sorted(verdicts.contacts.take(~both_fixed(model, touching)))
    laws, notices = joints_of_interfaces(model, section, _sites(movable))
    glue = glue_blocks(model, movable.overlays.bodies[laws.glued])
    inside = laws.glued | _inside(model, glue, movable.overlays.bodies)
    rows = np.flatnonzero(~laws.open & ~inside)
    kept, (joints, joint_names) = movable.take(rows), laws.in_use(rows)
    corners = needed_corners(kept.polygons, tolerance)
    area, centroid = areas_and_centroids(corners, len(kept))
    found, left_alone = interface_points(corners, centroid, kept.overlays.sizes, section.points)
    report = build_report(
        model,
        section,
        Findings(
            contacts=verdicts.contacts,
            slivers=verdicts.slivers,
            near_misses=without_covered(verdicts.near_misses, verdicts.contacts),
            overlaps=overlaps,
            open_bodies=movable.overlays.bodies[laws.open],
            glued_bodies=movable.overlays.bodies[inside & ~laws.open],
            glue=glue,
        ),
        [*notices, *left_alone],
    )
    interface, size = found.polygon, kept.overlays.sizes
    return Contacts(
        bodies=kept.overlays.bodies,
        normals=kept.overlays.frames[:, 0],
        areas=area * size**2,
        centroids=_in_space(kept, np.arange(len(kept)), centroid),
        gaps=kept.gaps * size,
        joints=joints,
        joint_names=joint_names,
        point_start=point_starts(found),
        outline=found.outline,
        points=_in_space(kept, interface, found.points),
        frames=kept.overlays.frames[interface],
        point_areas=found.areas * size[interface] ** 2,
        report=report,
        solid_of_block=glue.solid_of_block,
    )


def _inside(model: Model, glue: Glue, bodies: IntArray) -> BoolArray:
    """Interfaces (n, 2) between blocks of one solid, or between what glue and supports hold on both sides, (n,)."""
    body = np.arange(len(model.blocks)) if glue.solid_of_block is None else glue.solid_of_block
    body = np.where(glue.held | model.fixed, -1, body)
    of_bodies = np.append(body, np.full(len(model.grounds), -1))[bodies]
    return np.asarray(of_bodies[:, 0] == of_bodies[:, 1])


def _sites(patches: Patches) -> Sites:
    rows = np.arange(len(patches))
    return Sites(
        patches.overlays.bodies, patches.overlays.frames[:, 0], _in_space(patches, rows, centroids(patches.polygons))
    )


def _sorted(patches: Patches) -> Patches:
    """By body a, body b, position."""
    bodies = patches.overlays.bodies
    along = _in_space(patches, np.arange(len(patches)), centroids(patches.polygons)) @ _ODD_DIRECTION
    return patches.take(np.lexsort((along, bodies[:, 1], bodies[:, 0])))


def _in_space(patches: Patches, row: IntArray, points: FloatArray) -> FloatArray:
    """Local points (n, 2) of the patches ``row`` in space, (n, 3) m."""
    overlays = patches.overlays
    offsets = np.einsum("ka,kai->ki", points, overlays.frames[row, 1:])
    result: FloatArray = overlays.origins[row] + overlays.sizes[row, None] * offsets
    return result
