"""What is said before anything is solved: the model, settings, reductions; all of ``mbla check``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mbla import __version__
from mbla.arrays import IntArray
from mbla.errors import Notice
from mbla.model.model import Ground, LoadCase, Model
from mbla.program.reductions.steps import ReductionOutcome, ReductionStep
from mbla.results.listing.blocks import Block, Fact, ListingSection, Paragraph, apart, facts, paragraphs, table_of
from mbla.results.listing.places import counted_of, label_words, soil_words
from mbla.results.listing.sections.contact_words import contact_section, finding_sections
from mbla.results.listing.sections.tie_words import tie_blocks, tie_title
from mbla.results.listing.text import WIDTH, counted, lines_of, number, section_lines, sentence, text_of
from mbla.results.provenance import CaseNeeds
from mbla.results.results import Results

ROUNDING = 1e-9
"""share of the added mass of a block that is none beside its fill"""


def check_listing(results: Results, needs: Mapping[str, CaseNeeds]) -> str:
    """What ``mbla check`` prints: the model and its contacts as in the listing, and what each load case needs."""
    sections = [
        settings_section(results),
        *model_sections(results.model),
        contact_section(results.model, results.contacts),
        *finding_sections(results.model, results.contacts.report),
        *notice_sections(results.notices),
        *(_needs(results.model, case, own) for case, own in needs.items()),
    ]
    return text_of([*header_lines(results), *section_lines(sections), *sentence("Nothing was solved.")])


def _needs(model: Model, case: str, needs: CaseNeeds) -> ListingSection:
    names = {"free_blocks": "free blocks and cells"} if model.soils else {}
    counts = (Fact(names.get(name, name.replace("_", " ")), str(count)) for name, count in needs.counts.items())
    blocks = [*facts(counts), *apart(facts(reduction_facts(needs.reductions)))]
    return ListingSection(f"Needed for load case {case}", blocks)


def header_lines(results: Results) -> list[str]:
    """Program, deck and date, as text."""
    version = results.provenance.get("mbla", __version__)
    deck = results.deck
    lines = [f"mbla {version}   limit analysis of masonry as rigid blocks", "=" * WIDTH]
    lines += sentence(results.model.title, "") if results.model.title else []
    rows = [
        Fact("deck", deck.name),
        *(Fact("includes", name) for name, _ in deck.sources[1:]),
        *(Fact("changed by the user", override) for override in deck.overrides),
        Fact("deck hash (SHA-256)", deck.sha256),
        Fact("date", results.created),
    ]
    return lines + lines_of(facts(rows))


def settings_section(results: Results) -> ListingSection:
    """Units and the settings in effect."""
    units = results.model.units
    rows = {"units": f"{units.length}, {units.force}, {units.mass}, s; angles given as tan φ"} | results.settings
    return ListingSection("Units and analysis settings", facts(Fact(name, value) for name, value in rows.items()))


def model_sections(model: Model) -> list[ListingSection]:
    """Blocks by group, joint laws; supports; ties; loads of every case."""
    tables = [*apart(_group_table(model)), *apart(_labels(model)), *apart(_joint_table(model))]
    ties = [ListingSection(tie_title(model), tie_blocks(model))] if len(model.ties) else []
    return [
        ListingSection("Model", [*facts(_size(model)), *tables]),
        ListingSection("Supports", _supports(model)),
        *ties,
        ListingSection("Loads", [block for case in model.load_cases for block in _loads(case)]),
    ]


def _loads(case: LoadCase) -> list[Block]:
    dead = [Fact("dead load", words) for words in case.dead_words or ("none",)]
    return facts([*dead, *(Fact(case.question.applied, words) for words in case.live_words)], case.name)


def _size(model: Model) -> list[Fact]:
    """Blocks with their volume and weight, and what counts to it."""
    blocks, units, own = model.blocks, model.units, np.flatnonzero(model.soil_of_block < 0)
    rows = [
        Fact(
            "blocks",
            f"{len(own)}, of them {int((~model.fixed[own]).sum())} free and {int(model.fixed[own].sum())} fixed",
        ),
        *_soils(model),
        *_extents(model),
        Fact("volume", f"{number(float(blocks.volumes.sum()))} {units.length}3"),
        Fact("weight (9.81 m/s2)", f"{number(model.total_weight)} {units.force}"),
    ]
    others = blocks.added_masses if model.fill is None else blocks.added_masses - model.fill.masses
    added = np.flatnonzero(others > ROUNDING * blocks.added_masses)
    if len(added):
        mass = f"{number(float(others.sum()))} {units.mass} on {counted_of(model, added)}"
        rows.append(Fact("added masses", f"{mass}; they count to the weights"))
    if model.fill is not None:
        counts = "its mass moves with what it lies on and counts to the weight of that"
        rows += [Fact("fill", f"{words}; {counts}") for words in model.fill.words]
    return rows


def _soils(model: Model) -> list[Fact]:
    """Each soil of cells with the law of its joints to other blocks."""
    rows = []
    for row, soil in enumerate(model.soils):
        sizes = model.blocks.sizes[soil.blocks]
        weight = f"{number(float(model.weights[soil.blocks].sum()))} {model.units.force}"
        size = f"{sizes.min():.3g} .. {sizes.max():.3g} {model.units.length}"
        words = f"{counted(len(soil.triangles), 'rigid cell')} of {size}, {weight}; joint law {soil.joint}"
        rows.append(Fact(soil_words(model, np.array([row])), f"{words}, to other blocks {soil.wall_joint}"))
    return rows


def _extents(model: Model) -> list[Fact]:
    """The box around the model and the sizes of its blocks: a wrong unit or scale shows here."""
    blocks, length = model.blocks, model.units.length
    least, greatest = blocks.vertices.min(axis=0), blocks.vertices.max(axis=0)
    spans = [f"{axis} {a:.4g} .. {b:.4g}" for axis, a, b in zip("xyz", least + 0.0, greatest + 0.0, strict=True)]
    extents, own = [Fact("extents", f"{', '.join(spans)} {length}")], blocks.sizes[model.soil_of_block < 0]
    if not len(own):
        return extents
    sizes = f"{number(own.min())} .. {number(own.max())} {length}, cube roots of the volumes"
    return [*extents, Fact("block sizes", sizes)]


def _group_table(model: Model) -> list[Block]:
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
    pieces = "blocks or cells" if model.soils else "blocks"
    return table_of(["group", pieces, "fixed", volume, weight, f"density [{units.mass}/{units.length}3]"], rows)


def _labels(model: Model) -> list[Block]:
    """What selectors can say within each group."""
    said = {
        name: label_words(model.blocks.labels, chosen)
        for name, chosen in _blocks_of_groups(model).items()
        if (model.soil_of_block[chosen] < 0).all()
    }
    return paragraphs(*(f"{name}: {words}" for name, words in said.items() if words))


def _blocks_of_groups(model: Model) -> dict[str, IntArray]:
    """Blocks of every group, groups in the order in which they appear."""
    names, first, rows = np.unique(np.array(model.blocks.groups), return_index=True, return_inverse=True)
    members = np.split(np.argsort(rows, kind="stable"), np.cumsum(np.bincount(rows))[:-1])
    return {str(names[i]): members[i] for i in np.argsort(first)}


def _joint_table(model: Model) -> list[Block]:
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
    return table_of(head, rows)


def _supports(model: Model) -> list[Block]:
    says = []
    for ground in model.grounds:
        only = "" if ground.blocks is None else f", under {_under(model, ground.blocks)} only"
        says.append(f"rigid {ground.label} with joint law {_laws_on(model, ground)}{only}")
    for name, chosen in _blocks_of_groups(model).items():
        held = int(model.fixed[chosen].sum())
        if held:
            says.append(f"{counted(held, 'block')} of group {name} fixed")
    return paragraphs(*says, *model.guides.words) or [Paragraph("none")]


def _under(model: Model, blocks: IntArray) -> str:
    """``3 blocks``, ``1 block and soil road``."""
    soil = model.soil_of_block[blocks]
    own = [counted(int((soil < 0).sum()), "block")] if (soil < 0).any() else []
    return " and ".join([*own, *([soil_words(model, soil[soil >= 0])] if (soil >= 0).any() else [])])


def _laws_on(model: Model, ground: Ground) -> str:
    """That of the ground; under cells of soil that of the soil takes its place."""
    soil = model.soil_of_block if ground.blocks is None else model.soil_of_block[ground.blocks]
    laws = dict.fromkeys(model.soils[row].joint for row in np.unique(soil[soil >= 0]).tolist())
    own = [ground.joint] if (soil < 0).any() and ground.joint not in laws else []
    return ", ".join([*own, *(f"{law} under soil" if own else law for law in laws)])


FOUND = {
    "glued": ("block", "in larger bodies or held"),
    "points": ("contact point", "left out"),
    "unloaded": ("block", "apart, without live load"),
    "parts": ("part", "solved apart"),
    "planar": ("part", "in its plane"),
    "mirror": ("part", "by one half"),
}
"""What a reduction counts, and what is done with it."""


def reduction_facts(steps: Sequence[ReductionStep]) -> list[Fact]:
    """A row for each reduction that found something, in the order in which they are applied."""
    rows = []
    for step in steps:
        if step.state is ReductionOutcome.APPLIED:
            what, became = FOUND[step.name]
            left = f"{step.after.unknowns} of {step.before.unknowns} velocities left, {step.after.cones} cones"
            rows.append(Fact(f"reduction, {step.name}", f"{counted(step.found, what)} {became}; {left}"))
    return rows


def notice_sections(notices: Sequence[Notice]) -> list[ListingSection]:
    """Every notice and warning with its identifier; nothing where there is none."""
    return [ListingSection("Remarks", paragraphs(*map(str, notices)))] if notices else []
