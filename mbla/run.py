"""One deck to one result: the table of contents of the program."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from mbla.assembly import Assembly, build_assembly
from mbla.contacts.known import KnownContacts
from mbla.deck import Deck, read_deck
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.model.model import LoadCase, select_cases
from mbla.process.run_options import RunOptions as RunOptions
from mbla.process.stopwatch import Stopwatch, timing
from mbla.results.collapse.state_remarks import OF_STATE, state_remarks
from mbla.results.files import OutputFolder
from mbla.results.partial import Partial
from mbla.results.provenance import as_expected, results_before, with_case
from mbla.results.results import CaseResult, Results
from mbla.results.resumed import NOTHING_DONE, Resumed, resumed
from mbla.results.series import position_to_push
from mbla.results.status_file import StatusFile
from mbla.results.write import write_results
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.sequence.sequence import answered
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.settings import SolverSettings, settings_for, solver_settings
from mbla.solution.solution import WITH_VALUE, IterationRecord, Status
from mbla.solution.standing.standing import StressFreeStates
from mbla.solution.time_history.progress import TimeProgress

if TYPE_CHECKING:
    from mbla.solution.time_history.checkpoint import Unfinished

Progress = Callable[[str, IterationRecord | TimeProgress], None]
T = TypeVar("T")
Tell = Callable[[Callable[[], T]], None]
"""is told how to make what there is of something that takes long; may be made at any time, while it goes on"""


def unheard(make: Callable[[], object]) -> None:
    """Nobody asks."""


def run(deck_path: Path, options: RunOptions, progress: Progress | None = None) -> Results:
    """Solve every load case of a deck and write the result files.

    progress : called once per iteration, or step in time, with the name of the load case

    Raises
    ------
    DeckError, UsageError, FileError, LimitError, SolverError
        an earlier result stays as it was
    StoppedRun
        of whatever else ends it: what is done is written (:mod:`mbla.results.partial`)
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
    partial = Partial(out, output)

    def each(case: str, record: IterationRecord | TimeProgress) -> None:
        partial.keep()
        if progress is not None:
            progress(case, record)

    try:
        with out:
            try:
                status_file = StatusFile(out.open_live(f"{stem}.sta"), deck.title)
                earlier = resumed(deck, folder) if options.resume else NOTHING_DONE
                for results in solved_case_by_case(deck, options, status_file, each, started, partial.at_work, earlier):
                    partial.done(results)
                return write_results(results, out, output)
            except BaseException:
                partial.keep_status()
                raise
    except BaseException as cause:
        stopped = None if out.in_place else partial.stopped(cause)
        if stopped is None:
            raise
        raise stopped from cause


def solve_deck(
    deck: Deck,
    options: RunOptions,
    status_file: StatusFile,
    progress: Progress | None,
    started: float,
    states: StressFreeStates | None = None,
    contacts: KnownContacts | None = None,
) -> Results:
    """The stages from model to verification for every load case asked for; writes nothing but the status file.

    states   : of stress-free assemblies that are known from decks before, to which those of this one are added
    contacts : of the deck before, in whose place those of this one are kept
    """
    *_, results = solved_case_by_case(deck, options, status_file, progress, started, states=states, contacts=contacts)
    return results


