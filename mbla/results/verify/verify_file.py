"""``mbla verify``: everything that a result file claims, recomputed from what is in it alone, with no solver.

Model, contacts and loads are built again from the deck in the file (``rebuilt``). Of every case the forces and
mechanisms are taken, and all that follows from them is found again: velocities, modes, parts, work, residuals, bounds,
ends of ranges, standing, angle, status. The file that this gives must be the one at hand, dataset by dataset. So the
file is believed in nothing but the fields that say what the run alone can tell (``told`` of
:class:`mbla.results.record.quantity.Quantity`), which are marked in it and named in what is printed.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.deck import Deck
from mbla.deck.sections.accuracy import knobs_of
from mbla.model.model import Model
from mbla.program.build import crushable_interfaces, takes_stress_blocks
from mbla.results.exit_status import exit_code
from mbla.results.hdf5.result_file import differences_of_file, read_results_hdf5, write_results_hdf5
from mbla.results.outcome import WITH_VALUE, locked_in, presumes_standing
from mbla.results.results import CaseResult, Results
from mbla.results.verify.rebuilt import rebuilt
from mbla.solution.derived import with_derived
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Solution, Standing, Status
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.verify import level_bound, verify
from mbla.solution.verification.verify_points import verified_status


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what is no number fulfils no condition
def verify_file(path: Path) -> tuple[Results, tuple[str, ...]]:
    """Results with checks, status and exit status recomputed, and where they disagree with what the file says.

    Raises
    ------
    FileError
        as ``read_results_hdf5`` does
    """
    results = read_results_hdf5(path)
    deck, disagreements = rebuilt(results)
    again = _recomputed(results, deck)
    for case in again.cases:
        found = (*_unproved(case), *(() if deck is None else _left_out(case, deck)))
        disagreements += tuple(f"{case.load_case.name}: {text}" for text in found)
    disagreements += differences_of_file(path, write_results_hdf5(again))
    code = exit_code(again.cases, again.notices)  # of a stopped run the file has that of what stopped it
    proved = results.complete and not any(presumes_standing(case) for case in again.cases)
    if (disagreements or not proved) and code in (0, 5):
        code = 4
    return replace(again, exit_code=code), disagreements


def _recomputed(results: Results, deck: Deck | None) -> Results:
    """The results with all that follows from deck, forces and mechanisms in place of what the file says of it."""
    cases = tuple(_recomputed_case(results, case, deck) for case in results.cases)
    found = {case.load_case.name: case.load_case for case in cases}
    model = replace(results.model, load_cases=tuple(found.get(case.name, case) for case in results.model.load_cases))
    code = exit_code(cases, results.notices) if results.complete else results.exit_code
    return replace(results, model=model, cases=cases, exit_code=code)


def _recomputed_case(results: Results, case: CaseResult, deck: Deck | None) -> CaseResult:
    load_case, contacts = case.load_case, results.contacts
    model: Model = results.model.of_case(load_case)
    solution = case.solution
    if deck is not None:
        crushable = bool(crushable_interfaces(model, contacts).any())
        solution = _as_asked_for(solution, deck, crushable and takes_stress_blocks(deck.analysis))
    solution = with_derived(model, contacts, load_case, solution)
    if load_case.tilt is not None:
        upright = level_bound(model, contacts, load_case, solution)
        load_case = replace(load_case, tilt=replace(load_case.tilt, upright=upright))
    checks = verify(model, contacts, load_case, solution)
    return CaseResult(load_case, solution, checks, verified_status(solution, checks))


def _as_asked_for(solution: Solution, deck: Deck, stress_blocks: bool) -> Solution:
    """The solution by the flow rule, the contact model and the solver that its deck asks for."""
    analysis, settings = deck.analysis, solver_settings(deck.analysis)
    asked = {settings.gap} if analysis.flow_rule == "associative" else {settings.residual, settings.gap}
    return replace(
        solution,
        flow_rule=analysis.flow_rule,
        contact_model=analysis.contact_model,
        stress_blocks=stress_blocks,
        solver=settings.solver,
        sides=0 if solution.outer is None else analysis.sides,
        tolerance_requested=solution.tolerance_requested
        if solution.tolerance_requested is None or solution.tolerance_requested in asked
        else settings.residual,
    )


def _unproved(case: CaseResult) -> list[str]:
    """Claims of a case that do not follow from what they must follow from."""
    found, solution, checks = [], case.solution, case.checks
    associative, standing = solution.associative, solution.standing
    if associative is not None:
        least, most = checks.static_bound, checks.kinematic_bound
        room = SOLVED_RESIDUAL * max(abs(most), abs(least))
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


def _left_out(case: CaseResult, deck: Deck) -> list[str]:
    """What the deck asks for and the file neither has nor explains."""
    solution, knobs = case.solution, knobs_of(deck.analysis)
    claims = solution.status in (*WITH_VALUE, Status.UNBOUNDED)
    missing = ["standing"] if knobs.standing and claims and solution.standing is None else []
    if solution.mechanics is None or solution.conditions_on_interfaces:
        return [_lacks(what) for what in missing]
    explained = any(remark.identifier in ("range-not-computed", "range-not-found") for remark in solution.remarks)
    if knobs.range and not explained and not _by_normality(solution):
        missing += [f"{end} end of the range" for end in ("lower", "upper") if getattr(solution, end) is None]
    if deck.analysis.force_ranges and solution.force_ranges is None:
        missing.append("ranges of normal forces")
    return [_lacks(what) for what in missing]


def _by_normality(solution: Solution) -> bool:
    """Whether the forces are those of associative flow: by that rule, or for want of joints that could flow."""
    own, associative = solution.mechanics, solution.associative
    return own is not None and associative is not None and np.array_equal(own.mechanism, associative.mechanism)


def _lacks(what: str) -> str:
    return f"the deck asks for the {what}, which the file does not have"
