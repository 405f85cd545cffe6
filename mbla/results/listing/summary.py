"""Warnings and notices of a listing, and the summary that a terminal shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mbla.errors import Notice
from mbla.model.model import Model
from mbla.results.force_range import force_ranges_of
from mbla.results.listing.answers import answer_columns, range_words, spread_over_positions, status_words, worst_words
from mbla.results.listing.assessment_words import assessment_words, code_verdict
from mbla.results.listing.mechanism_words import description_of, mechanism_summary
from mbla.results.listing.pushover import curve_words, no_curve_words
from mbla.results.listing.text import counted, number, sentence, table
from mbla.results.listing.verdict_words import bound_words, least_words, reasons, torsion_words, verdict
from mbla.results.outcome import case_notices, notices_of, result_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of

HINT = "`mbla explain ID` says what an identifier in brackets means and what to do."


def warnings_of(results: Results) -> tuple[Notice, ...]:
    """Every warning: of deck, model, contacts and expectations, then of each load case."""
    return tuple(notice for notice in notices_of(results) if notice.severity == "warning")


def warning_lines(results: Results) -> list[str]:
    """All warnings once more, numbered, for the end of the listing."""
    warnings = warnings_of(results)
    if not warnings:
        return sentence("0 warnings")
    lines = sentence(f"{counted(len(warnings), 'warning')}:")
    for place, warning in enumerate(warnings, 1):
        lines += sentence(f"{place}. {warning}", "    ")
    return lines + sentence(HINT)


def warning_summary(results: Results) -> list[str]:
    """For the terminal: in full what the words of its case do not say, then all identifiers."""
    warnings = warnings_of(results)
    own = [notice for case in results.cases for notice in case_notices(case)]
    listed = [notice for notice in warnings if not notice.case or notice in own]
    lines = [line for notice in listed for line in sentence(str(notice))]
    counts = Counter(warning.identifier for warning in warnings)
    named = ", ".join(name if count == 1 else f"{name} ({count})" for name, count in counts.items())
    says = f"{counted(len(warnings), 'warning')}: {named}; mbla explain ID says more"
    return lines + sentence(says) if warnings else []


# --- What the terminal shows of a run: the model in a line, status and answer of each case, then words --------------


DETAIL = "    "


def summary_lines(results: Results) -> list[str]:
    """The lines, at most ``WIDTH`` columns wide: model, table of cases, each case in words, warnings."""
    model, contacts = results.model, results.contacts
    counts = (
        f"{results.deck.name}: {counted(len(model.blocks), 'block')}, {counted(len(contacts), 'interface')}, "
        f"{counted(len(contacts.points), 'contact point')}, weight {number(model.total_weight)} {model.units.force}"
    )
    detailed = detailed_cases(results.cases)
    lines = [counts, *_table(results.model, detailed), *_codes(detailed)]
    for case in detailed:
        lines += _in_words(results, case)
    for series in series_of(results.cases):
        for words in (worst_words(results.model, series), spread_over_positions(series)):
            lines += sentence(words)
    for found in force_ranges_of(results.cases):
        lines += sentence(range_words(results.model, found))
    return lines + warning_summary(results)


def _table(model: Model, cases: Sequence[CaseResult]) -> list[str]:
    """Status and answer of every case; the associative answer next to it where the deck's flow rule is another."""
    if not cases:
        return []
    heads, rows = answer_columns(model, cases)
    if all(case.solution.flow_rule == "associative" for case in cases):
        heads.pop()
    rows = [
        [case.load_case.name, status_words(case.status), *row[: len(heads)]]
        for case, row in zip(cases, rows, strict=True)
    ]
    return table(["load case", "status", *heads], rows, left=2)


def _codes(cases: Sequence[CaseResult]) -> list[str]:
    """What codes say, a line for each case that asks for it."""
    lines = []
    for case in cases:
        says = code_verdict(case)
        lines += sentence(f"{case.load_case.name}: {says}") if says else []
    return lines


def _in_words(results: Results, case: CaseResult) -> list[str]:
    """How it collapses; where it does not, or that is not known, why and what is known all the same."""
    model, found = results.model.of_case(case.load_case), result_of(case)
    fails = found is not None or case.solution.mechanics is None
    how = description_of(results.assembly, case) if fails else None
    text, details = f"{case.load_case.name}: {verdict(model, case)}", []
    if how is not None:  # what the heaviest part does; of a fall how much moves, too
        text += "" if found is None else f": {mechanism_summary(model, how.collapse, how.failure)}"
        details = how.sentences[:2] if found is None else how.sentences[1:2]
    lines = sentence(text)
    assessed = assessment_words(case)
    said = (least_words(model, case), torsion_words(model, case), *details, *reasons(case), bound_words(model, case))
    for words in (*said, curve_words(model, case) or no_curve_words(case), assessed):
        lines += sentence(words, DETAIL)
    return lines
