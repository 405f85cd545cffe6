"""Blocks behind blocks: those that are made when others are there already."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.blocks import Blocks, join_labels


def append_blocks(blocks: Blocks, more: Blocks) -> Blocks:
    """The blocks, then others, of groups that none of the first has; each with its number in its group."""
    both = (blocks, more)

    def joined(name: str) -> np.ndarray:
        return np.concatenate([getattr(each, name) for each in both])

    return Blocks(
        vertices=joined("vertices"),
        vertex_start=np.append(blocks.vertex_start[:-1], blocks.vertex_start[-1] + more.vertex_start),
        loops=np.append(blocks.loops, len(blocks.vertices) + more.loops),
        loop_start=np.append(blocks.loop_start[:-1], blocks.loop_start[-1] + more.loop_start),
        face_start=np.append(blocks.face_start[:-1], blocks.face_start[-1] + more.face_start),
        facet_of_face=np.append(
            blocks.facet_of_face, blocks.facet_of_face.max(initial=-1) + 1 + more.facet_of_face
        ).astype(np.int64),
        face_normals=joined("face_normals"),
        convex=joined("convex"),
        volumes=joined("volumes"),
        centroids=joined("centroids"),
        densities=joined("densities"),
        added_masses=joined("added_masses"),
        added_mass_points=joined("added_mass_points"),
        groups=blocks.groups + more.groups,
        group_indices=joined("group_indices"),
        labels=join_labels([blocks.labels, more.labels]),
        strengths=_strengths(blocks, more),
    )


def _strengths(blocks: Blocks, more: Blocks) -> FloatArray | None:
    """Of all; infinite of the blocks of which none is given."""
    both = [each.strengths for each in (blocks, more)]
    if both[0] is None and both[1] is None:
        return None
    sizes = (len(blocks), len(more))
    return np.concatenate(
        [np.full((size, 2), np.inf) if given is None else given for size, given in zip(sizes, both, strict=True)]
    )
