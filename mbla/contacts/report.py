"""The report on the search for contacts: what was dropped, missed or found wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.connectivity import isolated_blocks, unsupported_parts
from mbla.contacts.contacts import ContactReport
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.notices import report_notices
from mbla.contacts.overlaps import Overlaps
from mbla.deck.types import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model


@dataclass(frozen=True)
class Findings:
    """What the search found: all contacts, those between fixed bodies included, and what is not a contact."""

    contacts: Patches
    slivers: Patches
    near_misses: Patches
    overlaps: Overlaps


def build_report(model: Model, section: ContactsSection, findings: Findings, notices: list[Notice]) -> ContactReport:
    """Report with the given notices and those on the findings."""
    overlaps, bodies = findings.overlaps, findings.contacts.overlays.bodies
    slivers, widths = _slivers(model, findings.slivers)
    near_misses, gaps = _near_misses(model, findings.near_misses, overlaps)
    held = model.fixed.copy()
    held[model.guides.blocks] = True
    report = ContactReport(
        slivers=slivers,
        sliver_widths=widths,
        near_misses=near_misses,
        near_miss_gaps=gaps,
        overlaps=overlaps.pairs,
        overlap_depths=overlaps.depths,
        unchecked=overlaps.unchecked,
        isolated=isolated_blocks(len(model.blocks), bodies),
        unsupported=unsupported_parts(held, bodies),
        fixed_contacts=int(both_fixed(model, bodies).sum()),
        notices=(),
    )
    return report.with_notices((*notices, *report_notices(model, section, report, bodies)))


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
