"""The result for one value of a parameter, on which side of the target it is, and its slope.

Of a load factor the side is known even where there is none: a structure that does not stand is below every target, one
that no load brings down above it.

That the dead load is just carried is asked by the greatest pressure p that is carried with it in all joints, as of
water (effective forces x obey the joint laws)::

    max p   subject to   A x + d + p A n = 0        n: the area of each contact point, as a normal force

At p = 0 it is the dead load alone. Where that is not carried p is negative: what must press the joints together. So p
passes smoothly through zero, which no multiple of a live load does, and its slope by a parameter is known on both
sides. The program starts from a pressure −P at which it stands, so that its load factor is P + p over a unit.
"""

from __future__ import annotations

import io
import math
from dataclasses import dataclass, replace

import numpy as np

from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model, solids_of
from mbla.deck import Deck, read_deck_text
from mbla.errors import DeckError, UsageError
from mbla.model import Model, build_model
from mbla.model.model import LoadCase, select_cases
from mbla.program.build import build_program
from mbla.results.outcome import least_and_greatest, result_of
from mbla.results.results import CaseResult
from mbla.results.sta import StatusFile
from mbla.run import solve_case
from mbla.solution.sensitivity.sensitivity import slope_by
from mbla.solution.sensitivity.structures import Structure
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.solve import solve
from mbla.solution.verification.statics import contact_resultants
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from mbla.sweeps.find.question import Question

SAME = 1e-7
"""Difference of load factors, relative, that is none"""
PRESSED = 100.0
"""Pressure at which the search for the one in the joints starts, over the weight per area of joints: most structures
stand under that"""
MOST_PRESSED = 1e8
"""The same, beyond which nothing makes it stand"""


@dataclass(frozen=True)
class Answer:
    """The result for one value.

    x        : the value
    result   : load factor or pressure; nan where there is none
    y        : result less target; infinite where only the side is known, nan where nothing is
    slope    : of the result by the value; nan where it is not known
    status   : of the load case; of ``stands`` whether it does, by proved bounds
    verified : whether code that did not solve it confirms it
    words    : why there is no result; empty where there is one
    solves   : of programs with a load factor
    bounds   : proved, of an associative result; nan without
    """

    x: float
    result: float
    y: float
    slope: float
    status: str
    verified: bool
    words: str = ""
    solves: int = 1
    bounds: tuple[float, float] = (math.nan, math.nan)


def answer_at(deck: Deck, question: Question, x: float) -> Answer:
    """The result for a value; a deck that is refused with it has none, and says why."""
    text = f"{question.parameter}={x!r}"
    try:
        varied = read_deck_text(deck.sources[0].text, deck.path, (*deck.overrides, text), expected=False)
        model = build_model(varied)
        contacts = contacts_of(varied, model)
    except DeckError as error:
        return Answer(x, math.nan, math.nan, math.nan, "refused", verified=False, words=str(error.faults[0]), solves=0)
    structure = Structure(held_model(model, contacts), contacts, _case(model, question.load_case))
    return (
        _stands(varied, question, structure, x)
        if question.kind == "stands"
        else _factor(varied, question, structure, x)
    )


def _case(model: Model, name: str) -> LoadCase:
    cases = select_cases(model, (name,))
    if len(cases) > 1:
        words = f"{name} travels: choose one of its positions, such as {cases[0].name}"
        raise UsageError("find-option", f"--case {words}")
    return cases[0]


# --- load factors ---------------------------------------------------------------------------------------------------


