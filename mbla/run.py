"""One deck to one result: the table of contents of the program."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from mbla.contacts import Contacts, find_contacts
from mbla.contacts.broad_phase import PairsRefused
from mbla.contacts.findings import bent_faults, glue_findings
from mbla.contacts.glue import Solids, held_model, solids_of
from mbla.contacts.held_twice import SupportsAtOdds
from mbla.contacts.notices import overlap_messages
from mbla.contacts.points import PointsRefused
from mbla.deck import Deck, read_deck
from mbla.errors import DeckError, Message, Notice, UsageError, first_faults
from mbla.model import Model, build_model
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.process.stopwatch import Stopwatch, stage, timing
from mbla.program import Program, assemble
from mbla.program.choice import has_conditions_on_interfaces, program_notices
from mbla.program.reductions import Reduced, allowed_reductions, reduce_program, unreduced
from mbla.program.reductions.steps import glued_step, size_of, told_apart
from mbla.results.deck_record import deck_record
from mbla.results.exit_status import exit_code
from mbla.results.expected import differences
from mbla.results.files import OutputFolder
from mbla.results.provenance import collect_provenance
from mbla.results.results import CaseResult, Results, now
from mbla.results.settings_words import settings_in_words, threads_in_words
from mbla.results.sta import StatusFile
from mbla.results.write import write_results
from mbla.run_options import RunOptions as RunOptions
from mbla.solution import solve, verified_status, verify
from mbla.solution.glued import solution_on_blocks
from mbla.solution.settings import SolverSettings, solver_settings
from mbla.solution.settlement import posed
from mbla.solution.solution import Checks, IterationRecord, Solution
from mbla.solution.tilt import solve_tilt
from mbla.stopped_run import leaves_nothing, stopped

Progress = Callable[[str, IterationRecord], None]

PARTS_OF_SOLVE = ("assemble", "programs", "repair", "standing", "verify")
"""What is timed inside ``solve``: equilibrium, yield conditions and reductions; programs and steps of the law;
forces and velocities repaired, which prove the bounds; standing under dead load; verification."""


def run(deck_path: Path, options: RunOptions, progress: Progress | None = None) -> Results:
    """Solve every load case of a deck and write the result files.

    progress : called once per iteration with the name of the load case

    Raises
    ------
    DeckError, UsageError, FileError, LimitError, SolverError
        nothing is written then, and an earlier result stays as it was
    StoppedRun
        of whatever else ends it when load cases are done: these are written beside it (:mod:`mbla.stopped_run`)
    """
    started = time.perf_counter()
    return run_and_write(read_deck(deck_path, options.overrides), options, progress, started)


def run_and_write(deck: Deck, options: RunOptions, progress: Progress | None, started: float) -> Results:
    """Solve the load cases of a deck that was read and write the files; raises as ``run`` does.

    The output folder is there first: a result that would be refused at the end costs no analysis.

    started : when reading began, by ``time.perf_counter``
    """
    stem, folder, output = deck.path.stem, options.folder_for(deck.path), deck.content.output
    out = OutputFolder(folder, stem, options.force)
    results: Results | None = None
    try:
        with out:
            status_file = StatusFile(out.open_live(f"{stem}.sta"), title_of(deck))
            for so_far in solved_case_by_case(deck, options, status_file, progress, started):
                results = so_far
            assert results is not None
            return write_results(results, out, output)
    except BaseException as cause:
        if out.in_place or leaves_nothing(cause):
            raise
        if results is None or not results.cases:
            cause.add_note("no load case was done")
            raise
        raise stopped(results, cause, out, output) from cause


def solve_deck(
    deck: Deck, options: RunOptions, status_file: StatusFile, progress: Progress | None, started: float
) -> Results:
    """The stages from model to verification for every load case asked for; writes nothing but the status file."""
    *_, results = solved_case_by_case(deck, options, status_file, progress, started)
    return results


def solved_case_by_case(
    deck: Deck, options: RunOptions, status_file: StatusFile, progress: Progress | None, started: float
) -> Iterator[Results]:
    """As ``solve_deck``: the results so far, before any load case is solved and after each of them."""
    if options.expected and not deck.content.expected:
        raise UsageError("no-expectations", f"{deck.path}: has no expected section to compare with")
    model = build_model(deck)
    load_cases = select_cases(model, options.cases)
    read = time.perf_counter()
    contacts = contacts_of(deck, model)
    model = held_model(model, contacts)
    found = time.perf_counter()
    settings = solver_settings(deck.analysis)
    with timing() as stopwatch:
        model, load_cases = with_settlements(model, contacts, load_cases, settings)
        results = Results(
            deck=deck_record(deck),
            model=model,
            contacts=contacts,
            cases=(),
            notices=notices_of(deck, model, contacts),
            provenance=collect_provenance(),
            settings=settings_in_words(deck, settings),
            time={"read": read - started, "contacts": found - read},
            exit_code=0,
            not_done=tuple(case.name for case in load_cases),
        )
        yield results
        for case in load_cases:
            solved = solve_case(deck, model, contacts, case, settings, status_file, progress)
            results = with_case(results, solved, time.perf_counter() - found, stopwatch)
            yield as_expected(results, deck) if options.expected and not results.not_done else results


def with_case(results: Results, case: CaseResult, seconds: float, stopwatch: Stopwatch) -> Results:
    """Results so far with one load case more.

    seconds : since solving began
    """
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


def as_expected(results: Results, deck: Deck) -> Results:
    """Results with a warning for every figure that is not what the deck expects."""
    found = [Notice("warning", "not-as-expected", text) for text in differences(results.cases, deck.content.expected)]
    notices = (*results.notices, *found)
    return replace(results, notices=notices, exit_code=exit_code(results.cases, notices))


def parts_of_solve(cases: Sequence[CaseResult], stopwatch: Stopwatch) -> dict[str, float]:
    """Seconds of the programs, as they were recorded, and of what is done before, between and after them."""
    programs = float(sum(program.seconds for case in cases for program in case.solution.programs))
    parts = {"programs": programs, **stopwatch.seconds}
    return {f"solve/{part}": parts[part] for part in PARTS_OF_SOLVE if part in parts}


def title_of(deck: Deck) -> str:
    """The title of a deck; the name of its file where it has none."""
    return deck.content.title or deck.path.name


def with_settlements(
    model: Model, contacts: Contacts, load_cases: tuple[LoadCase, ...], settings: SolverSettings
) -> tuple[Model, tuple[LoadCase, ...]]:
    """Load cases to be solved in which a support gives way get the reaction that it starts from."""
    solids = solids_of(model, contacts)

    def ready_case(case: LoadCase) -> LoadCase:
        settlement = posed(solids.model, solids.contacts, solids.load_case(case), settings).settlement
        return case if settlement is None else with_reference(case, settlement.reference)

    ready = {case.name: ready_case(case) for case in load_cases}
    everything = tuple(ready.get(case.name, case) for case in model.load_cases)
    return replace(model, load_cases=everything), tuple(ready.values())


def solve_case(
    deck: Deck,
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    settings: SolverSettings,
    status_file: StatusFile,
    progress: Progress | None,
) -> CaseResult:
    """Assemble, solve and verify one load case."""

    def log(record: IterationRecord) -> None:
        status_file.add(load_case.name, record)
        if progress is not None:
            progress(load_case.name, record)

    model = model.of_case(load_case)
    solids = solids_of(model, contacts)

    def ask(case: LoadCase) -> tuple[Solution, Checks]:
        on_solids = (solids.model, solids.contacts, solids.load_case(case))
        if has_conditions_on_interfaces(deck.analysis, solids.model, solids.contacts):
            from mbla.program.resultants import assemble_convex
            from mbla.solution.resultants.solve_convex import solve_convex

            with stage("assemble"):
                convex = assemble_convex(*on_solids, deck.analysis.contact_model)
            solution = solve_convex(convex, deck.analysis, settings, log)
        else:
            with stage("assemble"):
                reduced = reduced_program(deck, solids, assemble(*on_solids))
            solution = solve(reduced, deck.analysis, settings, log)
        solution = solution_on_blocks(solution, solids)
        return solution, verify(model, contacts, case, solution)

    if load_case.tilt is None:
        solution, checks = ask(load_case)
    else:
        answer = solve_tilt(model, contacts, load_case, ask)
        load_case, solution = answer.load_case, answer.solution
        checks = verify(model, contacts, load_case, solution)
    status = verified_status(solution, checks)
    status_file.remark(f"{load_case.name}: {status}")
    return CaseResult(load_case, solution, checks, status)


def with_loads_found(model: Model, cases: Sequence[CaseResult]) -> Model:
    """The model with the load cases as they were solved: the loads of a tilting table are those of its angle."""
    found = {case.load_case.name: case.load_case for case in cases}
    return replace(model, load_cases=tuple(found.get(case.name, case) for case in model.load_cases))


def reduced_program(deck: Deck, solids: Solids, program: Program) -> Reduced:
    """What of the program has to be solved, and what each reduction left out."""
    associative = deck.analysis.flow_rule == "associative"
    if has_conditions_on_interfaces(
        deck.analysis, solids.model, solids.contacts
    ):  # conditions of whole interfaces: solved as they are
        whole = unreduced(program, solids.contacts)
        return replace(whole, steps=(glued_step(solids, size_of([program])),))
    allowed = allowed_reductions(deck.analysis)
    reduced = reduce_program(solids.model, solids.contacts, program, allowed, associative=associative)
    steps = told_apart(reduced.steps, switched_on=deck.analysis.reductions)
    return replace(reduced, steps=(glued_step(solids, steps[0].before), *steps))


def contacts_of(deck: Deck, model: Model) -> Contacts:
    """Contacts of a model; blocks that overlap, bent faces in contact, glue that leaves nothing to move are faults."""
    try:
        contacts = find_contacts(model, deck.contacts)
    except PairsRefused as refused:
        raise DeckError([deck.fault_at(("blocks",), refused.message)]) from refused
    except SupportsAtOdds as refused:
        raise DeckError([deck.fault_at(("supports",), refused.message)]) from refused
    except PointsRefused as refused:
        raise DeckError([deck.fault_at(("contacts", "points", "spacing"), refused.message)]) from refused
    faults = [
        deck.fault_at(("blocks",), Message("blocks-overlap", message))
        for message in overlap_messages(model, contacts.report)
    ]
    faults += bent_faults(deck, model, contacts)
    faults += [deck.fault_at(path, message) for path, message in glue_findings(model, contacts)]
    if faults:
        raise DeckError(first_faults(faults))
    return contacts


def notices_of(deck: Deck, model: Model, contacts: Contacts) -> tuple[Notice, ...]:
    """What every stage before the solver remarked, in their order."""
    return (
        *deck.notices,
        *model.notices,
        *contacts.report.notices,
        *program_notices(model, contacts, deck.analysis),
    )


def select_cases(model: Model, names: Sequence[str]) -> tuple[LoadCase, ...]:
    """The load cases of those names in the order of the deck, all if none is named; UsageError for an unknown one.

    The name of a load that travels stands for all its positions.
    """
    known = dict.fromkeys(case.deck_name for case in model.load_cases)
    for name in names:
        if name not in known and name not in [case.name for case in model.load_cases]:
            raise UsageError("unknown-load-case", f"no load case {name} in the deck; it has {', '.join(known)}")
    return tuple(case for case in model.load_cases if not names or case.name in names or case.deck_name in names)
