"""Tension by splitting: struts in a block between the resultants on its faces.

Two opposite forces P over a length D, spread along a line of length t, split what lies between them. In a disc the
tension across the line is 2P/(π t D) all along it, by which the Brazilian test measures the tensile strength of stone
(reviewed by García et al. 2017, doi:10.1007/s40069-017-0194-7). An even pressure on a width a is one of forces along
chords at a distance x of the middle, each with a tension there of (2P/(π t D)) c (1 − 4 s²), s = 2x/D, c² = 1 − s²
(Flamant's stresses of both and an even tension that leaves the edge free; tests/results/demand/test_disc.py), in the
mean over the width::

    σ = 2P/(π t D) (1 − (a/D)²)^{3/2}

A block is taken for a disc between its bearings. D is the distance of the bearings, and no more than what the block has
to both sides of the strut in its middle: two forces along one edge, and an even pressure on all of a face, split
nothing. Lines are along the axis of the block along which the bearings are longest; t is the length of the shorter one,
and at least D, as far as the block goes.

How the forces on a block meet inside of it is not unique either. Struts are taken in the order in which forces point
along them, each as far as both forces go, so that what goes straight through is no diagonal.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.solids.blocks import Blocks
from mbla.results.demand.bearings import Bearings, widths_along
from mbla.results.demand.boxes import Boxes

MOST = 60
"""bearings of a block between which struts are looked for, those of the greatest forces"""
TURNS = 4
"""struts that are looked for in a block, over its bearings"""
LITTLE = 1e-6
"""share of the greatest force on a block up to which nothing is left of one"""
SHORT = 0.25
"""length or thickness of a strut over the least length of its block up to which it chips an edge and splits no block"""
ALONG = 0.95
"""cosine of the angle between a strut and an axis of the block from which it runs along that"""


@dataclass(frozen=True)
class Struts:
    """Struts between bearings, (n,) each: block, rows of both bearings, and the force in newtons, compression."""

    blocks: IntArray
    ends: IntArray
    forces: FloatArray


def tension_by_splitting(
    blocks: Blocks, boxes: Boxes, contacts: Contacts, bearings: Bearings, judged: BoolArray
) -> FloatArray:
    """Greatest tension across the struts of each block, (n_blocks,) Pa; 0 where there is none, nan where not judged."""
    found = np.zeros(len(judged))
    struts = struts_of(bearings, judged)
    lengths, tensions = np.empty((2, 3, len(struts.blocks)))
    for axis in range(3):
        lengths[axis], tensions[axis] = _tension_across(blocks, boxes, contacts, bearings, struts, axis)
    along = lengths >= (1.0 - LITTLE) * lengths.max(axis=0)
    np.maximum.at(found, struts.blocks, np.where(along, tensions, 0.0).max(axis=0))
    return np.where(judged, found, np.nan)


def struts_of(bearings: Bearings, judged: BoolArray) -> Struts:
    """All struts, of blocks with as many bearings at a time."""
    counts, none = np.where(judged, np.diff(bearings.start), 0), np.zeros(0, dtype=np.int64)
    found = [Struts(none, none.reshape(0, 2), np.zeros(0))]
    for count in np.unique(counts[(counts > 1) & (counts <= MOST)]):
        chosen = np.flatnonzero(counts == count)
        found.append(_struts_of(bearings, chosen, bearings.start[chosen][:, None] + np.arange(count)))
    for block in np.flatnonzero(counts > MOST):
        rows = np.arange(*bearings.start[block : block + 2])
        order = np.argsort(-np.linalg.norm(bearings.forces[rows], axis=1), kind="stable")
        found.append(_struts_of(bearings, np.array([block]), rows[np.sort(order[:MOST])][None]))
    return Struts(*(np.concatenate([getattr(each, name) for each in found]) for name in ("blocks", "ends", "forces")))


def _struts_of(bearings: Bearings, chosen: IntArray, rows: IntArray) -> Struts:
    """Of blocks (n,) between as many bearings of each, (n, count)."""
    count = rows.shape[1]
    places, left = bearings.places[rows], bearings.forces[rows].copy()
    lines = places[:, None, :] - places[:, :, None]  # from i to j
    distance = np.linalg.norm(lines, axis=3)
    ways = lines / np.where(distance > 0.0, distance, 1.0)[..., None]
    greatest = np.linalg.norm(left, axis=2).max(axis=1)
    carried, block = np.zeros((len(chosen), count, count)), np.arange(len(chosen))
    for _ in range(TURNS * count):
        into = np.einsum("nix,nijx->nij", left, ways)
        both = np.minimum(
            into, into.transpose(0, 2, 1)
        )  # the force at j against the way from i is that at j along j to i
        cosine = into / np.maximum(np.linalg.norm(left, axis=2), LITTLE * greatest[:, None])[:, :, None]
        straight = np.minimum(cosine, cosine.transpose(0, 2, 1))
        straight[both <= LITTLE * greatest[:, None, None]] = -1.0
        best = straight.reshape(len(chosen), -1).argmax(axis=1)
        i, j = best // count, best % count
        force = np.where(straight[block, i, j] > 0.0, both[block, i, j], 0.0)
        if not force.any():
            break
        taken = force[:, None] * ways[block, i, j]
        left[block, i] -= taken
        left[block, j] += taken
        carried[block, np.minimum(i, j), np.maximum(i, j)] += force
    n, i, j = np.nonzero(carried)
    return Struts(chosen[n], np.column_stack([rows[n, i], rows[n, j]]), carried[n, i, j])


def _tension_across(
    blocks: Blocks, boxes: Boxes, contacts: Contacts, bearings: Bearings, struts: Struts, axis: int
) -> tuple[FloatArray, FloatArray]:
    """Length of the shorter bearing along one axis of the block, (n,) m, and the tension if both are lines along it."""
    block, ends = struts.blocks, struts.ends
    along = boxes.axes[block, axis]
    line = bearings.places[ends[:, 1]] - bearings.places[ends[:, 0]]
    distance = np.linalg.norm(line, axis=1)
    line = line / distance[:, None]
    across = np.cross(line, along)
    sine = np.linalg.norm(across, axis=1)
    fits = sine > np.sqrt(1.0 - ALONG**2)
    across = across / np.where(fits, sine, 1.0)[:, None]
    lengths, widths = np.empty(ends.shape), np.empty(ends.shape)
    for end in (0, 1):
        row = ends[:, end]
        interface, place = bearings.interfaces[row], bearings.places[row]
        lengths[:, end] = widths_along(contacts, interface, place, along)
        normal = contacts.normals[interface]
        flat = np.cross(along, normal)
        size = np.linalg.norm(flat, axis=1)
        flat = flat / np.where(size > 0.0, size, 1.0)[:, None]
        widths[:, end] = widths_along(contacts, interface, place, flat) * np.abs((flat * across).sum(axis=1))
    middle = (bearings.places[ends[:, 0]] + bearings.places[ends[:, 1]]) / 2
    length = np.minimum(distance, _room(blocks, boxes, block, middle, across))
    width = widths.min(axis=1)
    thickness = np.maximum(lengths.min(axis=1), np.minimum(length, _room(blocks, boxes, block, middle, along)))
    least = SHORT * boxes.lengths[block].min(axis=1)
    splits = fits & (thickness > least) & (length > np.maximum(width * (1.0 + LITTLE), least))
    safe, spread = np.where(splits, length, 1.0), np.where(splits, thickness, 1.0)
    tension = 2.0 * struts.forces / (np.pi * spread * safe)
    tension = np.where(splits, tension * np.maximum(1.0 - (width / safe) ** 2, 0.0) ** 1.5, 0.0)
    return np.where(fits, lengths.min(axis=1), -1.0), tension


def _room(blocks: Blocks, boxes: Boxes, block: IntArray, place: FloatArray, way: FloatArray) -> FloatArray:
    """Twice the way from places to the nearer side of the box of their block, (n,) m, along unit directions."""
    at = np.einsum("nij,nj->ni", boxes.axes[block], place - blocks.centroids[block])
    turned = np.einsum("nij,nj->ni", boxes.axes[block], way)
    room = np.full(len(block), np.inf)
    for sign in (1.0, -1.0):
        going = sign * turned
        side = np.where(going > 0.0, boxes.high[block], boxes.low[block])
        moves = np.abs(going) > LITTLE
        reach = np.where(moves, (side - at) / np.where(moves, going, 1.0), np.inf)
        room = np.minimum(room, reach.min(axis=1))
    return np.maximum(2.0 * room, 0.0)
