"""The contact report in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import ContactReport
from mbla.contacts.glue import Glue
from mbla.contacts.narrow_phase import Patches
from mbla.contacts.outlines.corners import Corners
from mbla.contacts.outlines.polygons import areas
from mbla.contacts.report import WIDEST, Findings
from mbla.contacts.third_block import SeparatedPairs
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.model.wording import counted, named

# So many are named in a notice; the arrays of the report have all.
_NAMED = 3


def report_notices(
    model: Model, section: ContactsSection, report: ContactReport, findings: Findings
) -> tuple[Notice, ...]:
    """What the report and the findings it was made of have to say."""
    bodies = findings.contacts.overlays.bodies
    return (
        *_isolated(model, section, report),
        *_unsupported(model, report),
        *_overlaps(model, report),
        *_near_misses(model, section, report),
        *_slivers(model, section, report),
        *_grounds(model, section, bodies),
        *_fixed_contacts(report),
        *_separated_pairs(model, findings.separated),
        *_glue(report, findings.glue),
    )


def _glue(report: ContactReport, glue: Glue) -> list[Notice]:
    """What open and glued joints left out, and what glue made of the blocks."""
    found = []
    if report.open_interfaces:
        text = f"{counted(report.open_interfaces, 'interface')} with open joints left out: no contact"
        found.append(Notice("notice", "open-interfaces-left-out", text))
    if len(report.glued):
        text = f"{counted(len(report.glued), 'internal interface')} (glued) left out: {glue_words(report, glue.sizes)}"
        found.append(Notice("notice", "blocks-glued", text))
    return found


def _separated_pairs(model: Model, held: SeparatedPairs) -> list[Notice]:
    """Faces within the tolerance of each other that are no contacts, for a third block lies between."""
    if not len(held):
        return []
    overlays = held.patches.overlays
    gaps = held.patches.mid_gaps
    row = int(np.argmax(gaps * overlays.sizes))
    pair = overlays.bodies[row]
    text = (
        f"{counted(len(held), 'common surface')} within the tolerance left out, because a thin block lies between: "
        f"{_pair(model, pair)} stand {_length(model, pair.tolist(), float(gaps[row]))} apart on "
        f"{model.body_name(int(held.between[row]))}{', and others' if len(held) > 1 else ''}"
    )
    return [Notice("notice", "thin-block-between", text)]


def glue_words(report: ContactReport, sizes: IntArray) -> str:
    """What glue made of the blocks; sizes (n,) of the solids of several blocks."""
    parts = []
    if len(sizes):
        parts.append(f"{counted(int(sizes.sum()), 'block')} make {counted(len(sizes), 'rigid body')}")
    if len(report.held):
        one = len(report.held) == 1
        held = f"{counted(len(report.held), 'block')} glued to a support {'does' if one else 'do'} not move"
        parts.append(held)
    return ", ".join(parts) or "none of the blocks moved without"


def overlap_messages(model: Model, report: ContactReport) -> tuple[str, ...]:
    """One sentence for each pair of blocks that overlap: names, depth, remedy; the deck is wrong if there is any."""
    return tuple(
        f"{_pair(model, pair)} overlap by {_length(model, pair.tolist(), depth)}: move them apart, leave one out"
        f"{_by_tolerance(depth, ', or set contacts.tolerance above {:.2g} if they are meant to touch')}"
        for pair, depth in zip(report.overlaps, report.overlap_depths.tolist(), strict=True)
    )


def _overlaps(model: Model, report: ContactReport) -> list[Notice]:
    found = [Notice("warning", "blocks-overlap", text) for text in overlap_messages(model, report)]
    if len(report.unchecked):
        text = (
            f"{counted(len(report.unchecked), 'pair')} of blocks not checked for overlap, because the faces of one do "
            f"not form a closed solid: {_pairs(model, report.unchecked)}"
        )
        found.append(Notice("warning", "overlap-not-checked", text))
    return found


def _near_misses(model: Model, section: ContactsSection, report: ContactReport) -> list[Notice]:
    if not len(report.near_misses):
        return []
    gaps = report.near_miss_gaps
    order = np.argsort(np.abs(gaps), kind="stable")
    named = ", ".join(
        f"{_pair(model, report.near_misses[row])} ({_length(model, report.near_misses[row].tolist(), gaps[row])})"
        for row in order[:_NAMED]
    )
    text = (
        f"{counted(len(gaps), 'near miss')}, opposite faces that miss each other by more than the "
        f"tolerance of {section.tolerance:g}: {named}{_more(len(gaps))}; they are no contacts"
        f"{_by_tolerance(float(np.abs(gaps).max()), ', with contacts.tolerance above {:.2g} all of them are')}"
    )
    return [Notice("warning", "near-misses", text)]


def _slivers(model: Model, section: ContactsSection, report: ContactReport) -> list[Notice]:
    if not len(report.slivers):
        return []
    widest = int(np.argmax(report.sliver_widths))
    pair, width = report.slivers[widest], float(report.sliver_widths[widest])
    text = (
        f"{counted(len(report.slivers), 'common surface')} narrower than the tolerance of {section.tolerance:g} "
        f"dropped; the widest, between {_pair(model, pair)}, measures {_length(model, pair.tolist(), width)}"
    )
    return [Notice("notice", "slivers-dropped", text)]


def _isolated(model: Model, section: ContactsSection, report: ContactReport) -> list[Notice]:
    number = len(report.isolated)
    if not number:
        return []
    verb = "touches nothing" if number == 1 else "touch nothing"
    text = f"{number} of {counted(len(model.blocks), 'block')} {verb}: {named(report.isolated, model.blocks.name)}"
    if section.isolated == "allow":
        return [Notice("notice", "isolated-blocks", text)]
    return [Notice("warning", "isolated-blocks", f"{text}; exit status 4, unless contacts.isolated is allow")]


def _unsupported(model: Model, report: ContactReport) -> list[Notice]:
    parts = [part for part in report.unsupported if len(part) > 1]  # one alone is an isolated block
    if not parts:
        return []
    text = (
        f"{counted(len(parts), 'part')} of the structure not connected to a support; the "
        f"{'largest' if len(parts) > 1 else 'part'} has "
        f"{counted(max(len(part) for part in parts), 'block')}: {named(max(parts, key=len), model.blocks.name)}"
    )
    return [Notice("warning", "unsupported-parts", text)]


def _grounds(model: Model, section: ContactsSection, bodies: IntArray) -> list[Notice]:
    """Ground planes that carry nothing, and blocks that lie partly below one."""
    found = []
    blocks = model.blocks
    for index, ground in enumerate(model.grounds):
        if not (bodies[:, 0] == len(blocks) + index).any():
            text = f"no face lies on {ground.label} within the tolerance: it carries nothing"
            found.append(Notice("warning", "ground-without-contact", text))
        if ground.blocks is not None:
            continue  # a ground for chosen blocks is an abutment, the rest of the structure may be behind its plane
        height = (blocks.vertices - ground.point) @ ground.normal
        first = blocks.vertex_start[:-1]
        low, high = np.minimum.reduceat(height, first), np.maximum.reduceat(height, first)
        limit = section.tolerance * blocks.sizes
        crossing = np.flatnonzero((low < -limit) & (high > limit))
        if len(crossing):
            which = named(crossing, model.blocks.name)
            text = f"{counted(len(crossing), 'block')} on both sides of {ground.label}: {which}"
            found.append(Notice("warning", "block-crosses-ground", text))
    return found


def _fixed_contacts(report: ContactReport) -> list[Notice]:
    if not report.fixed_contacts:
        return []
    text = f"{counted(report.fixed_contacts, 'contact')} between bodies that are both fixed left out"
    return [Notice("notice", "fixed-contacts-left-out", text)]


def _more(number: int) -> str:
    return f" and {number - _NAMED} more" if number > _NAMED else ""


def _pair(model: Model, pair: IntArray) -> str:
    return f"{model.body_name(int(pair[0]))} and {model.body_name(int(pair[1]))}"


def _pairs(model: Model, pairs: IntArray) -> str:
    return ", ".join(_pair(model, pair) for pair in pairs[:_NAMED]) + _more(len(pairs))


def _length(model: Model, pair: Sequence[int], relative: float) -> str:
    """``0.012 m, 0.03 of the block size``: a length relative to the block size of a pair."""
    sizes = model.blocks.sizes
    size = min(sizes[body] for body in pair if body < len(sizes))
    return f"{relative * size:.3g} {model.units.length}, {relative:.2g} of the block size"


def _by_tolerance(relative: float, text: str) -> str:
    """The text with the tolerance that would do, or nothing where no allowed tolerance would."""
    rounded = float(f"{relative * 1.05:.1e}")
    return text.format(rounded) if rounded < WIDEST else ""


SEEN = 1e-4
"""Share of its area, taken off or added, from which on an outline is called simpler than the surface: the edges about
which blocks turn move by about that share of their distance, and the load factor by rocking with them."""


def outline_notices(
    model: Model, section: ContactsSection, patches: Patches, corners: Corners, drawn: FloatArray
) -> list[Notice]:
    """A notice where corners that were left out change the area of a common surface, or nothing.

    patches : with the outlines as they were cut
    corners : those that stay
    drawn   : (n_patches,) area within these, relative like the outlines
    """
    changes = np.abs(drawn / areas(patches.polygons) - 1.0)
    simpler = int((changes > SEEN).sum())
    if not simpler:
        return []
    most = int(np.argmax(changes))
    first, second = (model.body_name(int(body)) for body in patches.overlays.bodies[most])
    stay = int((corners.polygon_of_corner == most).sum())
    text = (
        f"corners within the tolerance of {section.tolerance:g} of the outline are left out, which changes the area of "
        f"{simpler} common surface{'' if simpler == 1 else 's'}, most that of {first} and {second}, drawn by {stay} "
        f"corners, by {100 * changes[most]:.2g} %: a smaller contacts.tolerance keeps more of them"
    )
    return [Notice("notice", "outlines-simplified", text)]
