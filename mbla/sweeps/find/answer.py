"""The result for one value of a parameter, on which side of the target it is, and its slope.

Of a load factor the side is known even where there is none: a structure that does not stand is below every target, one
that no load brings down above it.

A structure in time that falls is above every greatest displacement; one that does not stand at rest falls at once. One
that has not fallen, but still moves far where its duration ends, tells nothing of falls
(:mod:`mbla.solution.time_history.still_moves`).

That the dead load is just carried is asked by the greatest pressure that is carried with it in all joints, which passes
through zero there (:mod:`mbla.solution.further.geometric_safety.joint_pressure`).
"""

from __future__ import annotations

import io
import math
from dataclasses import dataclass, replace

from mbla.assembly import build_assembly
from mbla.contacts.known import KnownContacts
from mbla.deck import Deck, read_deck_text
from mbla.errors import DeckError, UsageError
from mbla.model import Model, build_model
from mbla.model.model import LoadCase, select_cases
from mbla.program.build import build_program
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.results.outcome import history_of, least_known, locked_in, result_of
from mbla.results.status_file import StatusFile
from mbla.run import solve_case
from mbla.solution.further.geometric_safety.joint_pressure import joint_pressure
from mbla.solution.further.geometric_safety.reference_pressure import pressed_by
from mbla.solution.further.sensitivity.sensitivity import slope_by
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Standing, StandingResult, Status
from mbla.solution.standing.standing import standing_where_carried
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.time_history.still_moves import still_moves
from mbla.sweeps.find.question import FindQuestion

SAME = 1e-7
"""Difference of load factors, relative, that is none"""
SOLVED = 1e-8
"""What a load factor may be off, over itself or its target, even where its bounds are closer: by the cone solver"""
SCATTER = 5e-3
"""Steps of a load factor without bounds, over itself or its target, that come of how its path is followed"""

REFUSED = "refused"
"""status of a value with which the deck is not valid"""
WITHOUT_SIZE = {
    math.inf: "some forces carry the dead load whatever the pressure in the joints, as in a wedge",
    -math.inf: "the dead load alone is not carried, and no pressure in the joints changes that",
}
"""What a structure that has no limit of pressure does"""


@dataclass(frozen=True)
class Evaluation:
    """The result for one value.

    x        : the value
    status   : of the load case; of ``stands`` whether it does, by proved bounds
    verified : whether code that did not solve it confirms it
    result   : load factor, pressure in units of stress of the deck, or peak in its unit of length; nan where there is
               none
    y        : result less target; infinite where only the side is known, nan where nothing is
    slope    : of the result by the value; nan where it is not known
    words    : why there is no result; empty where there is one
    solves   : of programs with a load factor
    bounds   : proved, of an associative result; nan without
    uncertainty : absolute, of the result: within that of the target it meets it
    scatter     : absolute, of the result: how far it may step where the parameter hardly changes
    """

    x: float
    status: str
    verified: bool = False
    result: float = math.nan
    y: float = math.nan
    slope: float = math.nan
    words: str = ""
    solves: int = 1
    bounds: tuple[float, float] = (math.nan, math.nan)
    uncertainty: float = 0.0
    scatter: float = 0.0


def answer_at(deck: Deck, question: FindQuestion, x: float, contacts: KnownContacts | None = None) -> Evaluation:
    """The result for a value; a deck that is refused with it has none, and says why.

    contacts : of the value before, in whose place those of this one are kept
    """
    try:
        varied, structure = _structure(deck, question, f"{question.parameter}={x!r}", contacts=contacts)
    except DeckError as error:
        return Evaluation(x, REFUSED, words=str(error.faults[0]), solves=0)
    answer = _moved if question.in_time else _stands if question.kind == "stands" else _factor
    return answer(varied, question, structure, x)


def refuse_unfit_deck(deck: Deck, question: FindQuestion) -> None:
    """Raises DeckError with the faults that the deck has as it stands, where it has some."""
    _structure(deck, question)


def _structure(
    deck: Deck, question: FindQuestion, *overrides: str, contacts: KnownContacts | None = None
) -> tuple[Deck, LoadedAssembly]:
    """The deck with some values changed, and its structure; raises DeckError where it is refused."""
    varied = read_deck_text(deck.sources[0].text, deck.path, (*deck.overrides, *overrides), expected=False)
    model = build_model(varied)
    return varied, LoadedAssembly(build_assembly(varied, model, contacts), _case(model, question))


def _case(model: Model, question: FindQuestion) -> LoadCase:
    """Raises UsageError for one that has several answers, or another than is looked for."""
    cases = select_cases(model, (question.load_case,))
    name, case = question.load_case, cases[0]
    against = case.question.no_target
    if question.in_time:
        if case.time_history is not None:
            return case
        raise UsageError("find-option", f"--case {name} has no time_history, of which {question.kind} is asked")
    if len(cases) > 1 and not against:
        words = f"{name} travels: choose one of its positions, such as {case.name}"
    elif against and (question.kind != "stands" or not case.question.multiplies):
        words = f"{name}: {against}"
    else:
        return case
    raise UsageError("find-option", f"--case {words}")


# --- load factors ---------------------------------------------------------------------------------------------------


