"""The report on the search for contacts: what was dropped, missed or found wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.between import HeldApart
from mbla.contacts.connectivity import held_blocks, isolated_blocks, unsupported_parts
from mbla.contacts.contacts import ContactReport
from mbla.contacts.glue import Glue
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.notices import glue_notices, held_apart_notices, report_notices
from mbla.contacts.overlaps import Overlaps
from mbla.deck.types import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model


@dataclass(frozen=True)
class Findings:
    """What the search found: all contacts, those between fixed bodies included, and what is not a contact.

    open_bodies      : (n, 2) bodies of the contacts whose joint law is open
    glued_bodies     : (n, 2) bodies of the contacts inside of rigid bodies
    """

    contacts: Patches
    slivers: Patches
    near_misses: Patches
    overlaps: Overlaps
    held_apart: HeldApart
    open_bodies: IntArray
    glued_bodies: IntArray
    glue: Glue


def build_report(model: Model, section: ContactsSection, findings: Findings, notices: list[Notice]) -> ContactReport:
    """Report with the given notices and those on the findings."""
    overlaps, touching = findings.overlaps, findings.contacts.overlays.bodies
    bodies = _without(touching, findings.open_bodies, len(model.blocks) + len(model.grounds))
    slivers, widths = _slivers(model, findings.slivers)
    near_misses, gaps = _near_misses(model, findings.near_misses, overlaps)
    report = ContactReport(
        slivers=slivers,
        sliver_widths=widths,
        near_misses=near_misses,
        near_miss_gaps=gaps,
        overlaps=overlaps.pairs,
        overlap_depths=overlaps.depths,
        unchecked=overlaps.unchecked,
        isolated=isolated_blocks(len(model.blocks), bodies),
        unsupported=unsupported_parts(held_blocks(model), bodies),
        fixed_contacts=int(both_fixed(model, touching).sum()),
        open_interfaces=len(findings.open_bodies),
        glued=findings.glued_bodies,
        held=np.flatnonzero(findings.glue.held),
        notices=(),
    )
    return report.with_notices(
        (
            *notices,
            *report_notices(model, section, report, touching),
            *held_apart_notices(model, findings.held_apart),
            *glue_notices(report, findings.glue),
        )
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
    """True where neither body of a pair can move but as a support that gives way, (n,).

    Supports do not rub on each other: a footing that sinks beside another would lock against it by dilatancy alone.
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
    bodies = misses.overlays.bodies
    n_bodies = len(model.fixed) + len(model.grounds)
    key = bodies[:, 0] * n_bodies + bodies[:, 1]
    known = np.isin(key, overlaps.pairs[:, 0] * n_bodies + overlaps.pairs[:, 1])
    rows = np.flatnonzero(~known & ~both_fixed(model, bodies))
    rows = rows[np.lexsort((np.abs(misses.gaps[rows]), key[rows]))]
    _, least = np.unique(key[rows], return_index=True)
    rows = rows[least]
    rows = rows[np.lexsort((bodies[rows, 1], bodies[rows, 0]))]
    return bodies[rows], misses.gaps[rows]
