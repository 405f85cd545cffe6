"""``mbla verify``: everything that a result file claims, recomputed from what is in it alone, with no solver.

Model, contacts and loads are built again from the deck in the file and must come out the same: residuals and bounds
prove an answer for the arrays of a file, and that these arrays are the structure that its deck describes follows from
its texts and the meshes and tables that it names. Of every case the forces and mechanisms are taken, and all that
follows from them is found again: velocities, modes, parts, work, residuals, bounds, the least state, standing, angle,
status. The file that this gives must be the one at hand, dataset by dataset. So nothing in the file is trusted but the
fields that say what the run alone can state (``unverified`` of :class:`mbla.results.quantities.quantity.Quantity`),
which are marked in it and named in what is printed.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.assembly.structure_at import StructureAt
from mbla.codes.assess import assessment_of
from mbla.deck import Deck
from mbla.errors import DeckError, FileError, Notice
from mbla.model.model import LoadCase
from mbla.program.assemble import yield_limits
from mbla.program.build import crushable_interfaces
from mbla.questions.angle import Angle
from mbla.questions.tilt import Tilt
from mbla.results.exit_status import UNEXPECTED, exit_code
from mbla.results.hdf5.content import content_of
from mbla.results.hdf5.layout import Content, Value
from mbla.results.hdf5.result_file import differences_of_file, read_asked, read_results_hdf5, write_results_hdf5
from mbla.results.outcome import WITH_VALUE, least_factor, locked_in, presumes_standing
from mbla.results.provenance import (
    as_expected,
    deck_of,
    has_its_hash,
    notices_of,
    settings_in_words,
    threads_in_words,
    with_loads_found,
)
from mbla.results.results import CaseResult, PathAgain, PushoverAgain, Results
from mbla.results.verification.asked import (
    Found,
    at_work,
    cases_left_out,
    differences_of_positions,
    differences_of_stop,
    held_against_deck,
)
from mbla.results.verification.modes_after import modes_after_again
from mbla.results.verification.remarks import MADE_LAST, differences_of_remarks, remarks_found_again
from mbla.solution.full_model.derived import with_derived
from mbla.solution.further.further import Further
from mbla.solution.further.sensitivity.sensitivity import sensitivity_of
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.pushover.curve import begun_by, curve_of
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.solution import Solution, Standing, Status
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.geometric_safety import proved
from mbla.solution.verification.modes import checked_modes
from mbla.solution.verification.statics import load_scale
from mbla.solution.verification.tilting_table import found_angle, found_tangent
from mbla.solution.verification.verify import level_bound, verify
from mbla.solution.verification.verify_points import verified_status


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what is no number fulfils no condition
def verify_file(path: Path, *, anew: bool = False) -> tuple[Results, tuple[str, ...]]:
    """Results with checks, status and exit status recomputed, and where they disagree with what the file says.

    anew : whether paths of elastic joints and pushovers are followed anew, with a solver

    Raises FileError as ``read_results_hdf5`` does.
    """
    results = read_results_hdf5(path, to_verify=True)
    deck, of_model = rebuilt(results, read_asked(path, [case.name for case in results.model.load_cases]))
    disagreements, named = of_model, {text.split(" ", 1)[0] for text in of_model}
    again = recomputed(results, deck)
    unconfirmed: tuple[str, ...] = ()
    paths: list[PathAgain] = []
    pushovers: list[PushoverAgain] = []
    for case in again.cases:
        name, found = case.load_case.name, Found(_unproved(results, case))
        if deck is not None:
            found = _held_against(deck, results, case, found)
        if deck is not None and anew:
            from mbla.results.verification.history import held_against_paths, paths_again  # late: it needs solvers

            followed = paths_again(deck, results.assembly, case)
            held_against_paths(found, results.model, case, followed)
            paths += followed
            if not at_work(results, case):
                pushovers += _pushover_anew(deck, results, case, found)
                _history_anew(deck, results, case, found)
        disagreements += tuple(f"{name}: {text}" for text in found.differences)
        unconfirmed += tuple(f"{name}: {text}" for text in (*found.unconfirmed, *found.of_pushover, *found.of_history))
    disagreements += differences_of_stop(results)
    disagreements += () if deck is None else tuple(differences_of_positions(deck, again))
    left_out = cases_left_out(results)
    unconfirmed += left_out if results.complete else ()  # a partial file says that it is one
    of_file = differences_of_file(path, write_results_hdf5(again))
    disagreements += tuple(text for text in of_file if text.split(" ", 1)[0] not in named)
    code = exit_code(again.cases, again.notices)  # of a stopped run the file has that of what stopped it
    proved = results.complete and not unconfirmed and not any(presumes_standing(case) for case in again.cases)
    if (disagreements or not proved) and code in (0, 5):
        code = 4
    seen, pushed = (tuple(paths), tuple(pushovers)) if anew else (None, None)
    again = replace(again, paths_again=seen, pushovers_again=pushed)
    return replace(again, exit_code=code, unconfirmed=unconfirmed), disagreements


def _pushover_anew(deck: Deck, results: Results, case: CaseResult, found: Found) -> list[PushoverAgain]:
    """The pushover of a recomputed case followed anew, where there is one; what it shows is added to what was found."""
    from mbla.results.verification.pushover_again import held_against_pushover, pushover_again  # late: it needs solvers

    again = pushover_again(deck, results.assembly, case)
    if again is None:
        return []
    held_against_pushover(found, results.model, case, again)
    return [again]


def _history_anew(deck: Deck, results: Results, case: CaseResult, found: Found) -> None:
    """The structure of a recomputed case in time once more, where it is followed; what it shows is added."""
    if case.load_case.time_history is not None and case.solution.further.time_history.rows is not None:
        from mbla.results.verification.history_again import held_against_history  # late: it needs solvers

        held_against_history(found, deck, results.assembly, case)


def _held_against(deck: Deck, results: Results, case: CaseResult, known: Found) -> Found:
    """What is found of a recomputed case beside what is known: its parts, its remarks, and what its state rests on."""
    done = not at_work(results, case)
    found = held_against_deck(deck, results.assembly, case, done=done)
    again = remarks_found_again(deck, results.assembly, case)
    again = again if done else tuple(remark for remark in again if remark.identifier not in MADE_LAST)
    remarks = differences_of_remarks(case, again)
    differences = [*known.differences, *found.differences, *remarks]
    return Found(differences, [*known.unconfirmed, *found.unconfirmed], found.of_pushover, found.of_history)


def recomputed(results: Results, deck: Deck | None) -> Results:
    """The results with all that follows from deck, forces and mechanisms in place of what the file states."""
    cases = tuple(_recomputed_case(results, case, deck) for case in results.cases)
    code = exit_code(cases, results.notices) if results.complete else results.exit_code
    return replace(results, assembly=with_loads_found(results.assembly, cases), cases=cases, exit_code=code)


def _recomputed_case(results: Results, case: CaseResult, deck: Deck | None) -> CaseResult:
    load_case, assembly, contacts = case.load_case, results.assembly, results.contacts
    model = assembly.model.of_case(load_case)
    solution = case.solution
    if deck is not None:
        crushable = bool(crushable_interfaces(model, contacts).any())
        solution = _as_asked_for(solution, load_case, deck, crushable=crushable)
    solution = with_derived(assembly, load_case, solution)
    if tilt := load_case.question.record(Tilt):
        tilt = replace(tilt, tangent=found_tangent(model, contacts, tilt, load_case.live_load, solution))
        upright = level_bound(assembly, load_case, tilt.across, solution)
        angle = found_angle(tilt, load_case.live_load, solution)
        load_case = replace(load_case, question=Angle(replace(tilt, upright=upright, angle=angle)))
    checks = verify(assembly, load_case, solution)
    further = _further_again(results, deck, CaseResult(load_case, solution, checks, case.status))
    again = CaseResult(load_case, solution.with_further(further), checks, verified_status(solution, checks))
    return replace(again, assessment=assessment_of(assembly, again))


def _further_again(results: Results, deck: Deck | None, case: CaseResult) -> Further:
    """The further results of a case whose checks were recomputed, as far as they follow from what is known of them."""
    assembly, load_case, solution, further = results.assembly, case.load_case, case.solution, case.solution.further
    rows, safety = further.pushover.rows, further.geometric_safety
    if deck is not None and load_case.pushover is not None and rows is not None and solution.mechanics is not None:
        rows = begun_by(load_case, solution, rows)
        curve = curve_of(assembly, load_case, solution, rows)
        further = replace(further, pushover=replace(further.pushover, rows=rows, curve=curve))
    if len(further.modes):
        there = StructureAt.as_built(assembly, load_case)
        further = replace(further, modes=checked_modes(there, further.modes)[0])
    if len(further.modes_after):
        further = replace(further, modes_after=modes_after_again(deck, assembly, load_case, further))
    if safety is not None:
        own = proved(assembly, load_case, safety)
        further = replace(further, geometric_safety=replace(safety, verified=own))
    if deck is not None and deck.analysis.sensitivity is not False and not at_work(results, case):
        further = replace(further, sensitivity=_slopes_again(results, case))
    return further


def _slopes_again(results: Results, case: CaseResult) -> tuple[Slope, ...]:
    """Slopes of the load factor from its forces and mechanism, and the deck built anew for each."""
    with tempfile.TemporaryDirectory() as name:
        deck = deck_of(results.deck, Path(name), expected=False)
        slopes, _ = sensitivity_of(deck, results.assembly, case.load_case, case.solution, case.checks)
        return slopes


def _as_asked_for(solution: Solution, load_case: LoadCase, deck: Deck, *, crushable: bool) -> Solution:
    """The solution by the flow rule, the contact model and the solver that its deck asks for."""
    settings = settings_for(load_case, solver_settings(deck.analysis))
    analysis = settings.analysis
    asked = {settings.gap} if analysis.flow_rule == "associative" else {settings.residual, settings.gap}
    return replace(
        solution,
        flow_rule=analysis.flow_rule,
        contact_model=analysis.contact_model,
        stress_blocks=crushable,
        solver=settings.solver,
        tolerance_requested=solution.tolerance_requested
        if solution.tolerance_requested is None or solution.tolerance_requested in asked
        else settings.residual,
    )


def _unproved(results: Results, case: CaseResult) -> list[str]:
    """Claims of a case that do not follow from what they must follow from."""
    found, solution, checks = [], case.solution, case.checks
    model, contacts = results.model.of_case(case.load_case), results.contacts
    associative, standing = solution.associative, solution.standing
    if associative is not None:
        least, most = checks.static_bound, checks.kinematic_bound
        scale = load_scale(model, contacts, case.load_case, yield_limits(model, contacts))  # also without dead load
        nothing = least_factor(model, case.load_case)
        if scale.live > 0.0:  # of a support that gives way, or a force that is sought, the unit is another
            nothing = max(nothing, scale.least_factor(associative.mechanism))
        room = SOLVED_RESIDUAL * max(abs(most), abs(least), nothing)
        if associative.load_factor < least - room or associative.load_factor > most + room:
            found.append(
                f"the associative load factor {associative.load_factor:.8g} is not between its bounds {least:.8g} "
                f"and {most:.8g}"
            )
    if locked_in(case) and case.status in (*WITH_VALUE, Status.UNBOUNDED):
        found.append(f"it cannot be {case.status} and stand only by self-stress, or not at all")
    if standing is not None and standing.verdict is Standing.YES and standing.block is not None:
        found.append("it cannot stand and have a block that falls")
    return found


SAME, SAME_OF_LARGEST = 1e-9, 1e-12
"""Differences of entries, relative to them and to the largest of their kind, that are rounding of another machine."""


def rebuilt(results: Results, asked: Content) -> tuple[Deck | None, tuple[str, ...]]:
    """The deck in a file, None where it cannot be read, and where the file is not what follows from it, in words.

    asked : what the file holds of run, model, contacts and loads
    """
    record = results.deck
    differences = []
    if not has_its_hash(record):
        differences.append("the hash of the deck is not that of its text")
    if record.sources[0][0] != record.name:
        differences.append("the deck does not have the name of its text")
    deck, of_model = _read_again(results, asked, expected=True)
    if of_model:  # a study leaves expectations out, and what only they use is reported as not used
        without, others = _read_again(results, asked, expected=False)
        deck, of_model = (without, others) if deck is None or not others else (deck, of_model)
    return deck, (*differences, *of_model)


def _read_again(results: Results, asked: Content, *, expected: bool) -> tuple[Deck | None, list[str]]:
    """The deck with or without its expectations, None where it is not valid, and what of its model differs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        try:
            deck = deck_of(results.deck, folder, expected=expected)
            return deck, _differences(asked, _content(deck, results, folder))
        except (DeckError, FileError) as error:
            why = error.faults[0] if isinstance(error, DeckError) else error
            return None, [f"the deck in the file is not valid: {str(why).replace(f'{folder}/', '')}"]


