"""The section of one load case in the listing: how it collapses, how well that is known, where the forces go."""

from __future__ import annotations

from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import collapse_of
from mbla.results.collapse.enough import enough_of
from mbla.results.collapse.failure import failure_of
from mbla.results.collapse.force_freedom import force_freedom
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.results.words.certificate_words import certificate_lines
from mbla.results.words.determined_words import enough_lines, freedom_lines
from mbla.results.words.failure_words import failure_sentences
from mbla.results.words.figure_words import figures
from mbla.results.words.force_words import (
    force_range_lines,
    group_reaction_lines,
    lock_lines,
    reaction_lines,
)
from mbla.results.words.mechanism_words import mechanism_lines, mechanism_summary
from mbla.results.words.path_words import path_lines
from mbla.results.words.program_words import program_lines
from mbla.results.words.text import heading, sentence
from mbla.results.words.verdict_words import bound_words, known_words, verdict
from mbla.results.words.work_words import work_lines


def case_lines(model: Model, contacts: Contacts, case: CaseResult) -> list[str]:
    """The section of one load case."""
    solution, held, model = case.solution, model, model.of_case(case.load_case)
    mechanics = solution.mechanics
    collapse = None if mechanics is None else collapse_of(model, contacts, case.load_case, mechanics)
    says = verdict(model, case)
    if collapse is not None:
        says += f"{_mechanism_label(case)}: {mechanism_summary(model, collapse)}"
    lines = heading(f"Load case {case.load_case.name}") + sentence(says + ".")
    lines += sentence(solution.reason)
    failure = None
    if mechanics is not None and collapse is not None:
        failure = failure_of(model, contacts, collapse, mechanics)
        told = failure_sentences(model, contacts, case.load_case, collapse, failure)
        lines += ["", *(line for text in told for line in sentence(text))]
    known = [line for text in (bound_words(model, case), *known_words(model, case)) for line in sentence(text)]
    lines += ["", *known] if known else []
    if mechanics is None and solution.certificate is not None:
        lines += certificate_lines(model, solution.certificate)
    if mechanics is not None and collapse is not None and failure is not None:
        tables = mechanism_lines(model, contacts, failure)
        lines += ["", *tables, ""] if tables else [""]
        lines += enough_lines(case, enough_of(model, contacts, collapse.parts))
        lines += work_lines(model, contacts, case.load_case, mechanics, collapse.work)
        lines += reaction_lines(held, contacts, case.load_case, mechanics)  # a support is one even as it gives way
        lines += group_reaction_lines(held, contacts, mechanics)
        dimension = 3 if solution.size is None else solution.size.dimension
        lines += freedom_lines(contacts, case, force_freedom(model, contacts, mechanics, dimension))
        if solution.force_ranges is not None:
            lines += force_range_lines(model, contacts, mechanics, solution.force_ranges)
    if mechanics is None and solution.lock is not None:
        lines += lock_lines(model, contacts, solution.lock)
    lines += ["", *figures(model, case)]
    return lines + path_lines(model, case) + program_lines(solution)


def _mechanism_label(case: CaseResult) -> str:
    return "" if result_of(case) is not None else "; its mechanism, for what it is worth"
