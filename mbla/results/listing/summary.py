"""Warnings and notices of a listing, and the summary that a terminal shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mbla.errors import Notice
from mbla.model.model import Model
from mbla.results.demand.cracking import cracking_notices
from mbla.results.force_range import force_ranges_of
from mbla.results.listing.answers import (
    answer_columns,
    case_status_words,
    range_words,
    spread_over_positions,
    worst_words,
)
from mbla.results.listing.blocks import Block, Paragraph, paragraphs, table_of
from mbla.results.listing.places import counted_blocks
from mbla.results.listing.sections.assessment_words import assessment_words, code_verdict
from mbla.results.listing.sections.mechanism_words import description_of, mechanism_summary
from mbla.results.listing.sections.modes import modes_words
from mbla.results.listing.sections.pushover import curve_words, no_curve_words
from mbla.results.listing.text import counted, lines_of, number
from mbla.results.listing.verdict_words import (
    bound_words,
    least_words,
    reasons,
    soil_flow_words,
    soil_range_words,
    torsion_words,
    verdict,
)
from mbla.results.outcome import case_notices, notices_of, result_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of

HINT = "`mbla explain ID` says what an identifier in brackets means and what to do."


def warnings_of(results: Results) -> tuple[Notice, ...]:
    """Every warning: of deck, model, contacts and expectations, then of each load case."""
    return tuple(notice for notice in notices_of(results) if notice.severity == "warning")


def warning_blocks(results: Results) -> list[Block]:
    """All warnings once more, numbered, for the end of the listing."""
    warnings = warnings_of(results)
    if not warnings:
        return paragraphs("0 warnings")
    numbered = (f"{place}. {warning}" for place, warning in enumerate(warnings, 1))
    head = paragraphs(f"{counted(len(warnings), 'warning')}:")
    return [*head, *paragraphs(*numbered, detail=True), *paragraphs(HINT)]


def warning_summary(results: Results) -> list[Block]:
    """For the terminal: in full what the words of its case do not say, then all identifiers."""
    warnings = warnings_of(results)
    own = [notice for case in results.cases for notice in case_notices(case)]
    detailed = [case for case in detailed_cases(results.cases) if result_of(case) is not None]
    own += [notice for case in detailed for notice in cracking_notices(results.assembly, case)]
    listed = [notice for notice in warnings if not notice.case or notice in own]
    counts = Counter(warning.identifier for warning in warnings)
    named = ", ".join(name if count == 1 else f"{name} ({count})" for name, count in counts.items())
    says = f"{counted(len(warnings), 'warning')}: {named}; mbla explain ID says more"
    return paragraphs(*map(str, listed), says) if warnings else []


# --- What the terminal shows of a run: the model in a line, status and answer of each case, then words --------------


def summary_lines(results: Results) -> list[str]:
    """At most ``WIDTH`` columns wide: model, table of cases, each case in words, warnings."""
    model, contacts = results.model, results.contacts
    counts = (
        f"{results.deck.name}: {counted_blocks(model)}, {counted(len(contacts), 'interface')}, "
        f"{counted(len(contacts.points), 'contact point')}, weight {number(model.total_weight)} {model.units.force}"
    )
    detailed = detailed_cases(results.cases)
    codes = (f"{case.load_case.name}: {says}" for case in detailed if (says := code_verdict(case)))
    told = [block for case in detailed for block in _in_words(results, case)]
    found = [
        words for each in series_of(results.cases) for words in (worst_words(model, each), spread_over_positions(each))
    ]
    found += [range_words(model, each) for each in force_ranges_of(results.cases)]
    return lines_of(
        [
            Paragraph(counts, flush=True),
            *_table(model, detailed),
            *paragraphs(*codes),
            *told,
            *paragraphs(*found),
            *warning_summary(results),
        ]
    )


def _table(model: Model, cases: Sequence[CaseResult]) -> list[Block]:
    """Status and answer of every case; the associative answer next to it where the deck's flow rule is another."""
    if not cases:
        return []
    heads, rows = answer_columns(model, cases)
    if all(case.solution.flow_rule == "associative" or not case.load_case.has_load_factor for case in cases):
        heads.pop()
    rows = [
        [case.load_case.name, case_status_words(case), *row[: len(heads)]]
        for case, row in zip(cases, rows, strict=True)
    ]
    return table_of(["load case", "status", *heads], rows, left=2)


def _in_words(results: Results, case: CaseResult) -> list[Block]:
    """How it collapses; where it does not, or that is not known, why and what is known all the same."""
    model, found = results.model.of_case(case.load_case), result_of(case)
    fails = found is not None or case.solution.mechanics is None
    how = description_of(results.assembly, case) if fails else None
    text, details = f"{case.load_case.name}: {verdict(model, case)}", list[str]()
    if how is not None:  # what the heaviest part does; of a fall how much moves, too
        text += "" if found is None else f": {mechanism_summary(model, how.collapse, how.failure)}"
        details = how.sentences[:2] if found is None else how.sentences[1:2]
    said = (least_words(model, case), torsion_words(model, case), *details, *reasons(case), bound_words(model, case))
    further = (
        soil_flow_words(model, case),
        soil_range_words(model, case),
        *said,
        curve_words(model, case) or no_curve_words(case),
        modes_words(case) if case.load_case.question.group != "modes" else "",
        assessment_words(case),
    )
    return [Paragraph(text), *paragraphs(*further, detail=True)]
