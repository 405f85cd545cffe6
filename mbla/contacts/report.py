"""The report on the search for contacts: what was dropped, missed or found wrong, and what hangs together.

The near misses of a structure that hangs together lie within ten times its tolerance. Where some of its blocks reach no
support the tolerance says nothing about the gaps that were left there, so that all up to ``WIDEST`` are examined,
whatever the tolerance is: the same gaps are reported, and the same tolerance that closes them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import ContactReport
from mbla.contacts.faces.broad_phase import NEAR_MISS
from mbla.contacts.faces.facets import Facets
from mbla.contacts.faces.narrow_phase import Patches, find_patches, judge
from mbla.contacts.faces.third_block import SeparatedPairs
from mbla.contacts.glue import Glue
from mbla.contacts.overlaps import Overlaps
from mbla.model.model import Model
from mbla.model.solids.measures import connected_labels


@dataclass(frozen=True)
class Findings:
    """What the search found: all contacts, those between fixed bodies included, and what is not a contact.

    open_bodies      : (n, 2) bodies of the contacts whose joint law is open
    glued_bodies     : (n, 2) bodies of internal interfaces (glued)
    """

    contacts: Patches
    slivers: Patches
    near_misses: Patches
    overlaps: Overlaps
    separated: SeparatedPairs
    open_bodies: IntArray
    glued_bodies: IntArray
    glue: Glue


def build_report(model: Model, findings: Findings) -> ContactReport:
    """The findings in numbers, without notices."""
    overlaps, touching = findings.overlaps, findings.contacts.overlays.bodies
    bodies = _without(touching, findings.open_bodies, len(model.blocks) + len(model.grounds))
    links = model.ties.links(len(model.blocks) + len(model.grounds))
    held = np.vstack([bodies, links[links[:, 0] != links[:, 1]]])
    slivers, widths = _slivers(model, findings.slivers)
    near_misses, gaps = _near_misses(model, findings.near_misses, overlaps)
    return ContactReport(
        slivers=slivers,
        sliver_widths=widths,
        near_misses=near_misses,
        near_miss_gaps=gaps,
        overlaps=overlaps.pairs,
        overlap_depths=overlaps.depths,
        overlap_swallows=overlaps.swallows,
        unchecked=overlaps.unchecked,
        isolated=np.setdiff1d(np.arange(len(model.blocks)), held),
        unsupported=unsupported_parts(held_blocks(model), held),
        fixed_contacts=int(both_fixed(model, touching).sum()),
        open_interfaces=len(findings.open_bodies),
        glued=findings.glued_bodies,
        held=np.flatnonzero(findings.glue.held),
        notices=(),
    )


def _without(bodies: IntArray, taken: IntArray, n_bodies: int) -> IntArray:
    """Pairs of bodies (n, 2) that still touch when some of their contacts are taken away, each once."""
    key, gone = (pairs[:, 0] * n_bodies + pairs[:, 1] for pairs in (bodies, taken))
    found, counts = np.unique(key, return_counts=True)
    less, fewer = np.unique(gone, return_counts=True)
    counts[np.searchsorted(found, less)] -= fewer
    left = found[counts > 0]
    return np.stack([left // n_bodies, left % n_bodies], axis=1)


def both_fixed(model: Model, bodies: IntArray) -> BoolArray:
    """True where neither body of a pair can move but as a settling support, (n,).

    Supports do not rub on each other: a footing that sinks next to another would lock against it by dilatancy alone.
    """
    still = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])
    return np.asarray(still[bodies[:, 0]] & still[bodies[:, 1]])


def _slivers(model: Model, slivers: Patches) -> tuple[IntArray, FloatArray]:
    """Bodies and widths, those between fixed bodies left out, sorted by bodies and width."""
    slivers = slivers.take(~both_fixed(model, slivers.overlays.bodies))
    bodies = slivers.overlays.bodies
    order = np.lexsort((slivers.widths, bodies[:, 1], bodies[:, 0]))
    return bodies[order], slivers.widths[order]


def _near_misses(model: Model, misses: Patches, overlaps: Overlaps) -> tuple[IntArray, FloatArray]:
    """Pairs of bodies with the least gap of each, sorted; pairs that overlap anyway and fixed bodies left out."""
    bodies, n_bodies = misses.overlays.bodies, len(model.fixed) + len(model.grounds)
    key, known = (pairs[:, 0] * n_bodies + pairs[:, 1] for pairs in (bodies, overlaps.pairs))
    rows = np.flatnonzero(~np.isin(key, known) & ~both_fixed(model, bodies))
    rows = rows[np.lexsort((np.abs(misses.gaps[rows]), key[rows]))]
    rows = rows[np.unique(key[rows], return_index=True)[1]]
    return bodies[rows], misses.gaps[rows]


def held_blocks(model: Model) -> BoolArray:
    """Blocks that a support holds, wholly or in some of their ways, (n_blocks,)."""
    held = model.fixed.copy()
    held[model.guides.blocks] = True
    return held


def unsupported_parts(fixed: BoolArray, bodies: IntArray) -> tuple[IntArray, ...]:
    """Connected parts of free blocks without contact to a fixed block or the ground, each sorted.

    fixed  : (n_blocks,)
    bodies : (n, 2) bodies in contact; those from n_blocks on are ground
    """
    n_blocks = len(fixed)
    support = np.ones(max(n_blocks, int(bodies.max(initial=-1)) + 1), dtype=bool)
    support[:n_blocks] = fixed
    # Supports do not hang together with each other through their contacts: links between free blocks only.
    free_links = bodies[~support[bodies].any(axis=1)]
    part = connected_labels(free_links, n_blocks)
    held = np.zeros(n_blocks, dtype=bool)  # by part
    a, b = bodies.T
    held[part[a[support[b] & ~support[a]]]] = True
    held[part[b[support[a] & ~support[b]]]] = True
    blocks = np.flatnonzero(~fixed & ~held[part])
    order = blocks[np.argsort(part[blocks], kind="stable")]
    if not len(order):
        return ()
    cuts = np.flatnonzero(np.diff(part[order])) + 1
    return tuple(sorted(np.split(order, cuts), key=lambda found: int(found[0])))


WIDEST = 0.1
"""Gap relative to block size up to which faces nearly touch where blocks reach no support: the greatest tolerance."""


def misses_within(model: Model, facets: Facets, tolerance: float, overlap: float) -> Patches | None:
    """Near misses with gaps up to ``WIDEST``; None where those of the search reach as far."""
    if NEAR_MISS * tolerance >= WIDEST:
        return None
    patches = find_patches(model.blocks, facets, model.grounds, WIDEST / NEAR_MISS)
    found = judge(patches, tolerance, WIDEST, overlap).near_misses
    # what is narrower than its gap would be no contact if the gap were none
    return found.take((found.widths >= np.abs(found.gaps)) & (np.abs(found.gaps) <= WIDEST))
