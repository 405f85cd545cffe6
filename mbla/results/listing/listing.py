"""The listing: what was asked, what the model is, what was found; ``mbla show`` prints it from the .h5 alone.

The sections of one load case say how it collapses, how well that is known, where the forces go.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from mbla.assembly.assembly import Assembly
from mbla.model.model import Model
from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.results.collapse.force_freedom import enough_of, force_freedom
from mbla.results.exit_status import FAULTS
from mbla.results.findings import remarks_of_run
from mbla.results.force_range import force_ranges_of
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.listing.answers import objective_section, range_words, series_section, worst_words
from mbla.results.listing.blocks import Block, Fact, ListingSection, apart, facts, paragraphs
from mbla.results.listing.history_words import history_words, pushovers_words
from mbla.results.listing.sections.assessment_words import assessment_blocks, code_verdict
from mbla.results.listing.sections.contact_words import contact_section
from mbla.results.listing.sections.figures import figure_blocks, path_blocks, program_blocks
from mbla.results.listing.sections.forces import (
    enough_blocks,
    freedom_blocks,
    group_reaction_blocks,
    lock_blocks,
    reaction_blocks,
    soil_blocks,
    work_blocks,
)
from mbla.results.listing.sections.geometric_safety import geometric_safety_blocks
from mbla.results.listing.sections.mechanism_words import (
    FailureDescription,
    description_of,
    mechanism_blocks,
    mechanism_summary,
)
from mbla.results.listing.sections.model_words import (
    header_lines,
    model_sections,
    notice_sections,
    reduction_facts,
    settings_section,
)
from mbla.results.listing.sections.modes import modes_blocks
from mbla.results.listing.sections.pushover import curve_blocks
from mbla.results.listing.sections.sensitivity import sensitivity_blocks
from mbla.results.listing.sections.tie_words import tie_force_blocks, tie_title
from mbla.results.listing.sections.time_history import history_sections
from mbla.results.listing.sections.unit_words import unit_blocks
from mbla.results.listing.summary import warning_blocks
from mbla.results.listing.text import counted, full_sentence, number, section_lines, text_of
from mbla.results.listing.verdict_words import bound_words, known_words, verdict
from mbla.results.outcome import dimension_of, result_of, unproved_words
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of
from mbla.solution.solution import Mechanics


def case_section(assembly: Assembly, case: CaseResult) -> ListingSection:
    """All sections of a load case below each other, as the listing has them."""
    first, *others = case_sections(assembly, case)
    blocks = [*first.blocks, *(block for each in others for block in apart(each.blocks))]
    return ListingSection(f"Load case {case.load_case.name}", blocks)


def case_sections(assembly: Assembly, case: CaseResult) -> list[ListingSection]:
    """Sections on a load case, the verdict and the failure first; no section is empty."""
    solution, model = case.solution, assembly.model.of_case(case.load_case)
    how = description_of(assembly, case)
    found = {"Verdict": _verdict_blocks(model, case, how)}
    if how is not None:
        found["Mechanism"] = mechanism_blocks(assembly, case.load_case, how.failure)
        if solution.mechanics is not None:
            found |= _forces(assembly, case, solution.mechanics, how)
    elif solution.lock is not None:
        locking = solution.lock[: len(assembly.contacts.points)]
        found["Locking forces"] = lock_blocks(model, assembly.contacts, locking)
    found |= {
        "Earth pressure": soil_blocks(model, assembly.contacts, case),
        "Load factor and bounds": figure_blocks(model, case) if case.load_case.has_load_factor else [],
        "Reductions": facts(reduction_facts(solution.reductions)),
        "Path of elastic joints": path_blocks(model, case),
        "Pushover": curve_blocks(model, case),
        "Modes of vibration": modes_blocks(assembly, case),
        **history_sections(assembly, case),
        "Geometric safety": geometric_safety_blocks(case),
        "Sensitivity": sensitivity_blocks(case),
        "Assessment": assessment_blocks(case),
        "Solver programs": program_blocks(solution),
    }
    return [ListingSection(title, blocks) for title, blocks in found.items() if blocks]


def _forces(
    assembly: Assembly, case: CaseResult, mechanics: Mechanics, how: FailureDescription
) -> dict[str, list[Block]]:
    """Work, reactions and ties, by the titles of their sections."""
    load_case, held, contacts = case.load_case, assembly.model, assembly.contacts
    model, freedom = (
        held.of_case(load_case),
        force_freedom(assembly.glued(load_case), mechanics, dimension_of((case,))),
    )
    return {
        "Work": [
            *enough_blocks(model, case, enough_of(model, contacts, how.collapse.parts)),
            *work_blocks(load_case, how.collapse.work, soil=bool(model.ties.of_fill.any())),
        ],
        "Reactions": [
            *reaction_blocks(held, contacts, load_case, mechanics),  # a support is one even as it gives way
            *group_reaction_blocks(held, contacts, mechanics),
            *freedom_blocks(contacts, case, freedom),
        ],
        tie_title(model): tie_force_blocks(model, mechanics) if len(model.ties) else [],
        "Stress in units": unit_blocks(assembly, case),
    }


def find_failure(assembly: Assembly, case: CaseResult) -> None:
    """Find how a case fails, which is kept for listing, files and pictures: takes longest on large models."""
    load_case, mechanics = case.load_case, case.solution.mechanics
    if mechanics is not None:
        collapse = collapse_of(assembly, load_case, mechanics)
        failure_of(assembly.model.of_case(load_case), assembly.contacts, collapse, mechanics)
        force_freedom(assembly.glued(load_case), mechanics, dimension_of((case,)))


def _verdict_blocks(model: Model, case: CaseResult, how: FailureDescription | None) -> list[Block]:
    """How it collapses, what a code says of it and how well it is known; of what does not stand, how it falls."""
    says, sentences = verdict(model, case), [] if how is None else how.sentences
    if how is not None and case.solution.mechanics is not None:
        says += "" if result_of(case) is not None else "; its mechanism, not verified"
        says += f": {mechanism_summary(model, how.collapse, how.failure)}"
    said = (says, code_verdict(case), case.solution.reason)
    known = (bound_words(model, case), *known_words(model, case))
    blocks = paragraphs(*map(full_sentence, said)) + apart(paragraphs(*sentences))
    return blocks + apart(paragraphs(*map(full_sentence, known)))


ANOTHER_POSITION = (
    "Of these positions the worst has a section of its own above, and so have those without a result; "
    "mbla report {}.h5 --case {} reports another, output: {{positions: all}} in the deck reports all."
)


def listing(results: Results, *, every_position: bool = False) -> str:
    """The complete listing, at most 100 columns wide, with a newline at its end.

    every_position : sections of every position of a travelling load, not only of the worst
    """
    detailed = results.cases if every_position else detailed_cases(results.cases)
    sections = [
        settings_section(results),
        *model_sections(results.model),
        contact_section(results.model, results.contacts),
        *notice_sections(results.notices),
        *(case_section(results.assembly, case) for case in detailed),
    ]
    for series in series_of(results.cases):
        sections.append(series_section(results.model, series))
        if len(detailed) < len(results.cases):
            stem, first = Path(results.deck.name).stem, series.cases[0].load_case.name
            sections[-1].blocks.extend(paragraphs(ANOTHER_POSITION.format(stem, first)))
    sections += [objective_section(results.model, found) for found in force_ranges_of(results.cases)]
    return text_of([*header_lines(results), *section_lines([*sections, _recap(results)])])


def verification_lines(results: Results, disagreements: Sequence[str]) -> list[str]:
    """What ``mbla verify`` prints: figures recomputed for every case, and where the file says otherwise."""
    solver = "no solver" if results.paths_again is None else "no solver, but for paths and pushovers"
    model, cases = results.model, results.cases
    sections = [ListingSection(f"Load case {case.load_case.name}", figure_blocks(model, case)) for case in cases]
    lacking = ", ".join(results.without_result) * (not results.complete)
    said = [
        *history_words(results),
        *pushovers_words(results),
        f"not verified, but as the run reported it: {'; '.join(unverified_kinds(results))}",
        *unproved_words(cases),
        *remarks_of_run(cases),
        *(f"not confirmed: {text}" for text in results.unconfirmed),
        f"load cases of the deck without a result: {lacking}" if lacking else "",
        *(f"differs: {text}" for text in disagreements),
        *(notice.message for notice in results.notices if notice.identifier in ("run-stopped", *FAULTS)),
    ]
    if not disagreements and not results.unconfirmed:
        said.append("all else in the file agrees with what was recomputed")
    verdicts = facts(Fact(case.load_case.name, verdict(model, case)) for case in cases)
    sections.append(ListingSection("Summary", verdicts + paragraphs(*said)))
    return [f"{results.deck.name}: recomputed from the file alone, {solver}", *section_lines(sections)]


def _recap(results: Results) -> ListingSection:
    model, cases = results.model, detailed_cases(results.cases)
    left_out = len(model.load_cases) - len(results.cases)
    seconds = _seconds(results.time)
    blocks = [
        *facts(
            Fact(case.load_case.name, verdict(model, case), tuple(filter(None, [code_verdict(case)]))) for case in cases
        ),
        *paragraphs(
            *(worst_words(model, series) for series in series_of(results.cases)),
            *(range_words(model, found) for found in force_ranges_of(results.cases)),
            f"{counted(left_out, 'load case')} of the deck not run" if left_out else "",
        ),
        *warning_blocks(results),
        *paragraphs(f"exit status {results.exit_code}" + (f"; {seconds}" if seconds else "")),
    ]
    return ListingSection("Summary", blocks)


def _seconds(time: Mapping[str, float]) -> str:
    """Of every stage, and in brackets of its parts."""
    said = {stage: f"{stage.split('/')[-1]} {number(round(value, 3))} s" for stage, value in time.items()}
    parts = {stage: [said[part] for part in said if part.startswith(f"{stage}/")] for stage in said}
    stages = [stage for stage in said if "/" not in stage]
    return ", ".join(said[stage] + (f" ({', '.join(parts[stage])})" if parts[stage] else "") for stage in stages)
