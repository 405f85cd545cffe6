"""What is said before anything is solved: the model, its contacts, settings, reductions; all of ``mbla check``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mbla import __version__
from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.contacts.glue import solid_sizes
from mbla.contacts.notices import glue_words
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.program.reductions.steps import ReductionStep, StepState
from mbla.results.listing.places import label_words
from mbla.results.listing.text import (
    MOST_ROWS,
    WIDTH,
    counted,
    entry,
    heading,
    long_table,
    number,
    sentence,
    small,
    table,
)
from mbla.results.listing.tie_words import tie_lines, tie_title
from mbla.results.provenance import CaseNeeds
from mbla.results.results import Results

ROUNDING = 1e-9
"""share of the added mass of a block that is none beside its fill"""


def check_listing(results: Results, needs: Mapping[str, CaseNeeds]) -> str:
    """What ``mbla check`` prints: the model and its contacts as in the listing, and what each load case needs."""
    lines = [
        *header_lines(results),
        *settings_lines(results),
        *model_lines(results.model),
        *contact_lines(results.model, results.contacts),
        *finding_lines(results.model, results.contacts.report),
        *notice_lines(results.notices),
        *(line for case, own in needs.items() for line in _needs(case, own)),
    ]
    lines += sentence("Nothing was solved.")
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _needs(case: str, needs: CaseNeeds) -> list[str]:
    lines = heading(f"Needed for load case {case}")
    lines += [line for name, count in needs.counts.items() for line in entry(name.replace("_", " "), str(count))]
    return lines + spaced(reduction_lines(needs.reductions))


def header_lines(results: Results) -> list[str]:
    """Program, deck and date."""
    version = results.provenance.get("mbla", __version__)
    deck = results.deck
    lines = [f"mbla {version}   limit analysis of masonry as rigid blocks", "=" * WIDTH]
    lines += sentence(results.model.title, "") if results.model.title else []
    lines += entry("deck", deck.name)
    lines += [line for name, _ in deck.sources[1:] for line in entry("includes", name)]
    lines += [line for override in deck.overrides for line in entry("changed by the user", override)]
    lines += entry("deck hash (SHA-256)", deck.sha256)
    lines += entry("date", results.created)
    return lines


def settings_lines(results: Results) -> list[str]:
    """Units and the settings in effect."""
    units = results.model.units
    lines = heading("Units and analysis settings")
    lines += entry("units", f"{units.length}, {units.force}, {units.mass}, s; angles given as tan φ")
    return lines + [line for name, value in results.settings.items() for line in entry(name, value)]


def model_lines(model: Model) -> list[str]:
    """Blocks by group, joint laws, supports, loads of every case."""
    blocks, units = model.blocks, model.units
    lines = heading("Model")
    lines += entry("blocks", f"{len(blocks)}, of them {len(model.free)} free and {int(model.fixed.sum())} fixed")
    lines += _extents(model)
    lines += entry("volume", f"{number(float(blocks.volumes.sum()))} {units.length}3")
    lines += entry("weight (9.81 m/s2)", f"{number(model.total_weight)} {units.force}")
    others = blocks.added_masses if model.fill is None else blocks.added_masses - model.fill.masses
    added = int((others > ROUNDING * blocks.added_masses).sum())
    if added:
        mass = f"{number(float(others.sum()))} {units.mass} on {counted(added, 'block')}"
        lines += entry("added masses", f"{mass}; they count to the weights")
    if model.fill is not None:
        counts = "its mass moves with the blocks under it and counts to their weights"
        lines += [line for words in model.fill.words for line in entry("fill", f"{words}; {counts}")]
    lines += ["", *_group_table(model), *_labels(model), "", *_joint_table(model)]
    lines += heading("Supports") + _supports(model)
    if ties := tie_lines(model):
        lines += heading(tie_title(model)) + ties
    lines += heading("Loads")
    for case in model.load_cases:
        lines += sentence(f"{case.name}")
        lines += [line for words in case.dead_words or ("none",) for line in entry("  dead load", words)]
        lines += [line for words in case.live_words for line in entry(f"  {case.question.applied}", words)]
    return lines


def _extents(model: Model) -> list[str]:
    """The box around the model and the sizes of its blocks: a wrong unit or scale shows here."""
    blocks, length = model.blocks, model.units.length
    least, greatest = blocks.vertices.min(axis=0), blocks.vertices.max(axis=0)
    spans = [f"{axis} {a:.4g} .. {b:.4g}" for axis, a, b in zip("xyz", least + 0.0, greatest + 0.0, strict=True)]
    sizes = f"{number(blocks.sizes.min())} .. {number(blocks.sizes.max())} {length}, cube roots of the volumes"
    return entry("extents", f"{', '.join(spans)} {length}") + entry("block sizes", sizes)


def _group_table(model: Model) -> list[str]:
    blocks, units, weights = model.blocks, model.units, model.weights
    rows = []
    for name, chosen in _blocks_of_groups(model).items():
        least, most = blocks.densities[chosen].min(), blocks.densities[chosen].max()
        rows.append(
            [
                name,
                str(len(chosen)),
                str(int(model.fixed[chosen].sum())),
                number(float(blocks.volumes[chosen].sum())),
                number(float(weights[chosen].sum())),
                number(least) if least == most else f"{number(least)} .. {number(most)}",
            ]
        )
    volume, weight = f"volume [{units.length}3]", f"weight [{units.force}]"
    return table(["group", "blocks", "fixed", volume, weight, f"density [{units.mass}/{units.length}3]"], rows)


def _labels(model: Model) -> list[str]:
    """What selectors can say within each group."""
    lines = []
    for name, chosen in _blocks_of_groups(model).items():
        if words := label_words(model.blocks.labels, chosen):
            lines += sentence(f"{name}: {words}")
    return ["", *lines] if lines else []


def _blocks_of_groups(model: Model) -> dict[str, IntArray]:
    """Blocks of every group, groups in the order in which they appear."""
    names, first, rows = np.unique(np.array(model.blocks.groups), return_index=True, return_inverse=True)
    members = np.split(np.argsort(rows, kind="stable"), np.cumsum(np.bincount(rows))[:-1])
    return {str(names[i]): members[i] for i in np.argsort(first)}


def _joint_table(model: Model) -> list[str]:
    stress = f"[{model.units.force}/{model.units.length}2]"
    rows = [
        [
            joint.name,
            number(joint.friction),
            number(joint.cohesion),
            number(joint.tensile_strength),
            "unlimited" if np.isinf(joint.compressive_strength) else number(joint.compressive_strength),
            number(joint.dilatancy),
        ]
        for joint in model.joints.values()
    ]
    head = ["joint law", "friction", f"cohesion {stress}", f"tensile {stress}", f"compressive {stress}", "dilatancy"]
    return table(head, rows)


def _supports(model: Model) -> list[str]:
    lines = []
    for ground in model.grounds:
        only = "" if ground.blocks is None else f", under {counted(len(ground.blocks), 'block')} only"
        lines += sentence(f"rigid {ground.label} with joint law {ground.joint}{only}")
    for name, chosen in _blocks_of_groups(model).items():
        held = int(model.fixed[chosen].sum())
        if held:
            lines += sentence(f"{counted(held, 'block')} of group {name} fixed")
    lines += [line for words in model.guides.words for line in sentence(words)]
    return lines or sentence("none")


FOUND = {
    "glued": ("block", "in larger bodies or held"),
    "points": ("contact point", "left out"),
    "unloaded": ("block", "apart, without live load"),
    "parts": ("part", "solved apart"),
    "planar": ("part", "in its plane"),
    "mirror": ("part", "by one half"),
}
"""What a reduction counts, and what is done with it."""


def reduction_lines(steps: Sequence[ReductionStep]) -> list[str]:
    """A line for each reduction that found something, in the order in which they are applied."""
    lines = []
    for step in steps:
        if step.state is StepState.APPLIED:
            what, became = FOUND[step.name]
            left = f"{step.after.unknowns} of {step.before.unknowns} velocities left, {step.after.cones} cones"
            lines += entry(f"reduction, {step.name}", f"{counted(step.found, what)} {became}; {left}")
    return lines


def notice_lines(notices: Sequence[Notice]) -> list[str]:
    """Every notice and warning with its identifier; nothing where there is none."""
    if not notices:
        return []
    return heading("Remarks") + [line for notice in notices for line in sentence(str(notice))]


def spaced(lines: list[str]) -> list[str]:
    """Lines with an empty one before them; nothing where there are none."""
    return ["", *lines] if lines else []


MOST_NAMED = 5
"""blocks named in a line"""


def contact_lines(model: Model, contacts: Contacts) -> list[str]:
    """Interfaces, points and areas by joint law, and the findings of the search as counts."""
    return [*heading("Contacts"), *_by_joint(model, contacts), "", *_counts(model, contacts)]


def finding_lines(model: Model, report: ContactReport) -> list[str]:
    """What the search saw besides contacts, pair by pair and part by part; nothing where there is nothing."""
    closest = np.argsort(np.abs(report.near_miss_gaps), kind="stable")
    misses, gaps = report.near_misses[closest], report.near_miss_gaps[closest]
    near = _pair_table(model, "Near misses", "gap", misses, gaps)
    widest = np.argsort(-report.sliver_widths, kind="stable")
    slivers = _pair_table(model, "Slivers dropped", "width", report.slivers[widest], report.sliver_widths[widest])
    unchecked = _pair_table(model, "Not checked for overlap", "", report.unchecked, None)
    lines = [*near, *slivers, *unchecked]
    if len(report.isolated):
        lines += sentence(f"Blocks without any contact: {_names(model, report.isolated, MOST_ROWS)}.")
    for part in report.unsupported[:MOST_ROWS]:
        lines += sentence(f"Unsupported: {counted(len(part), 'block')}, {_names(model, part, MOST_NAMED)}.")
    return [*heading("Found by the search"), *lines] if lines else []


def _by_joint(model: Model, contacts: Contacts) -> list[str]:
    points = np.diff(contacts.point_start)
    rows = []
    for row, name in enumerate(contacts.joint_names):
        chosen = contacts.joints == row
        area = number(float(contacts.areas[chosen].sum()))
        rows.append([name, str(int(chosen.sum())), str(int(points[chosen].sum())), area])
    rows.append(["total", str(len(contacts)), str(len(contacts.points)), number(float(contacts.areas.sum()))])
    return table(["joint law", "interfaces", "points", f"area [{model.units.length}2]"], rows)


def _counts(model: Model, contacts: Contacts) -> list[str]:
    """Every count, zero or not: that nothing was missed is a finding too."""
    report, length = contacts.report, model.units.length
    on_ground = int((contacts.bodies >= len(model.blocks)).any(axis=1).sum())
    lines = entry("interfaces between blocks", str(len(contacts) - on_ground))
    lines += entry("interfaces on ground", str(on_ground))
    if len(contacts):
        least, most = number(float(contacts.areas.min())), number(float(contacts.areas.max()))
        lines += entry("least, greatest area", f"{least}, {most} {length}2")
        widest = float(np.abs(contacts.gaps).max())
        if widest > 1e-9 * float(model.blocks.sizes.max()):
            lines += entry("greatest gap or overlap", f"{small(widest)} {length}")
    unsupported = sum(len(part) for part in report.unsupported)
    parts = f", {counted(len(report.unsupported), 'part')}" if unsupported else ""
    glued = f": {glue_words(report, solid_sizes(contacts.solid_of_block))}" if len(report.glued) else ""
    for name, count, rest in (
        ("near misses", len(report.near_misses), ""),
        ("slivers dropped", len(report.slivers), ""),
        ("overlapping blocks", len(report.overlaps), ""),
        ("not checked for overlap", len(report.unchecked), ""),
        ("blocks without contact", len(report.isolated), ""),
        ("unsupported blocks", unsupported, parts),
        ("between fixed bodies (ignored)", report.fixed_contacts, ""),
        ("open joints (ignored)", report.open_interfaces, ""),
        ("internal interfaces (glued)", len(report.glued), glued),
    ):
        lines += entry(name, f"{count or 'none'}{rest}")
    return lines


def _pair_table(model: Model, title: str, measure: str, pairs: IntArray, relative: FloatArray | None) -> list[str]:
    """Pairs of bodies with a length each; the first of them only where there are many."""
    if not len(pairs):
        return []
    shown = pairs[:MOST_ROWS]
    rows = [_pair_row(model, pair, None if relative is None else float(relative[i])) for i, pair in enumerate(shown)]
    head = ["bodies", *([f"{measure} [{model.units.length}]", "over block size"] if measure else [])]
    return [*sentence(f"{title}:"), *long_table(head, rows, len(pairs))[1:]]


def _pair_row(model: Model, pair: IntArray, relative: float | None) -> list[str]:
    names = "/".join(model.body_name(body) for body in pair.tolist())
    if relative is None:
        return [names]
    size = min(float(model.blocks.sizes[body]) for body in pair.tolist() if body < len(model.blocks))
    return [names, f"{relative * size:.3g}", f"{relative:.2g}"]


def _names(model: Model, blocks: Iterable[int] | IntArray, most: int) -> str:
    chosen = [int(block) for block in blocks]
    more = f" and {len(chosen) - most} more" if len(chosen) > most else ""
    return ", ".join(model.blocks.name(block) for block in chosen[:most]) + more
