"""Contacts in words: interfaces by joint law, and what the search found besides."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.contacts.glue import solid_sizes
from mbla.contacts.notices import glue_words
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import in_soil
from mbla.results.listing.blocks import MOST_ROWS, Block, Fact, ListingSection, Paragraph, apart, facts, table_of
from mbla.results.listing.places import block_words, counted_of
from mbla.results.listing.text import counted, number, small

MOST_NAMED = 5
"""blocks named in a line"""


def contact_section(model: Model, contacts: Contacts) -> ListingSection:
    """Interfaces, points and areas by joint law, and the findings of the search as counts."""
    return ListingSection("Contacts", [*_by_joint(model, contacts), *apart(facts(_counts(model, contacts)))])


def finding_sections(model: Model, report: ContactReport) -> list[ListingSection]:
    """What the search saw besides contacts, pair by pair and part by part; nothing where there is nothing."""
    closest = np.argsort(np.abs(report.near_miss_gaps), kind="stable")
    misses, gaps = report.near_misses[closest], report.near_miss_gaps[closest]
    near = _pair_table(model, "Near misses", "gap", misses, gaps)
    widest = np.argsort(-report.sliver_widths, kind="stable")
    slivers = _pair_table(model, "Slivers dropped", "width", report.slivers[widest], report.sliver_widths[widest])
    unchecked = _pair_table(model, "Not checked for overlap", "", report.unchecked, None)
    blocks = [*near, *slivers, *unchecked]
    if len(report.isolated):
        blocks.append(Paragraph(f"Blocks without any contact: {_names(model, report.isolated, MOST_ROWS)}."))
    for part in report.unsupported[:MOST_ROWS]:
        blocks.append(Paragraph(f"Unsupported: {counted_of(model, part)}, {_names(model, part, MOST_NAMED)}."))
    return [ListingSection("Found by the search", blocks)] if blocks else []


def _by_joint(model: Model, contacts: Contacts) -> list[Block]:
    points = np.diff(contacts.point_start)
    rows = []
    for row, name in enumerate(contacts.joint_names):
        chosen = contacts.joints == row
        area = number(float(contacts.areas[chosen].sum()))
        rows.append([name, str(int(chosen.sum())), str(int(points[chosen].sum())), area])
    rows.append(["total", str(len(contacts)), str(len(contacts.points)), number(float(contacts.areas.sum()))])
    return table_of(["joint law", "interfaces", "points", f"area [{model.units.length}2]"], rows)


def _counts(model: Model, contacts: Contacts) -> list[Fact]:
    """Every count, zero or not: that nothing was missed is a finding too."""
    report, length = contacts.report, model.units.length
    on_ground = (contacts.bodies >= len(model.blocks)).any(axis=1)
    soil = in_soil(model, contacts)
    rows = [Fact("interfaces between blocks", str(int((~on_ground & ~soil).sum())))]
    rows += [Fact("interfaces of cells of soil", str(int((~on_ground & soil).sum())))] if model.soils else []
    rows.append(Fact("interfaces on ground", str(int(on_ground.sum()))))
    if len(contacts):
        least, most = number(float(contacts.areas.min())), number(float(contacts.areas.max()))
        rows.append(Fact("least, greatest area", f"{least}, {most} {length}2"))
        widest = float(np.abs(contacts.gaps).max())
        if widest > 1e-9 * float(model.blocks.sizes.max()):
            rows.append(Fact("greatest gap or overlap", f"{small(widest)} {length}"))
    unsupported = sum(len(part) for part in report.unsupported)
    parts = f", {counted(len(report.unsupported), 'part')}" if unsupported else ""
    glued = f": {glue_words(report, solid_sizes(contacts.solid_of_block))}" if len(report.glued) else ""
    counts = (
        ("near misses", len(report.near_misses), ""),
        ("slivers dropped", len(report.slivers), ""),
        ("overlapping blocks", len(report.overlaps), ""),
        ("not checked for overlap", len(report.unchecked), ""),
        ("blocks without contact", len(report.isolated), ""),
        ("unsupported blocks", unsupported, parts),
        ("between fixed bodies (ignored)", report.fixed_contacts, ""),
        ("open joints (ignored)", report.open_interfaces, ""),
        ("internal interfaces (glued)", len(report.glued), glued),
    )
    return [*rows, *(Fact(name, f"{count or 'none'}{rest}") for name, count, rest in counts)]


def _pair_table(model: Model, title: str, measure: str, pairs: IntArray, relative: FloatArray | None) -> list[Block]:
    """Pairs of bodies with a length each; the first of them only where there are many."""
    if not len(pairs):
        return []
    shown = pairs[:MOST_ROWS]
    rows = [_pair_row(model, pair, None if relative is None else float(relative[i])) for i, pair in enumerate(shown)]
    head = ["bodies", *([f"{measure} [{model.units.length}]", "over block size"] if measure else [])]
    return table_of(head, rows, caption=title, total=len(pairs))


def _pair_row(model: Model, pair: IntArray, relative: float | None) -> list[str]:
    names = "/".join(model.body_name(body) for body in pair.tolist())
    if relative is None:
        return [names]
    size = min(float(model.blocks.sizes[body]) for body in pair.tolist() if body < len(model.blocks))
    return [names, f"{relative * size:.3g}", f"{relative:.2g}"]


def _names(model: Model, blocks: Iterable[int] | IntArray, most: int) -> str:
    chosen = [int(block) for block in blocks]
    more = f" and {len(chosen) - most} more" if len(chosen) > most else ""
    return ", ".join(block_words(model, block) for block in chosen[:most]) + more
