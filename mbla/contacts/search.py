"""The contacts stage in one page: from the model to its interfaces, contact points and the report on both."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.contacts.faces.broad_phase import find_block_pairs
from mbla.contacts.faces.facets import Facets, build_facets
from mbla.contacts.faces.narrow_phase import Patches, Verdicts, find_patches, judge
from mbla.contacts.faces.overlapping_supports import without_overlapping_supports
from mbla.contacts.faces.third_block import SeparatedPairs, drop_pairs_separated_by_third_block
from mbla.contacts.glue import Glue, glue_blocks
from mbla.contacts.joints import Laws, joints_of_interfaces
from mbla.contacts.notices import outline_notices, report_notices
from mbla.contacts.outlines.corners import areas_and_centroids, needed_corners
from mbla.contacts.outlines.overlay import Overlays, frames_from_normals, in_space
from mbla.contacts.outlines.points import in_pieces, interface_points
from mbla.contacts.overlaps import SLIGHT, find_overlaps
from mbla.contacts.report import Findings, both_fixed, build_report, held_blocks, misses_within, unsupported_parts
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model, PrescribedInterfaces
from mbla.model.solids.polygons import polygons_from_loops, widths

# Interfaces of one pair of bodies are sorted along a direction that no building is likely to be square to, so that
# rounding does not turn their order.
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])


def find_contacts(model: Model, section: ContactsSection) -> Contacts:
    """Find the interfaces between all blocks, and between blocks and ground planes.

    Tolerances are relative to block size, the cube root of the volume of the smaller block of a pair. Contacts between
    two bodies that are both fixed are counted in the report and left out: nothing depends on their forces. So are open
    interfaces, and those inside of the rigid bodies that glued ones make. Of joint laws only the names count,
    and whether they can crush: surfaces that can are in pieces (:mod:`mbla.contacts.outlines.points`). Loads count for
    nothing.

    Raises
    ------
    ContactsRefused
        for too many pairs of blocks or points, and for pieces of a face that two bodies hold at odds
    """
    pairs = find_block_pairs(model.blocks, min(section.depth_allowed, SLIGHT))
    facets = build_facets(model.blocks)
    verdicts, separated = _verdicts(model, facets, section.tolerance, section.depth_allowed)
    # blocks that do not move are never in contact, whatever they share: footings drawn into each other
    overlaps = find_overlaps(model.blocks, facets, pairs[~both_fixed(model, pairs)], section.depth_allowed)
    order = _order(verdicts.contacts, ~both_fixed(model, verdicts.contacts.overlays.bodies))
    movable = verdicts.contacts.take(order)
    bodies = movable.overlays.bodies
    prescribed = None if model.interfaces is None else [model.interfaces.joints[row] for row in order.tolist()]
    laws, notices = joints_of_interfaces(model, section, movable.overlays, _centroids(movable), prescribed)
    glue = glue_blocks(model, bodies[laws.glued])
    inside = laws.glued | _inside(model, glue, bodies)
    rows = np.flatnonzero(~laws.open & ~inside)
    kept, source, twice = without_overlapping_supports(
        model, glue.held | model.fixed, movable.take(rows), laws, rows, section.tolerance
    )
    order = _order(kept, np.ones(len(kept), dtype=bool))
    kept, rows = kept.take(order), rows[source[order]]
    findings = Findings(
        contacts=verdicts.contacts,
        slivers=verdicts.slivers,
        near_misses=verdicts.near_misses,
        overlaps=overlaps,
        separated=separated,
        open_bodies=bodies[laws.open],
        glued_bodies=bodies[inside & ~laws.open],
        glue=glue,
    )
    report = build_report(model, findings)
    contacts, simpler = _contacts(model, section, kept, laws, rows, report, glue)
    remarks = (*notices, *twice, *simpler, *report_notices(model, section, report, findings))
    return replace(contacts, report=replace(report, notices=remarks))


def _contacts(
    model: Model,
    section: ContactsSection,
    kept: Patches,
    laws: Laws,
    rows: IntArray,
    report: ContactReport,
    glue: Glue,
) -> tuple[Contacts, list[Notice]]:
    """The interfaces with their points, in pieces where they can crush, and what is said of their outlines.

    laws : joint laws; those of the interfaces are at ``rows``
    """
    corners = needed_corners(kept.polygons, section.tolerance)
    notices = outline_notices(model, section, kept, areas_and_centroids(corners)[0])
    law_of, names = laws.in_use(rows)
    crushable = np.isfinite([model.joints[name].compressive_strength for name in names])
    corners, piece = in_pieces(corners, crushable[law_of])
    kept, law_of = kept.take(piece), law_of[piece]
    _, centroid = areas = areas_and_centroids(corners)
    found, left_alone = interface_points(corners, centroid, kept.overlays.sizes, section.points)
    gaps = kept.gaps * kept.overlays.sizes
    contacts = Contacts.on(kept.overlays, areas, found, (law_of, names), gaps, report, glue.solid_of_block)
    return contacts, [*notices, *left_alone]


def _verdicts(model: Model, facets: Facets, tolerance: float, overlap: float) -> tuple[Verdicts, SeparatedPairs]:
    """What touches, what nearly does, what a third block separates; prescribed interfaces are taken as they are."""
    if model.interfaces is None:
        patches = find_patches(model.blocks, facets, model.grounds, tolerance, overlap)
        found = judge(patches, tolerance, overlap=overlap)
        verdicts, separated = drop_pairs_separated_by_third_block(found, model.blocks, tolerance)
        if unsupported_parts(held_blocks(model), found.contacts.overlays.bodies):
            wide = replace(found, near_misses=misses_within(model, facets, tolerance, overlap) or found.near_misses)
            near_misses = drop_pairs_separated_by_third_block(wide, model.blocks, tolerance)[0].near_misses
            verdicts = replace(verdicts, near_misses=near_misses)
        return verdicts, separated
    prescribed = patches_of_prescribed(model, model.interfaces)
    nothing = prescribed.take(np.empty(0, dtype=np.int64))
    return Verdicts(prescribed, nothing, nothing), SeparatedPairs(nothing, np.empty(0, dtype=np.int64))


def _inside(model: Model, glue: Glue, bodies: IntArray) -> BoolArray:
    """Interfaces (n, 2) between blocks of one solid, or between what glue and supports hold on both sides, (n,)."""
    body = np.arange(len(model.blocks)) if glue.solid_of_block is None else glue.solid_of_block
    body = np.where(glue.held | model.fixed, -1, body)
    of_bodies = np.append(body, np.full(len(model.grounds), -1))[bodies]
    return np.asarray(of_bodies[:, 0] == of_bodies[:, 1])


def _order(patches: Patches, chosen: BoolArray) -> IntArray:
    """Rows of the chosen patches by body a, body b, position."""
    rows = np.flatnonzero(chosen)
    some = patches.take(rows)
    bodies = some.overlays.bodies
    along = _centroids(some) @ _ODD_DIRECTION
    return np.asarray(rows[np.lexsort((along, bodies[:, 1], bodies[:, 0]))])


def _centroids(patches: Patches) -> FloatArray:
    """Of common surfaces, (n, 3) m."""
    centres = shapely.get_coordinates(shapely.centroid(patches.polygons))
    return in_space(patches.overlays, np.arange(len(patches)), centres)


def patches_of_prescribed(model: Model, prescribed: PrescribedInterfaces) -> Patches:
    """Prescribed interfaces as common surfaces without a gap, in the form of those that are found."""
    n = len(prescribed.bodies)
    row = row_of_item(prescribed.corner_start)
    counts = np.diff(prescribed.corner_start)[:, None]
    origins = np.add.reduceat(prescribed.corners, prescribed.corner_start[:-1], axis=0) / counts
    all_sizes = np.append(model.blocks.sizes, np.full(len(model.grounds), np.inf))
    sizes = all_sizes[prescribed.bodies].min(axis=1)
    frames = frames_from_normals(prescribed.normals)
    arms = (prescribed.corners - origins[row]) / sizes[row, None]
    local = np.einsum("ki,kai->ka", arms, frames[row, 1:])
    polygons = polygons_from_loops(local, prescribed.corner_start)
    nothing = np.full((n, 2), -1, dtype=np.int64)
    overlays = Overlays(prescribed.bodies, nothing, origins, frames, sizes, np.zeros((n, 3)))
    return Patches(overlays, polygons, widths(polygons), np.zeros(n), np.zeros(n), np.ones(n))
