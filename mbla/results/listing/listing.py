"""The listing: what was asked, what the model is, what was found; ``mbla show`` prints it from the .h5 alone.

The sections of one load case say how it collapses, how well that is known, where the forces go.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.assembly.assembly import Assembly
from mbla.model.model import Model
from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.results.collapse.force_freedom import enough_of, force_freedom
from mbla.results.exit_status import FAULTS
from mbla.results.findings import remarks_of_run
from mbla.results.force_range import force_ranges_of
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.listing.answers import objective_lines, range_words, series_lines, worst_words
from mbla.results.listing.assessment_words import assessment_lines, code_verdict
from mbla.results.listing.figures import figures, path_lines, program_lines
from mbla.results.listing.forces import (
    enough_lines,
    freedom_lines,
    group_reaction_lines,
    lock_lines,
    reaction_lines,
    work_lines,
)
from mbla.results.listing.geometric_safety import geometric_safety_lines
from mbla.results.listing.history_words import history_words, pushovers_words
from mbla.results.listing.mechanism_words import description_of, mechanism_lines, mechanism_summary
from mbla.results.listing.model_words import (
    contact_lines,
    header_lines,
    model_lines,
    notice_lines,
    reduction_lines,
    settings_lines,
    spaced,
)
from mbla.results.listing.pushover import curve_lines
from mbla.results.listing.sensitivity import sensitivity_lines
from mbla.results.listing.summary import warning_lines
from mbla.results.listing.text import counted, entry, full_sentence, heading, number, sentence
from mbla.results.listing.tie_words import tie_force_lines, tie_title
from mbla.results.listing.verdict_words import bound_words, known_words, verdict
from mbla.results.outcome import dimension_of, result_of, unproved_words
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of


@dataclass(frozen=True)
class Section:
    """Lines of one subject; the listing has them one below the other, the report under their titles."""

    title: str
    lines: list[str]


def case_lines(assembly: Assembly, case: CaseResult) -> list[str]:
    """All sections of a load case, as the listing has them."""
    lines = heading(f"Load case {case.load_case.name}")
    return lines + [line for section in case_sections(assembly, case) for line in section.lines]


def case_sections(assembly: Assembly, case: CaseResult) -> list[Section]:
    """Sections on a load case, the verdict and the failure first; no section is empty."""
    solution, load_case, held, contacts = case.solution, case.load_case, assembly.model, assembly.contacts
    model, mechanics, how = held.of_case(load_case), solution.mechanics, description_of(assembly, case)
    summary = "" if how is None or mechanics is None else mechanism_summary(model, how.collapse, how.failure)
    code, sentences = code_verdict(case), [] if how is None else how.sentences
    sections = [Section("Verdict", _verdict_lines(model, case, summary, code, sentences))]
    if how is not None:
        sections.append(Section("Mechanism", mechanism_lines(assembly, load_case, how.failure)))
    if mechanics is not None and how is not None:
        work = enough_lines(case, enough_of(model, contacts, how.collapse.parts))
        work += work_lines(load_case, how.collapse.work, soil=bool(model.ties.of_fill.any()))
        reactions = reaction_lines(held, contacts, load_case, mechanics)  # a support is one even as it gives way
        reactions += group_reaction_lines(held, contacts, mechanics)
        freedom = force_freedom(assembly.glued(load_case), mechanics, dimension_of((case,)))
        reactions += freedom_lines(contacts, case, freedom)
        sections += [Section("Work", ["", *work]), Section("Reactions", reactions)]
        sections.append(Section(tie_title(model), tie_force_lines(model, mechanics)))
    elif mechanics is None and solution.lock is not None:
        sections.append(Section("Locking forces", lock_lines(model, contacts, solution.lock[: len(contacts.points)])))
    sections += [
        Section("Load factor and bounds", ["", *figures(model, case)]),
        Section("Reductions", spaced(reduction_lines(solution.reductions))),
        Section("Path of elastic joints", path_lines(model, case)),
        Section("Pushover", curve_lines(model, case)),
        Section("Geometric safety", geometric_safety_lines(case)),
        Section("Sensitivity", sensitivity_lines(case)),
        Section("Assessment", assessment_lines(case)),
        Section("Solver programs", program_lines(solution)),
    ]
    return [section for section in sections if any(section.lines)]


def find_failure(assembly: Assembly, case: CaseResult) -> None:
    """Find how a case fails, which is kept for listing, files and pictures: takes longest on large models."""
    load_case, mechanics = case.load_case, case.solution.mechanics
    if mechanics is not None:
        collapse = collapse_of(assembly, load_case, mechanics)
        failure_of(assembly.model.of_case(load_case), assembly.contacts, collapse, mechanics)
        force_freedom(assembly.glued(load_case), mechanics, dimension_of((case,)))


def _verdict_lines(model: Model, case: CaseResult, summary: str, code: str, sentences: Sequence[str]) -> list[str]:
    """How it collapses, what a code says of it and how well it is known; of what does not stand, how it falls."""
    says = verdict(model, case)
    if summary:
        says += "" if result_of(case) is not None else "; its mechanism, not verified"
        says += f": {summary}"
    lines = [line for text in (says, code, case.solution.reason) for line in sentence(full_sentence(text))]
    lines += spaced([line for text in sentences for line in sentence(text)])
    known = [full_sentence(text) for text in (bound_words(model, case), *known_words(model, case))]
    return lines + spaced([line for text in known for line in sentence(text)])


ANOTHER_POSITION = (
    "Of these positions the worst has a section of its own above, and so have those without a result; "
    "mbla report {}.h5 --case {} reports another, output: {{positions: all}} in the deck reports all."
)


def listing(results: Results, *, every_position: bool = False) -> str:
    """The complete listing, at most 100 columns wide, with a newline at its end.

    every_position : sections of every position of a travelling load, not only of the worst
    """
    lines = [
        *header_lines(results),
        *settings_lines(results),
        *model_lines(results.model),
        *contact_lines(results.model, results.contacts),
        *notice_lines(results.notices),
    ]
    detailed = results.cases if every_position else detailed_cases(results.cases)
    for case in detailed:
        lines += case_lines(results.assembly, case)
    for series in series_of(results.cases):
        lines += series_lines(results.model, series)
        if len(detailed) < len(results.cases):
            lines += sentence(ANOTHER_POSITION.format(Path(results.deck.name).stem, series.cases[0].load_case.name))
    for found in force_ranges_of(results.cases):
        lines += objective_lines(results.model, found)
    lines += _recap(results)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def verification_lines(results: Results, disagreements: Sequence[str]) -> list[str]:
    """What ``mbla verify`` prints: figures recomputed for every case, and where the file says otherwise."""
    solver = "no solver" if results.paths_again is None else "no solver, but for paths and pushovers"
    lines = [f"{results.deck.name}: recomputed from the file alone, {solver}"]
    for case in results.cases:
        lines += heading(f"Load case {case.load_case.name}") + figures(results.model, case)
    lines += heading("Summary")
    lines += [line for case in results.cases for line in entry(case.load_case.name, verdict(results.model, case))]
    lines += [line for text in (*history_words(results), *pushovers_words(results)) for line in sentence(text)]
    lines += sentence(f"not verified, but as the run reported it: {'; '.join(unverified_kinds(results))}")
    unproved = (*unproved_words(results.cases), *remarks_of_run(results.cases))
    lines += [line for text in unproved for line in sentence(text)]
    lines += [line for text in results.unconfirmed for line in sentence(f"not confirmed: {text}")]
    if not results.complete and results.without_result:
        lines += sentence(f"load cases of the deck without a result: {', '.join(results.without_result)}")
    lines += [line for text in disagreements for line in sentence(f"differs: {text}")]
    of_file = [notice.message for notice in results.notices if notice.identifier in ("run-stopped", *FAULTS)]
    lines += [line for text in of_file for line in sentence(text)]
    if not disagreements and not results.unconfirmed:
        lines += sentence("all else in the file agrees with what was recomputed")
    return lines


def _recap(results: Results) -> list[str]:
    lines = heading("Summary")
    for case in detailed_cases(results.cases):
        lines += entry(case.load_case.name, verdict(results.model, case))
        code = code_verdict(case)
        lines += sentence(code, "    ") if code else []
    lines += [line for series in series_of(results.cases) for line in sentence(worst_words(results.model, series))]
    for found in force_ranges_of(results.cases):
        lines += sentence(range_words(results.model, found))
    left_out = len(results.model.load_cases) - len(results.cases)
    if left_out:
        lines += sentence(f"{counted(left_out, 'load case')} of the deck not run")
    lines += warning_lines(results)
    seconds = _seconds(results.time)
    return lines + sentence(f"exit status {results.exit_code}" + (f"; {seconds}" if seconds else ""))


def _seconds(time: Mapping[str, float]) -> str:
    """Of every stage, and in brackets of its parts."""
    said = {stage: f"{stage.split('/')[-1]} {number(round(value, 3))} s" for stage, value in time.items()}
    parts = {stage: [said[part] for part in said if part.startswith(f"{stage}/")] for stage in said}
    stages = [stage for stage in said if "/" not in stage]
    return ", ".join(said[stage] + (f" ({', '.join(parts[stage])})" if parts[stage] else "") for stage in stages)
