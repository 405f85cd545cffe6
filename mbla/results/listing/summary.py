"""What the terminal shows of a run: the model in a line, status and answer of each case, then words."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.model.model import Model
from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.collapse.failure import failure_of
from mbla.results.listing.answer_words import answer_columns, status_words
from mbla.results.listing.certificate_words import fall_summary
from mbla.results.listing.failure_words import failure_sentences
from mbla.results.listing.mechanism_words import mechanism_summary
from mbla.results.listing.notice_words import cause_lines, warning_summary
from mbla.results.listing.series_words import spread_over_positions, worst_words
from mbla.results.listing.text import counted, number, sentence, table
from mbla.results.listing.verdict_words import bound_words, reasons, verdict
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import series_of, told_cases
from mbla.solution.solution import Mechanics

DETAIL = "    "


def summary_lines(results: Results) -> list[str]:
    """The lines, at most ``WIDTH`` columns wide: model, table of cases, each case in words, warnings."""
    model, contacts = results.model, results.contacts
    counts = (
        f"{results.deck.name}: {counted(len(model.blocks), 'block')}, {counted(len(contacts), 'interface')}, "
        f"{counted(len(contacts.points), 'contact point')}, weight {number(model.total_weight)} {model.units.force}"
    )
    told = told_cases(results.cases)
    lines = [counts, *cause_lines(results), *_table(results.model, told)]
    for case in told:
        lines += _in_words(results, case)
    for series in series_of(results.cases):
        for words in (worst_words(results.model, series), spread_over_positions(series)):
            lines += sentence(words)
    return lines + warning_summary(results)


def _table(model: Model, cases: Sequence[CaseResult]) -> list[str]:
    """Status and answer of every case; the associative answer beside it where the deck's flow rule is another."""
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


def _heaviest(results: Results, case: CaseResult, mechanics: Mechanics, collapse: Collapse) -> list[str]:
    """What the heaviest part does."""
    model, contacts = results.model.of_case(case.load_case), results.contacts
    failure = failure_of(model, contacts, collapse, mechanics)
    return sentence("".join(failure_sentences(model, contacts, case.load_case, collapse, failure)[1:2]), DETAIL)


def _in_words(results: Results, case: CaseResult) -> list[str]:
    """How it collapses; where it does not, or that is not known, why and what is known all the same."""
    model, solution, mechanics = results.model.of_case(case.load_case), case.solution, result_of(case)
    text = f"{case.load_case.name}: {verdict(model, case)}"
    if mechanics is not None:
        collapse = collapse_of(model, results.contacts, case.load_case, mechanics)
        failure = failure_of(model, results.contacts, collapse, mechanics)
        text += f": {mechanism_summary(model, collapse, failure)}"
    lines = sentence(text)
    if mechanics is not None:
        lines += _heaviest(results, case, mechanics, collapse)
    if solution.mechanics is None and solution.certificate is not None:
        lines += fall_summary(model, results.contacts, case.load_case, solution.certificate)
    for why in (*reasons(case), bound_words(model, case)):
        lines += sentence(why, DETAIL)
    return lines
