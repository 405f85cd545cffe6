"""Interfaces that touch, whatever the directions of the axes."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.polygons import box_pairs
from mbla.results.collapse.by_interface import interface_radii

TOUCH = 0.01
"""gap of two interfaces, over the radius of the smaller one, up to which they touch"""
PARALLEL = 1e-6
"""sine below which two edges have no direction across both"""


def touching_pairs(contacts: Contacts, interfaces: IntArray) -> tuple[IntArray, IntArray]:
    """Pairs of rows of ``interfaces`` whose convex hulls touch, each pair once.

    Two convex bodies are apart where they are along one of these directions: the normals of their faces and edges, and
    those across an edge of both (Gottschalk et al. 1996, doi:10.1145/237170.237244). Boxes along the axes come first.
    """
    size = interface_radii(contacts)[interfaces]
    margin = TOUCH * size[:, None]
    lower = np.minimum.reduceat(contacts.points, contacts.point_start[:-1])[interfaces] - margin
    upper = np.maximum.reduceat(contacts.points, contacts.point_start[:-1])[interfaces] + margin
    i, j = box_pairs(lower, upper)
    gap = TOUCH * np.minimum(size[i], size[j])
    near = np.zeros(len(i), dtype=bool)
    counts = np.column_stack([contacts.outline[interfaces[i]], contacts.outline[interfaces[j]]])
    for shape in np.unique(counts, axis=0):
        chosen = np.flatnonzero(np.all(counts == shape, axis=1))
        first, second = (_outlines(contacts, interfaces[rows[chosen]]) for rows in (i, j))
        normals = contacts.normals[interfaces[i[chosen]]], contacts.normals[interfaces[j[chosen]]]
        near[chosen] = ~_apart(first, second, *normals, gap[chosen])
    return i[near], j[near]


def _outlines(contacts: Contacts, interfaces: IntArray) -> FloatArray:
    """Corners of interfaces with equally many, (n, corners, 3)."""
    count = contacts.outline[interfaces[0]]
    return contacts.points[contacts.point_start[interfaces][:, None] + np.arange(count)]


def _apart(
    first: FloatArray, second: FloatArray, normal: FloatArray, other_normal: FloatArray, gap: FloatArray
) -> BoolArray:
    """Whether there is more than the gap between two outlines each along any of the directions, (n,)."""
    edges, other_edges = (np.roll(outline, -1, axis=1) - outline for outline in (first, second))
    across = np.cross(edges[:, :, None, :], other_edges[:, None, :, :]).reshape(len(first), -1, 3)
    lengths = np.linalg.norm(edges, axis=2)[:, :, None] * np.linalg.norm(other_edges, axis=2)[:, None, :]
    directions = np.concatenate(
        [
            normal[:, None],
            other_normal[:, None],
            np.cross(edges, normal[:, None]),
            np.cross(other_edges, other_normal[:, None]),
            across,
        ],
        axis=1,
    )
    size = np.linalg.norm(directions, axis=2)
    clear = np.ones(size.shape, dtype=bool)
    clear[:, -across.shape[1] :] = size[:, -across.shape[1] :] > PARALLEL * lengths.reshape(len(first), -1)
    directions = directions / np.where(clear & (size > 0), size, 1.0)[:, :, None]
    one, other = (np.einsum("ndx,npx->ndp", directions, outline) for outline in (first, second))
    between = np.maximum(other.min(axis=2) - one.max(axis=2), one.min(axis=2) - other.max(axis=2))
    return np.asarray(np.any(clear & (between > gap[:, None]), axis=1))