def _content(deck: Deck, results: Results, folder: Path) -> Content:
    """The content of a file of the deck's model, without what only solving finds."""
    threads = {"threads": threads_in_words(results.cases)} if results.cases else {}  # no deck says them
    built = replace(
        results,
        notices=notices_of(deck, results.assembly),
        settings=settings_in_words(deck, solver_settings(deck.analysis)) | threads,
    )
    if deck.content.expected and any(notice.identifier == UNEXPECTED for notice in results.notices):
        built = as_expected(built, deck)
    stopped = () if results.complete else results.notices[-1:]  # what stopped a run is not the deck's to say
    notices = _placed_as(results.notices, (*built.notices, *stopped), folder)
    return content_of(replace(built, cases=(), notices=notices, exit_code=results.exit_code))


def _placed_as(stored: Sequence[Notice], notices: Sequence[Notice], folder: Path) -> tuple[Notice, ...]:
    """Notices that begin with a place in the deck, with the folder that the file has there."""
    placed = list(notices)
    for row, (notice, own) in enumerate(zip(notices, stored, strict=False)):
        place = notice.message.removeprefix(f"{folder}/")
        if place != notice.message:
            placed[row] = replace(notice, message=own.message if own.message.endswith(place) else place)
    return tuple(placed)


def _differences(found: Content, built: Content) -> list[str]:
    return [
        f"{path} is not what the deck in the file gives"
        for path in sorted(found.keys() | built.keys())
        if not (path in found and path in built and same(found[path], built[path]))
    ]


def same(one: Value, other: Value) -> bool:
    """Whether two entries are equal up to rounding."""
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape:
        return False
    if first.dtype.kind != "f":
        return bool(np.array_equal(first, second))
    size = float(np.abs(second[np.isfinite(second)]).max(initial=0.0))
    return bool(np.allclose(first, second, rtol=SAME, atol=SAME_OF_LARGEST * size, equal_nan=True))
