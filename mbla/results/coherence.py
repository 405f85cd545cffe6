"""What arrays of a model must have in common, whatever its deck: volumes are those of the faces, frames are square."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.measures import volumes_and_centroids
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import row_sums

ROUNDING = 1e-6
"""Difference over the size of a block, or of an area over the largest, that is no contradiction."""


@np.errstate(over="ignore", invalid="ignore")  # what is no number is no agreement either
def incoherences(model: Model, contacts: Contacts) -> tuple[str, ...]:
    """Where arrays of a model contradict each other, in words."""
    blocks = model.blocks
    corners = np.diff(blocks.loop_start)
    if np.any(corners < 3) or np.any(np.diff(blocks.face_start) < 1) or np.any(blocks.volumes <= 0.0):
        return ("blocks are no solids",)
    solids = Polyhedra(blocks.vertices, blocks.vertex_start, blocks.loops, blocks.loop_start, blocks.face_start)
    volumes, centroids = volumes_and_centroids(solids)
    found = []
    if not np.allclose(volumes, blocks.volumes, rtol=ROUNDING, atol=0.0):
        found.append("volumes of blocks are not those within their faces")
    extent = float(np.abs(blocks.vertices).max(initial=0.0))
    away = np.abs(centroids - blocks.centroids).max(axis=1)
    if not np.all(away <= ROUNDING * blocks.sizes + 1e-9 * extent):
        found.append("centroids of blocks are not those within their faces")
    if not _off(np.einsum("pix,pjx->pij", contacts.frames, contacts.frames), np.eye(3)) <= ROUNDING:
        found.append("frames of contact points are not orthonormal")
    if not _off(contacts.frames[:, 0], contacts.normals[contacts.interface_of_point]) <= ROUNDING:
        found.append("frames of contact points do not follow the normals of interfaces")
    shares = row_sums(contacts.point_areas, contacts.point_start)
    if not _off(shares, contacts.areas) <= ROUNDING * float(np.abs(contacts.areas).max(initial=0.0)):
        found.append("areas of interfaces are not those of their contact points")
    return tuple(found)


def _off(one: FloatArray, other: FloatArray) -> float:
    return float(np.abs(one - other).max(initial=0.0))