def solved_case_by_case(
    deck: Deck,
    options: RunOptions,
    status_file: StatusFile,
    progress: Progress | None,
    started: float,
    at_work: Tell[Results] = unheard,
    earlier: Resumed = NOTHING_DONE,
    states: StressFreeStates | None = None,
    contacts: KnownContacts | None = None,
) -> Iterator[Results]:
    """As ``solve_deck``: the results so far, before any load case is solved and after each of them.

    at_work : told how to make results with what there is of a load case that takes long
    earlier : what a run before has left, which is not done again

    Raises DeckError for faults of the deck, UsageError for load cases that it does not have and where expectations are
    asked for and it has none.
    """
    if options.expected and not deck.content.expected:
        raise UsageError("no-expectations", f"{deck.path}: has no expected section to compare with")
    assembly, load_cases, stages = _assembled(deck, options, started, contacts)
    found = time.perf_counter()
    settings = solver_settings(deck.analysis)
    with timing() as stopwatch:
        results = results_before(deck, assembly, settings, stages)
        results = replace(results, not_done=tuple(case.name for case in load_cases))
        yield results
        states = StressFreeStates() if states is None else states
        for load_case in load_cases:
            tell = _teller(at_work, results, found, stopwatch)
            travels = load_case.question.place.count  # which of its positions is pushed is known when all are solved
            case = replace(load_case, pushover=None) if travels else load_case
            solved = earlier.done.get(case.name)
            if solved is None:
                begin = earlier.unfinished.get(case.name)
                solved = solve_case(deck, assembly, case, settings, status_file, progress, tell, states, begin)
            results = with_case(results, solved, time.perf_counter() - found, stopwatch)
            left = {each.deck_name for each in load_cases if each.name in results.not_done}
            chosen = None if load_case.deck_name in left else position_to_push(load_case, assembly.model, results.cases)
            if chosen is not None:
                results = replace(results, not_done=(chosen.load_case.name, *results.not_done))
                yield results
                tell = _teller(at_work, results, found, stopwatch)
                pushed = push_position(deck, assembly, chosen, settings, status_file, progress, tell)
                results = with_case(results, pushed, time.perf_counter() - found, stopwatch)
            yield as_expected(results, deck) if options.expected and not results.not_done else results


def _assembled(
    deck: Deck, options: RunOptions, started: float, contacts: KnownContacts | None
) -> tuple[Assembly, tuple[LoadCase, ...], dict[str, float]]:
    """Assembly, load cases asked for, and the seconds that model, contacts and soil took."""
    model = build_model(deck)
    load_cases = select_cases(model, options.cases)
    read = time.perf_counter()
    assembly = build_assembly(deck, model, contacts)
    found = time.perf_counter()
    stages = {"read": read - started, "contacts": found - read}
    if model.soils:
        from mbla.soil_mesh.moved_soil import with_moved_soil  # late: few decks have cells

        assembly = with_moved_soil(deck, assembly, load_cases)
        load_cases = select_cases(assembly.model, options.cases)
        stages["soil"] = time.perf_counter() - found
    return assembly, load_cases, stages


def _teller(at_work: Tell[Results], results: Results, found: float, stopwatch: Stopwatch) -> Tell[CaseResult]:
    """How a load case tells what there is of it: it becomes the last of the results, and is not done."""

    def tell(part: Callable[[], CaseResult]) -> None:
        def so_far() -> Results:
            more = with_case(results, part(), time.perf_counter() - found, stopwatch)
            return replace(more, not_done=results.not_done)

        at_work(so_far)

    return tell


def solve_case(
    deck: Deck,
    assembly: Assembly,
    load_case: LoadCase,
    settings: SolverSettings,
    status_file: StatusFile,
    progress: Progress | None,
    tell: Tell[CaseResult] = unheard,
    states: StressFreeStates | None = None,
    begin: Unfinished | None = None,
) -> CaseResult:
    """One load case solved and verified, with what is asked besides.

    tell   : told how to make the load case as far as it has come, where it is pushed on, or followed in time
    states : of stress-free assemblies that are known from load cases before
    begin  : of its time history that was stopped, with which that goes on
    """
    log = _log_of(load_case, status_file, progress)
    answer = answered(assembly, load_case, settings, log, states)
    if load_case.time_history is not None and answer.status is Status.SOLVED:
        answer = _in_time(deck, assembly, answer, settings, log, tell, begin)
    status_file.remark(f"{load_case.name}: {answer.status}")
    case = CaseResult(answer.load_case, answer.solution, answer.checks, answer.status)
    if load_case.modes and (load_case.has_load_factor or load_case.time_history is not None):
        case = _with_modes(deck, assembly, case)
    if load_case.pushover is not None:
        case = _pushed(deck, assembly, case, settings_for(load_case, settings), log, tell)
    return _finished(assembly, _with_limits(deck, assembly, case, log))


def _with_modes(deck: Deck, assembly: Assembly, case: CaseResult) -> CaseResult:
    """A load case with its modes of vibration beside its answer; with a time history those after it as well."""
    from mbla.solution.modes.checked import checked_modes_of  # late: few load cases ask for them

    modes, remarks = checked_modes_of(assembly, case.load_case, case.load_case.modes)
    case = case.with_further(replace(case.solution.further, modes=modes), remarks)
    if case.load_case.time_history is None or case.status not in WITH_VALUE:
        return case
    from mbla.solution.modes.after import checked_modes_after

    history = case.solution.further.time_history
    modes, remarks = checked_modes_after(assembly, deck.contacts, case.load_case, history)
    return case.with_further(replace(case.solution.further, modes_after=modes), remarks)


