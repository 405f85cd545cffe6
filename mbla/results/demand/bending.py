"""Tension by bending: each block as a beam along its longest direction; in a planar problem the longest in its plane.

Across it sections are laid in the middle, where each force begins and ends, beside points, and halfway between those.
On a section acts what lies on one side of it, of what is spread a share; R its sum, M its moment about the centroid of
the section. With the axes p, q of the section and a = p × q along the block, the stress of a beam (Navier) is, tension
positive::

    σ = −R·a / A + α p + β q        [∫p²  ∫pq] [α]   [ M·q]
                                    [∫pq  ∫q²] [β] = [−M·p]

What is spread has a density that is linear along the block and whose middle is the centroid. Where a block tapers to
less than half of its greatest section it is no beam. Close to a force, and in a block as deep as long, the stress is
the mean slope of the true one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.contacts.contacts import Contacts
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import ranges
from mbla.results.collapse.thrust import NO_FORCE
from mbla.results.demand.actions import AT_A_POINT, Actions
from mbla.results.demand.bearings import widths_along
from mbla.results.demand.boxes import Boxes

AS_LONG = 0.99
"""share of the longest direction from which another one is as long"""
BESIDE = 1e-6
"""distance of a section from a force, over the length of the block"""
TAPERED = 0.5
"""share of the greatest section below which a section is none of a beam"""
AT_ONCE = 20_000
"""sections that are worked out together: what they take of memory"""


@dataclass(frozen=True)
class Sections:
    """Sections across blocks: which block, which axis of its box, at which distance from the centroid, (n,) each."""

    blocks: IntArray
    axes: IntArray
    places: FloatArray

    def only(self, chosen: slice) -> Sections:
        """Some of them."""
        return Sections(self.blocks[chosen], self.axes[chosen], self.places[chosen])


def tension_by_bending(
    blocks: Blocks, boxes: Boxes, contacts: Contacts, actions: Actions, judged: BoolArray
) -> FloatArray:
    """Greatest tension in the sections of each block, (n_blocks,) Pa; 0 where there is none, nan where not judged.

    judged : (n_blocks, 3) axes along which blocks are beams if they are long, none of those that are not judged
    """
    found = np.zeros(len(judged))
    stretches = _stretches(blocks, boxes, contacts, actions)
    sections = _sections(boxes, actions, stretches, judged)
    areas = np.zeros(len(sections.blocks))
    tension = np.zeros(len(sections.blocks))
    for begin in range(0, len(areas), AT_ONCE):
        part = slice(begin, begin + AT_ONCE)
        areas[part], tension[part] = _stress_in_sections(blocks, boxes, actions, stretches, sections.only(part))
    greatest = np.zeros((len(blocks), 3))
    np.maximum.at(greatest, (sections.blocks, sections.axes), areas)
    scale = np.zeros(len(blocks))
    np.maximum.at(scale, actions.owner, np.linalg.norm(actions.forces, axis=1))
    tension[tension * areas <= NO_FORCE * scale[sections.blocks]] = 0.0
    full = areas > TAPERED * greatest[sections.blocks, sections.axes]
    np.maximum.at(found, sections.blocks[full], tension[full])
    return np.where(judged.any(axis=1), found, np.nan)


def _stretches(blocks: Blocks, boxes: Boxes, contacts: Contacts, actions: Actions) -> FloatArray:
    """Where each action begins and ends along the axes of its block, from the centroid, (3, 2, m) m."""
    owner, spread = actions.owner, actions.interfaces != AT_A_POINT
    arms, found = actions.places - blocks.centroids[owner], np.empty((3, 2, len(owner)))
    for axis in range(3):
        along, half = boxes.axes[owner, axis], np.zeros(len(owner))
        half[spread] = widths_along(contacts, actions.interfaces[spread], actions.places[spread], along[spread]) / 2
        middle = np.einsum("ri,ri->r", arms, along)
        found[axis] = middle - half, middle + half
    return found


def _sections(boxes: Boxes, actions: Actions, stretches: FloatArray, judged: BoolArray) -> Sections:
    """Beside the ends of each action on a block, halfway between, and in the middle of the block."""
    lengths = boxes.lengths
    longest = np.where(judged, lengths, 0.0).max(axis=1)
    block, axis = np.nonzero((lengths >= AS_LONG * longest[:, None]) & judged)
    counts = np.diff(actions.start)[block]
    span, row = np.repeat(np.arange(len(block)), counts), ranges(actions.start[block], counts)
    place, span = stretches[axis[span], :, row].T.ravel(), np.tile(span, 2)
    order = np.lexsort([place, span])
    span, place = span[order], place[order]
    near = BESIDE * lengths[block, axis]
    apart = (np.diff(place) > 4 * near[span[1:]]) & (np.diff(span) == 0)
    first = np.concatenate([[True], apart | (np.diff(span) != 0)])[: len(span)]
    halfway = (place[:-1] + place[1:])[apart] / 2
    last = np.concatenate([first[1:], [True]])[: len(span)]
    middle = (boxes.low[block, axis] + boxes.high[block, axis]) / 2
    spans = np.concatenate([span[first], span[last], span[1:][apart], np.arange(len(block))])
    places = np.concatenate([place[first] - near[span[first]], place[last] + near[span[last]], halfway, middle])
    of_block, of_axis, edge = block[spans], axis[spans], 2 * near[spans]
    inside = (places > boxes.low[of_block, of_axis] + edge) & (places < boxes.high[of_block, of_axis] - edge)
    return Sections(of_block[inside], of_axis[inside], places[inside])


def _stress_in_sections(
    blocks: Blocks, boxes: Boxes, actions: Actions, stretches: FloatArray, sections: Sections
) -> tuple[FloatArray, FloatArray]:
    """Area of sections, (n,) m2, and the greatest tension in them, (n,) Pa; 0 where there is none, or no section."""
    block, count = sections.blocks, len(sections.blocks)
    turned = (sections.axes[:, None] + np.array([1, 2, 0])) % 3  # p, q, a
    axes = boxes.axes[block[:, None], turned]
    owner, ends = _outlines(blocks, boxes, sections, axes)
    p, q = ends[:, :, 0], ends[:, :, 1]
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    area = summed(owner, cross, count) / 2
    size = np.where(area > 0.0, area, 1.0)
    centre = summed(owner, ends.sum(axis=1) * cross[:, None], count) / (6 * size[:, None])
    ends = ends - centre[owner, None]
    p, q = ends[:, :, 0], ends[:, :, 1]
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    pp, qq = ((each**2).sum(axis=1) + each[:, 0] * each[:, 1] for each in (p, q))
    pq = p[:, 0] * q[:, 1] / 2 + p[:, 0] * q[:, 0] + p[:, 1] * q[:, 1] + p[:, 1] * q[:, 0] / 2
    ipp, iqq, ipq = (summed(owner, cross * each, count) / 12 for each in (pp, qq, pq))
    normal, moment_p, moment_q = _section_forces(blocks, boxes, actions, stretches, sections, axes, centre)
    determinant = ipp * iqq - ipq**2
    sound = (area > 0.0) & (determinant > 0.0)
    determinant = np.where(sound, determinant, 1.0)
    alpha = (iqq * moment_q + ipq * moment_p) / determinant
    beta = (-ipp * moment_p - ipq * moment_q) / determinant
    slope = np.einsum("rki,ri->rk", ends, np.column_stack([alpha, beta])[owner]).max(axis=1, initial=0.0)
    most = np.full(count, -np.inf)
    np.maximum.at(most, owner, slope)
    tension = np.where(sound, normal / size + np.where(np.isfinite(most), most, 0.0), 0.0)
    return np.where(sound, area, 0.0), np.maximum(tension, 0.0)


def _outlines(blocks: Blocks, boxes: Boxes, sections: Sections, axes: FloatArray) -> tuple[IntArray, FloatArray]:
    """Pieces of the outlines of sections: whose they are, (m,), and both ends, (m, 2, 2) m, along p and q.

    Each triangle of the surface that a section cuts gives one, from where it leaves the lower side to where it comes
    back, so that outlines turn counter-clockwise about the axis.
    """
    counts = np.diff(boxes.start)[sections.blocks]
    owner = np.repeat(np.arange(len(counts)), counts)
    corners = boxes.triangles[ranges(boxes.start[sections.blocks], counts)]
    arms = blocks.vertices[corners] - blocks.centroids[sections.blocks[owner]][:, None]
    local = np.einsum("tkj,tij->tki", arms, axes[owner])
    height = local[:, :, 2] - sections.places[owner, None]
    above = height >= 0.0
    cut = above.any(axis=1) & ~above.all(axis=1)
    owner, local, height, above = owner[cut], local[cut], height[cut], above[cut]
    ends = np.empty((len(owner), 2, 2))
    for end, (here, there) in enumerate(((True, False), (False, True))):  # edge from above to below, and back
        corner = np.argmax((above == here) & (np.roll(above, -1, axis=1) == there), axis=1)
        row, after = np.arange(len(owner)), (corner + 1) % 3
        share = height[row, corner] / (height[row, corner] - height[row, after])
        start = local[row, corner, :2]
        ends[:, end] = start + share[:, None] * (local[row, after, :2] - start)
    return owner, ends


def _section_forces(
    blocks: Blocks,
    boxes: Boxes,
    actions: Actions,
    stretches: FloatArray,
    sections: Sections,
    axes: FloatArray,
    centre: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Tension along the axis, (n,) N, and moments of what acts below about p and q through the centroid, (n,) N m."""
    block, count = sections.blocks, len(sections.blocks)
    counts = np.diff(actions.start)[block]
    owner, row = np.repeat(np.arange(count), counts), ranges(actions.start[block], counts)
    begin, end = stretches[sections.axes[owner], :, row].T
    below = begin < sections.places[owner]
    owner, row, begin, end = owner[below], row[below], begin[below], end[below]
    reached = np.minimum(sections.places[owner], end)
    part = np.where(end > reached, (reached - begin) / np.where(end > begin, end - begin, 1.0), 1.0)
    arms = np.einsum("ri,rji->rj", actions.places[row] - blocks.centroids[block[owner]], axes[owner])
    arms[:, 2] = (begin + reached) / 2
    origin = np.column_stack([centre, sections.places])
    forces = part[:, None] * np.einsum("ri,rji->rj", actions.forces[row], axes[owner])
    total = summed(owner, np.hstack([forces, np.cross(arms - origin[owner], forces)]), count)
    share, first = _spread_below(boxes.low[block, sections.axes], boxes.high[block, sections.axes], sections.places)
    spread = np.einsum("nkj,nij->nki", actions.spread[block].reshape(-1, 2, 3), axes)
    along = np.zeros((count, 3))
    along[:, 2] = first  # the first moment of the share along the axis
    total[:, :3] += share[:, None] * spread[:, 0]
    total[:, 3:] += share[:, None] * spread[:, 1] + np.cross(along - share[:, None] * origin, spread[:, 0])
    return -total[:, 2], total[:, 3], total[:, 4]


def _spread_below(low: FloatArray, high: FloatArray, place: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Share of a linear density of sum 1 and middle 0 below a place, and its first moment, (n,) each."""
    length, middle = high - low, (low + high) / 2
    tilt = -12.0 * middle / length**2
    bottom, top = low - middle, place - middle
    share = ((top - bottom) + tilt * (top**2 - bottom**2) / 2) / length
    first = ((top**2 - bottom**2) / 2 + tilt * (top**3 - bottom**3) / 3) / length
    return share, first + middle * share
