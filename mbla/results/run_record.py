"""The results of a run as it goes: before any load case is solved, and after each of them.

What belongs to solved load cases is imported where there is one: ``mbla check`` solves none, and answers sooner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mbla.contacts.contacts import Contacts
from mbla.deck import Deck
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.process.stopwatch import Stopwatch
from mbla.program.build import program_notices
from mbla.results.provenance import collect_provenance, deck_record, settings_in_words, threads_in_words
from mbla.results.results import CaseResult, Results, now
from mbla.solution.settings import SolverSettings

PARTS_OF_SOLVE = ("assemble", "programs", "repair", "standing", "verify")
"""What is timed inside ``solve``: equilibrium, yield conditions and reductions; programs and steps of the law;
forces and velocities repaired, which prove the bounds; standing under dead load; verification."""


def results_before(
    deck: Deck, model: Model, contacts: Contacts, settings: SolverSettings, seconds: dict[str, float]
) -> Results:
    """Results without load cases.

    seconds : by stage, of those that are done
    """
    return Results(
        deck=deck_record(deck),
        model=model,
        contacts=contacts,
        cases=(),
        notices=notices_of(deck, model, contacts),
        provenance=collect_provenance(),
        settings=settings_in_words(deck, settings),
        time=seconds,
        exit_code=0,
    )


def notices_of(deck: Deck, model: Model, contacts: Contacts) -> tuple[Notice, ...]:
    """What every stage before the solver remarked, in their order."""
    return (
        *deck.notices,
        *model.notices,
        *contacts.report.notices,
        *program_notices(model, contacts, deck.analysis),
    )


def with_case(results: Results, case: CaseResult, seconds: float, stopwatch: Stopwatch) -> Results:
    """Results so far with one load case more.

    seconds : since solving began
    """
    from mbla.results.exit_status import exit_code

    cases = (*results.cases, case)
    return replace(
        results,
        model=with_loads_found(results.model, [case]),
        cases=cases,
        settings=results.settings | {"threads": threads_in_words(cases)},
        time=results.time | {"solve": seconds} | parts_of_solve(cases, stopwatch),
        exit_code=exit_code(cases, results.notices),
        created=now(),
        not_done=results.not_done[1:],
    )


def with_loads_found(model: Model, cases: Sequence[CaseResult]) -> Model:
    """The model with the load cases as they were solved.

    The loads of a tilting table are those of its angle, and those of a support that gives way have the reaction from
    which it starts.
    """
    found = {case.load_case.name: case.load_case for case in cases}
    return replace(model, load_cases=tuple(found.get(case.name, case) for case in model.load_cases))


def as_expected(results: Results, deck: Deck) -> Results:
    """Results with a warning for every figure that is not what the deck expects."""
    from mbla.results.exit_status import differences, exit_code

    found = [Notice("warning", "not-as-expected", text) for text in differences(results.cases, deck.content.expected)]
    notices = (*results.notices, *found)
    return replace(results, notices=notices, exit_code=exit_code(results.cases, notices))


def parts_of_solve(cases: Sequence[CaseResult], stopwatch: Stopwatch) -> dict[str, float]:
    """Seconds of the programs, as they were recorded, and of what is done before, between and after them."""
    programs = float(sum(program.seconds for case in cases for program in case.solution.programs))
    parts = {"programs": programs, **stopwatch.seconds}
    return {f"solve/{part}": parts[part] for part in PARTS_OF_SOLVE if part in parts}