def _factor(deck: Deck, question: FindQuestion, structure: LoadedAssembly, x: float) -> Evaluation:
    """A load factor of the load case, as ``mbla run`` gives it."""
    log = StatusFile(io.StringIO(), deck.title)
    case = solve_case(deck, structure.assembly, structure.load_case, solver_settings(deck.analysis), log, None)
    status, verified = case.status.value, case.checks.verified
    if case.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        side = -math.inf if case.status is Status.NO_EQUILIBRIUM else math.inf
        return Evaluation(x, status, verified, y=side, words=case.solution.reason)
    own = result_of(case)
    if locked_in(case):  # from the stress-free assembly it falls under no live load at all
        return Evaluation(x, Standing.SELF_STRESS.value, verified, y=-math.inf, words=case.solution.reason)
    if own is None:
        return Evaluation(x, status, verified, words=case.solution.reason or "it is not verified")
    result = least_known(case) if question.kind == "least_load_factor" else own.load_factor
    slope, bounds, associative = math.nan, (math.nan, math.nan), case.solution.associative
    if associative is not None and math.isclose(associative.load_factor, result, rel_tol=SAME):
        bounds = case.checks.static_bound, case.checks.kinematic_bound
        # also of a load factor without dilatancy: never above the associative one, it touches that where both are one
        structure = replace(structure, load_case=case.load_case)
        slope = slope_by(deck, structure, case.solution, case.checks, question.path)
    size, y = max(abs(result), abs(question.target)), result - question.target
    uncertainty = max(_rounding(case.checks, bounds) * size, _farther(result, bounds))
    scatter = 0.0 if math.isfinite(bounds[0]) else SCATTER * size
    return Evaluation(x, status, verified, result, y, slope, bounds=bounds, uncertainty=uncertainty, scatter=scatter)


def _rounding(checks: Checks, bounds: tuple[float, float]) -> float:
    """What a load factor may be off whatever its bounds, relative; without them as its residual tells."""
    return SOLVED if math.isfinite(bounds[0]) else max(SAME, min(checks.complementarity_residual, SOLVED_RESIDUAL))


def _farther(result: float, bounds: tuple[float, float]) -> float:
    """What a result may be off by its bounds; 0 without."""
    return max(0.0, result - bounds[0], bounds[1] - result)


# --- structures in time ---------------------------------------------------------------------------------------------

CUT_OFF = "it moved as far as stop.displacement allows, and might have {} otherwise: give it more"
MOVES_ON = "a time history that ends while the structure still moves tells nothing of falls: give a longer duration"
FELL, STOOD, MOVED = "falls", "does not fall", "still moves"
"""status of a structure that was followed in time"""


def _moved(deck: Deck, question: FindQuestion, structure: LoadedAssembly, x: float) -> Evaluation:
    """The greatest displacement of the load case in time, as ``mbla run`` gives it, and whether a block falls."""
    log = StatusFile(io.StringIO(), deck.title)
    case = solve_case(deck, structure.assembly, structure.load_case, solver_settings(deck.analysis), log, None)
    verified, reason, found = case.checks.verified, case.solution.reason, history_of(case)
    if case.status is Status.NO_EQUILIBRIUM:
        return Evaluation(x, case.status.value, verified, y=math.inf, words=reason)
    if found is None:
        return Evaluation(x, case.status.value, verified, words=reason or "it is not verified")
    if found.falls >= 0:
        return Evaluation(x, FELL, verified, found.peak, math.inf)
    over = found.peak - question.target
    if case.solution.further.time_history.end is HistoryEnd.DISPLACED and (question.kind == "falls" or over < 0.0):
        words = CUT_OFF.format("fallen" if question.kind == "falls" else "moved further")
        return Evaluation(x, STOOD, verified, found.peak, words=words)
    moves = still_moves(structure.assembly.model.of_case(case.load_case), case.solution.further.time_history)
    if moves and question.kind == "falls":
        return Evaluation(x, MOVED, verified, found.peak, words=MOVES_ON)
    return Evaluation(x, STOOD, verified, found.peak, over if question.kind == "peak" else -math.inf)


# --- standing -------------------------------------------------------------------------------------------------------


def _stands(deck: Deck, question: FindQuestion, structure: LoadedAssembly, x: float) -> Evaluation:
    """The greatest pressure in all joints that is carried with the dead load, and on which side of nothing it is."""
    found = joint_pressure(structure, deck.analysis)
    value, (least, most), verified = found.value, found.bounds, found.checks.verified
    if not math.isfinite(value):
        side = found.status.value if math.isnan(value) else "stands" if value > 0.0 else "does not stand"
        words = WITHOUT_SIZE.get(value) or found.solution.reason or "it is not verified"
        return Evaluation(x, side, verified, y=value, words=words, solves=found.solves)
    stands = "stands" if least >= 0.0 else "does not stand" if most < 0.0 else "at the limit"

    def posed(other: LoadedAssembly) -> LoadedAssembly:
        return pressed_by(other, found.reference_pressure, found.unit)

    own, unit = slope_by(deck, found.posed, found.solution, found.checks, question.path, posed), found.unit
    value, least, most = unit * value, unit * least, unit * most  # its unit changes with the structure
    uncertainty = _farther(value, (least, most))
    return Evaluation(x, stands, verified, value, value, unit * own, "", found.solves, (least, most), uncertainty)


def standing_at(deck: Deck, question: FindQuestion, x: float) -> StandingResult:
    """Whether it stands from the stress-free assembly for a value at which some forces carry the dead load."""
    varied, structure = _structure(deck, question, f"{question.parameter}={x!r}")
    settings = solver_settings(varied.analysis)
    case = replace(structure.load_case, question=LOAD_FACTOR)
    return standing_where_carried(build_program(structure.assembly, case, settings.analysis))