def _factor(deck: Deck, question: Question, structure: Structure, x: float) -> Answer:
    """A load factor of the load case, as ``mbla run`` gives it."""
    model, contacts, load_case = structure.model, structure.contacts, structure.load_case
    log = StatusFile(io.StringIO(), deck.title)
    case = solve_case(deck, model, contacts, load_case, solver_settings(deck.analysis), log, None)
    status, verified = case.status.value, case.checks.verified
    if case.status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        side = -math.inf if case.status is Status.NO_EQUILIBRIUM else math.inf
        return Answer(x, math.nan, side, math.nan, status, verified, case.solution.reason)
    if result_of(case) is None:
        return Answer(x, math.nan, math.nan, math.nan, status, verified, case.solution.reason or "it is not verified")
    own = result_of(case)
    assert own is not None
    result = least_and_greatest(model, case)[0] if question.kind == "least_load_factor" else own.load_factor
    slope, bounds, associative = math.nan, (math.nan, math.nan), case.solution.associative
    if associative is not None and math.isclose(associative.load_factor, result, rel_tol=SAME):
        bounds = case.checks.static_bound, case.checks.kinematic_bound
        slope = _slope(deck, question, replace(structure, load_case=case.load_case), case)
    return Answer(x, result, result - question.target, slope, status, verified, "", 1, bounds)


def _slope(deck: Deck, question: Question, structure: Structure, case: CaseResult) -> float:
    """Of an associative load factor; nan where it has none.

    It is also that of a load factor without dilatancy that is the same: that is never above the associative one, so
    that two smooth functions of the parameter touch there.
    """
    found = slope_by(deck, structure, case.solution, case.checks, question.path)
    return math.nan if found is None else found.slope


# --- standing -------------------------------------------------------------------------------------------------------


def _stands(deck: Deck, question: Question, structure: Structure, x: float) -> Answer:
    """The greatest pressure in all joints that is carried with the dead load, over the weight per area of joints."""
    if structure.load_case.settlement is not None:
        raise UsageError("find-option", f"{question.load_case}: a support that gives way has no limit of standing")
    unit = structure.model.total_weight / max(float(structure.contacts.areas.sum()), np.finfo(float).tiny)
    analysis = deck.analysis.model_copy(update={"flow_rule": "associative", "standing": False, "scheme": "auto"})
    settings, solves, pressed = solver_settings(analysis), 0, PRESSED
    while pressed <= MOST_PRESSED:
        posed = pressed_by(structure, pressed, unit)
        solids = solids_of(posed.model, posed.contacts)
        solution = solve(build_program(solids, posed.load_case, analysis), settings)
        checks = verify(posed.model, posed.contacts, posed.load_case, solution)
        solves += 1
        if solution.status is not Status.NO_EQUILIBRIUM:
            return _of_pressure(deck, question, posed, solution, checks, x, pressed, unit, solves)
        pressed *= 10.0
    words = "no pressure on its joints makes it stand"
    return Answer(x, math.nan, -math.inf, math.nan, Status.NO_EQUILIBRIUM.value, checks.verified, words, solves)


def pressed_by(structure: Structure, pressed: float, unit: float) -> Structure:
    """The structure whose joints are pressed together, and whose live load takes that away; ``unit`` of pressure."""
    contacts, case = structure.contacts, structure.load_case
    normal = np.zeros((len(contacts.points), 3))
    normal[:, 0] = unit * contacts.point_areas
    apart = contact_resultants(structure.model, contacts, normal)
    posed = replace(case, dead_load=case.dead_load - pressed * apart, live_load=apart, tilt=None)
    return replace(structure, load_case=posed)


def _of_pressure(
    deck: Deck,
    question: Question,
    posed: Structure,
    solution: Solution,
    checks: Checks,
    x: float,
    pressed: float,
    unit: float,
    solves: int,
) -> Answer:
    status = verified_status(solution, checks)
    if solution.mechanics is None or status not in (Status.SOLVED, Status.APPROXIMATE):
        unbounded = status is Status.UNBOUNDED
        side = math.inf if unbounded else math.nan
        words = solution.reason or "it is not verified"
        return Answer(x, math.nan, side, math.nan, status.value, checks.verified, words, solves)
    result = solution.mechanics.load_factor - pressed
    bounds = checks.static_bound - pressed, checks.kinematic_bound - pressed
    stands = "stands" if bounds[0] >= 0.0 else "does not stand" if bounds[1] < 0.0 else "at the limit"
    found = slope_by(deck, posed, solution, checks, question.path, posed=lambda other: pressed_by(other, pressed, unit))
    slope = math.nan if found is None else found.slope
    return Answer(x, result, result, slope, stands, checks.verified, "", solves, bounds)
