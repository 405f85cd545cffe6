"""Blocks joined to bigger ones.

A joined block has the faces of its members, those on which they touch included. Volume and mass are the sums, the
centroid is the common one of the volumes. Faces that members share stay inside, so that such a block is no closed
surface without more; mechanics needs its centroid, size and mass only.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray, starts, summed
from mbla.model.solids.blocks import BlockLabels, Blocks, carried_masses
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import items_of_rows, numbered


def join_blocks(blocks: Blocks, joined: IntArray) -> Blocks:
    """The joined blocks, named after the first member of each.

    joined : (n_blocks,) which joined block each becomes part of; numbered from 0 without gaps
    """
    order = np.argsort(joined, kind="stable")
    count = int(joined.max(initial=-1)) + 1
    first = order[np.searchsorted(joined[order], np.arange(count))]
    vertices, faces = items_of_rows(blocks.vertex_start, order), items_of_rows(blocks.face_start, order)
    corners = items_of_rows(blocks.loop_start, faces)
    new_vertex = np.empty(len(blocks.vertices), dtype=np.int64)
    new_vertex[vertices] = np.arange(len(vertices))
    volumes = summed(joined, blocks.volumes, count)
    alone = np.bincount(joined, minlength=count) == 1
    centroids = summed(joined, blocks.volumes[:, None] * blocks.centroids, count) / volumes[:, None]
    densities = summed(joined, blocks.volumes * blocks.densities, count) / volumes
    # what stands alone keeps its numbers to the last digit
    centroids[alone], densities[alone] = blocks.centroids[first[alone]], blocks.densities[first[alone]]
    strengths = None
    if blocks.strengths is not None:
        strengths = np.full((count, 2), np.inf)
        np.minimum.at(strengths, joined, blocks.strengths)
    added, centres = carried_masses(centroids, joined, blocks.added_masses, blocks.added_mass_points)
    labels = blocks.labels
    return Blocks(
        vertices=blocks.vertices[vertices],
        vertex_start=starts(summed(joined, np.diff(blocks.vertex_start), count).astype(np.int64)),
        loops=new_vertex[blocks.loops[corners]],
        loop_start=starts(np.diff(blocks.loop_start)[faces]),
        face_start=starts(summed(joined, np.diff(blocks.face_start), count).astype(np.int64)),
        facet_of_face=numbered(blocks.facet_of_face[faces])[0],
        face_normals=blocks.face_normals[faces],
        convex=alone & blocks.convex[first],
        volumes=volumes,
        centroids=centroids,
        densities=densities,
        added_masses=added,
        added_mass_points=centres,
        groups=tuple(blocks.groups[block] for block in first),
        group_indices=blocks.group_indices[first],
        labels=BlockLabels(tuple(labels.members[block] for block in first), labels.positions[first]),
        strengths=strengths,
    )


def polyhedra_of(blocks: Blocks) -> Polyhedra:
    """The polyhedra that blocks were made of, faces outwards."""
    return Polyhedra(blocks.vertices, blocks.vertex_start, blocks.loops, blocks.loop_start, blocks.face_start)