def _with_limits(deck: Deck, assembly: Assembly, case: CaseResult, log: Log) -> CaseResult:
    """A solved load case with its sensitivities and its geometric safety, where the deck asks for them."""
    load_case, further = case.load_case, case.solution.further
    if deck.analysis.sensitivity is not False:
        from mbla.solution.further.sensitivity.sensitivity import sensitivity_of  # late: few decks ask for it

        slopes, remarks = sensitivity_of(deck, assembly, load_case, case.solution, case.checks)
        further = replace(further, sensitivity=slopes)
        case = case.with_further(further, remarks)
    if deck.analysis.geometric_safety:
        from mbla.solution.further.geometric_safety.find import geometric_safety_of  # late: few decks ask for it

        safety, remarks = geometric_safety_of(assembly, load_case, deck.analysis, log)
        case = case.with_further(replace(further, geometric_safety=safety), remarks)
    return case


def push_position(
    deck: Deck,
    assembly: Assembly,
    case: CaseResult,
    settings: SolverSettings,
    status_file: StatusFile,
    progress: Progress | None,
    tell: Tell[CaseResult] = unheard,
) -> CaseResult:
    """A position of a travelling load that was solved, with its pushover; ``tell`` as in ``solve_case``."""
    log = _log_of(case.load_case, status_file, progress)
    remarks = tuple(remark for remark in case.solution.remarks if remark.identifier not in OF_STATE)
    case = replace(case, solution=replace(case.solution, remarks=remarks))
    return _finished(assembly, _pushed(deck, assembly, case, settings, log, tell))


def _log_of(
    load_case: LoadCase, status_file: StatusFile, progress: Progress | None
) -> Callable[[IterationRecord | TimeProgress], None]:
    """Writes iterations of a load case, or its steps in time, to the status file, and tells of them."""

    def log(record: IterationRecord | TimeProgress) -> None:
        status_file.add(load_case.name, record)
        if progress is not None:
            progress(load_case.name, record)

    return log


def _pushed(
    deck: Deck,
    assembly: Assembly,
    case: CaseResult,
    settings: SolverSettings,
    log: Log,
    tell: Tell[CaseResult],
) -> CaseResult:
    """A load case with its pushover."""
    from mbla.solution.pushover.push import PushoverResult, push  # late: few load cases are

    def beside(found: PushoverResult) -> CaseResult:
        pushover, remarks = found
        return case.with_further(replace(case.solution.further, pushover=pushover), remarks)

    def so_far(make: Callable[[], PushoverResult]) -> None:
        tell(lambda: _finished(assembly, beside(make())))

    solved = case.status is Status.SOLVED
    return beside(push(assembly, deck.contacts, case.load_case, case.solution, settings, log, solved, so_far))


def _in_time(
    deck: Deck,
    assembly: Assembly,
    stands: SolvedCase,
    settings: SolverSettings,
    log: Callable[[TimeProgress], None],
    tell: Tell[CaseResult],
    begin: Unfinished | None,
) -> SolvedCase:
    """A load case that stands, followed in time; not verified where it cannot be."""
    from mbla.solution.sequence.history import Part, followed  # late: few load cases are

    def so_far(make: Callable[[], Part]) -> None:
        def part() -> CaseResult:
            answer, unfinished = make()
            case = CaseResult(answer.load_case, answer.solution, answer.checks, answer.status)
            return replace(_finished(assembly, case), checkpoint=unfinished)

        tell(part)

    return followed(assembly, deck.contacts, stands, settings, log, so_far, begin)


def _finished(assembly: Assembly, case: CaseResult) -> CaseResult:
    """A load case with the remarks that are made last, and what a code says of it."""
    remarks = (*case.solution.remarks, *state_remarks(assembly.model, case.load_case, case.solution))
    case = replace(case, solution=replace(case.solution, remarks=remarks))
    if case.load_case.assessment is None:
        return case
    from mbla.codes.assess import assessed  # few decks ask

    return assessed(assembly, case)
