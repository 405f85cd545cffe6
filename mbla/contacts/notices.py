"""The contact report in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import ContactReport
from mbla.contacts.faces.narrow_phase import Patches
from mbla.contacts.glue import solid_sizes
from mbla.contacts.overlaps import MOST_OVERLAPS
from mbla.contacts.report import WIDEST, Findings
from mbla.contacts.soil import soil_notices
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.model.soil.names import counted_with_soil, named_with_soil
from mbla.model.solids.ragged import row_maxima
from mbla.model.wording import counted, named


def report_notices(
    model: Model, section: ContactsSection, report: ContactReport, findings: Findings
) -> tuple[Notice, ...]:
    """Notices on the report and the findings behind it."""
    bodies = findings.contacts.overlays.bodies
    return (
        *_loose(model, section, report),
        *(Notice("warning", "blocks-overlap", text) for text in overlap_messages(model, report)),
        *_accepted(model, findings),
        *_missed(model, section, report),
        *soil_notices(model, section.tolerance),
        *_grounds(model, section, bodies),
        *_left_out(model, report, findings),
    )


def _loose(model: Model, section: ContactsSection, report: ContactReport) -> Iterator[Notice]:
    """Blocks that touch nothing, and parts that reach no support."""
    if number := len(report.isolated):
        text = f"{number} of {len(model.blocks)} blocks touch nothing: {named(report.isolated, model.blocks.name)}"
        if section.isolated == "allow":
            yield Notice("notice", "isolated-blocks", text)
        else:
            yield Notice("warning", "isolated-blocks", f"{text}; exit status 4, unless contacts.isolated is allow")
    if parts := [part for part in report.unsupported if len(part) > 1]:  # one alone is an isolated block
        largest = max(parts, key=len)
        text = (
            f"{counted(len(parts), 'part')} of the structure not connected to a support, the largest of "
            f"{counted_with_soil(largest, model.blocks)}: {named_with_soil(largest, model.blocks)}"
        )
        yield Notice("warning", "unsupported-parts", text)


def overlap_messages(model: Model, report: ContactReport) -> tuple[str, ...]:
    """One sentence for all pairs of blocks that overlap, none without: any makes the deck invalid.

    How many, which most and by how much, and the tolerance at which all are accepted.
    """
    if not (number := len(report.overlaps)):
        return ()
    most = _deepest(model, report.overlaps, report.overlap_depths)
    which, far = _pair(model, report.overlaps[most]), _length(model, report.overlaps[most], report.overlap_depths[most])
    many = f"more than {MOST_OVERLAPS}" if number > MOST_OVERLAPS else f"{number}"
    text = f"{which} overlap by {far}" if number == 1 else f"{many} pairs of blocks overlap, {which} most, by {far}"
    text += ": move them apart, leave one out"
    if number > MOST_OVERLAPS or report.overlap_swallows.any():
        return (text,)
    accepted = ", or set contacts.overlap_tolerance above {:.2g} if they are meant to touch"
    if number > 1:
        accepted += f", which accepts all {number}"
    return (text + _by_tolerance(float(report.overlap_depths.max()), accepted),)


def _deepest(model: Model, pairs: IntArray, relative: FloatArray) -> int:
    """The first of the pairs of blocks (n, 2) that reach deepest into each other, up to rounding."""
    depths = relative * model.blocks.sizes[pairs].min(axis=1)
    return int(np.argmax(depths >= (1 - 1e-9) * depths.max()))


def _accepted(model: Model, findings: Findings) -> Iterator[Notice]:
    """Overlaps within the tolerance: how much counts twice."""
    overlaps, volume = findings.overlaps, float(model.blocks.volumes.sum())
    if number := len(overlaps.accepted):
        most = _deepest(model, overlaps.accepted, overlaps.accepted_depths)
        common = float(overlaps.common.sum())
        text = (
            f"{counted(number, 'pair')} of blocks with overlaps within the tolerance, most "
            f"{_measured(model, overlaps.accepted[most], overlaps.accepted_depths[most])}; contacts lie "
            f"midway, and the {common:.3g} {model.units.length}3 that they share, {100 * common / volume:.2g} % of the "
            "volume of all blocks, counts in the weight of both"
        )
        yield Notice("notice", "overlaps-accepted", text)


def _missed(model: Model, section: ContactsSection, report: ContactReport) -> Iterator[Notice]:
    """What could not be judged, and faces that nearly touch, or touch over slivers only."""
    if number := len(report.unchecked):
        text = (
            f"{counted(number, 'pair')} of blocks not checked for overlap, because the faces of one do not form a "
            f"closed solid: {_pair(model, report.unchecked[0])}{_more(number)}"
        )
        yield Notice("warning", "overlap-not-checked", text)
    if number := len(report.near_misses):
        gaps = np.abs(report.near_miss_gaps)
        sizes = np.append(model.blocks.sizes, np.full(len(model.grounds), np.inf))[report.near_misses].min(axis=1)
        least, most = int(np.argmin(gaps)), int(np.argmax(gaps * sizes))
        second = "" if number == 1 else f", the widest {_measured_at(model, report, most)}"
        text = (
            f"{counted(number, 'near miss')}, opposite faces that miss each other by more than the tolerance of "
            f"{section.tolerance:g}: {_measured_at(model, report, least)}{_more(number)}{second}; they are no contacts"
            f"{_closing(section, report.near_miss_gaps)}"
        )
        yield Notice("warning", "near-misses", text)
    if number := len(report.slivers):
        widest = int(np.argmax(report.sliver_widths))
        text = (
            f"{counted(number, 'common surface')} narrower than the tolerance of {section.tolerance:g} dropped: "
            f"{_measured(model, report.slivers[widest], report.sliver_widths[widest])}{_more(number)}"
        )
        yield Notice("notice", "slivers-dropped", text)


def _closing(section: ContactsSection, gaps: FloatArray) -> str:
    """The tolerances at which near misses (n,), negative where faces overlap, are contacts; nothing where none does."""
    depth, gap = float(-gaps.min(initial=0.0)), float(gaps.max(initial=0.0))
    if section.overlap_tolerance is None and gap:  # one tolerance does both
        depth, gap = 0.0, max(depth, gap)
    keys = {"contacts.tolerance": gap, "contacts.overlap_tolerance": depth}
    parts = [_by_tolerance(value, f"{key} above {{:.2g}}") for key, value in keys.items() if value]
    if not all(parts):
        return ""
    real = ", and so is every real gap of the file up to that" if gap else ""
    return f", with {' and '.join(parts)} all of them are{real}"


def _measured_at(model: Model, report: ContactReport, row: int) -> str:
    return _measured(model, report.near_misses[row], report.near_miss_gaps[row])


def _grounds(model: Model, section: ContactsSection, bodies: IntArray) -> Iterator[Notice]:
    """Ground planes that carry nothing, and blocks that lie partly below one."""
    blocks = model.blocks
    for index, ground in enumerate(model.grounds):
        if not (bodies[:, 0] == len(blocks) + index).any():
            text = f"no face lies on {ground.label} within the tolerance: it carries nothing"
            yield Notice("warning", "ground-without-contact", text)
        if ground.blocks is not None or ground.outline is not None:
            continue  # a ground for chosen blocks is an abutment, the rest of the structure may be behind its plane
        height = (blocks.vertices - ground.point) @ ground.normal
        depths, heights = (row_maxima(sign * height, blocks.vertex_start) for sign in (-1.0, 1.0))
        crossing = np.flatnonzero(
            np.minimum(depths, heights) > max(section.tolerance, section.depth_allowed) * blocks.sizes
        )
        if len(crossing):
            which = named(crossing, model.blocks.name)
            text = f"{counted(len(crossing), 'block')} on both sides of {ground.label}: {which}"
            yield Notice("warning", "block-crosses-ground", text)


def _left_out(model: Model, report: ContactReport, findings: Findings) -> Iterator[Notice]:
    """Interfaces between what does not move, across a thin block, open ones, and those inside of rigid bodies."""
    if report.fixed_contacts:
        text = f"{counted(report.fixed_contacts, 'contact')} between bodies that are both fixed left out"
        yield Notice("notice", "fixed-contacts-left-out", text)
    if number := len(held := findings.separated):
        gaps, overlays = held.patches.mid_gaps, held.patches.overlays
        row = int(np.argmax(gaps * overlays.sizes))
        text = (
            f"{counted(number, 'common surface')} within the tolerance left out, because a thin block lies between: "
            f"{_measured(model, overlays.bodies[row], gaps[row])} on {model.body_name(int(held.between[row]))}"
            f"{_more(number)}"
        )
        yield Notice("notice", "thin-block-between", text)
    if report.open_interfaces:
        text = f"{counted(report.open_interfaces, 'interface')} with open joints left out: no contact"
        yield Notice("notice", "open-interfaces-left-out", text)
    if number := len(report.glued):
        words = glue_words(report, solid_sizes(findings.glue.solid_of_block))
        text = f"{counted(number, 'internal interface')} (glued) left out: {words}"
        yield Notice("notice", "blocks-glued", text)


def glue_words(report: ContactReport, sizes: IntArray) -> str:
    """Rigid bodies formed by glue; sizes (n,) of the solids of several blocks."""
    parts = []
    if len(sizes):
        parts.append(f"{counted(int(sizes.sum()), 'block')} make {counted(len(sizes), 'rigid body')}")
    if number := len(report.held):
        parts.append(f"{counted(number, 'block')} glued to a support {'does' if number == 1 else 'do'} not move")
    return ", ".join(parts) or "none of the blocks moved without"


def _more(number: int) -> str:
    """Behind the one that is named."""
    return f" and {number - 1} more" if number > 1 else ""


def _measured(model: Model, pair: IntArray, relative: float) -> str:
    return f"{_pair(model, pair)} ({_length(model, pair, relative)})"


def _pair(model: Model, pair: IntArray) -> str:
    return f"{model.body_name(int(pair[0]))} and {model.body_name(int(pair[1]))}"


def _length(model: Model, pair: IntArray, relative: float) -> str:
    """``0.012 m, 0.03 of the block size``: a length relative to the block size of a pair."""
    size = model.blocks.sizes[pair[pair < len(model.blocks)]].min()
    return f"{relative * size:.3g} {model.units.length}, {relative:.2g} of the block size"


def _by_tolerance(relative: float, text: str) -> str:
    """The text with the tolerance that would suffice, or nothing where no allowed tolerance would."""
    rounded = float(f"{relative * 1.05:.1e}")
    return text.format(rounded) if rounded < WIDEST else ""


SEEN = 1e-4
"""Share of its area, taken off or added, from which on an outline is called simpler than the surface: the edges about
which blocks turn move by about that share of their distance, and the load factor by rocking with them."""


def outline_notices(model: Model, section: ContactsSection, patches: Patches, drawn: FloatArray) -> Iterator[Notice]:
    """A notice where corners that were left out change the area of a common surface.

    patches : with the outlines as they were cut
    drawn   : (n_patches,) area within the corners that stay, relative like the outlines
    """
    changes = np.abs(drawn / shapely.area(patches.polygons) - 1.0)
    if simpler := int((changes > SEEN).sum()):
        most = int(np.argmax(changes))
        text = (
            f"corners within the tolerance of {section.tolerance:g} of the outline are left out, which changes the "
            f"area of {counted(simpler, 'common surface')}, most that of {_pair(model, patches.overlays.bodies[most])} "
            f"by {100 * changes[most]:.2g} %: a smaller contacts.tolerance keeps more of them"
        )
        yield Notice("notice", "outlines-simplified", text)
