"""The outcome of a case in words: how it collapses, how well that is known, and what else holds."""

from __future__ import annotations

import numpy as np

from mbla.model.model import LoadCase, Model
from mbla.results.collapse.mechanics import live_load_in_g
from mbla.results.findings import BROKEN, rounding_of
from mbla.results.listing.answers import answer_figure, status_name
from mbla.results.listing.history_verdict import history_verdict
from mbla.results.listing.sections.modes import modes_words
from mbla.results.listing.text import number, small
from mbla.results.outcome import (
    answer_of,
    associative_of,
    best_iterate,
    falls_while_moving,
    figure_of,
    law_residual,
    least_of,
    locked_in,
    off_by_stiffness,
    presumes_standing,
    result_of,
    rises_where_it_ends,
)
from mbla.results.results import CaseResult
from mbla.solution.flow.path_record import Stop
from mbla.solution.further.soil_range.soil_path import SoilPath
from mbla.solution.solution import Status
from mbla.solution.thresholds import GAP_TOLERANCE, SOLVED_RESIDUAL


def load_factor_words(model: Model, load_case: LoadCase, load_factor: float) -> str:
    """``0.145 g`` where the live load is an acceleration, else ``0.643 times the live load``.

    ``a reaction of 5232 N`` where a support gives way, ``31.2 degrees of tilt`` for a tilting table.
    """
    question = load_case.question
    size = live_load_in_g(model, load_case) if question.group == "load_factor" else None
    if size is None:
        return question.factor_words(load_factor, model.units)
    return f"{number(load_factor * size)} g"


def verdict(model: Model, case: CaseResult) -> str:
    """The outcome of a case in one line; only a solved case reads as a collapse, or as the beginning of one."""
    if case.load_case.question.group == "modes" and case.status is Status.SOLVED:
        return f"{modes_words(case)}, verified"
    if case.load_case.time_history is not None:
        return history_verdict(model, case)
    mechanics = result_of(case)
    if mechanics is None:
        return _without_load_factor(model, case)
    question, verified = case.load_case.question, case.status is Status.SOLVED
    if not question.collapses:
        figure = f"{answer_figure(case.load_case, mechanics.load_factor)} {question.unit(model.units)}"
        return f"{question.what} {figure}, {'verified' if verified else 'approximate'}"
    value = _known_words(model, case, mechanics.load_factor)
    known = f"{value}, verified" if verified else f"about {value}, approximate"
    moves = question.moves(by_path=case.by_path)
    if verified and (told := figure_of(case)) < answer_of(case):  # corners of soil follow another position
        own = load_factor_words(model, case.load_case, told)
        return f"{moves} at no more than {own}, on soil moved for it; at {value} on the soil of another position, shown"
    if presumes_standing(case):
        return f"it is in doubt whether it stands, and so where it {moves}; a state that fits the joint law at {known}"
    if falls_while_moving(case) and mechanics.load_factor > rounding_of(model, case):
        return (
            f"{moves} at {known}; while it moves, {load_factor_words(model, case.load_case, case.solution.path_last)}"
        )
    if verified and rises_where_it_ends(case):
        gained = f"{100.0 * case.solution.path_gain:.2g} %"
        return f"{moves} at {known}; the load still rises there, by {gained} over the last half"
    return f"{moves} at {known}"


NO_TORSION = {
    Stop.DOES_NOT_STAND: "it does not carry its dead load from the stress-free assembly",
    Stop.UNBOUNDED: "nothing gives way, however large the live load",
}


def torsion_words(model: Model, case: CaseResult) -> str:
    """The load factor with torsion of uniform pressure; nothing where no path with it was followed."""
    own, solution = result_of(case), case.solution
    if own is None or not solution.torsion_end:
        return ""
    if solution.torsion is None:
        why = NO_TORSION.get(Stop(solution.torsion_end), f"not found ({solution.torsion_end})")
        return f"with torsion of uniform pressure: {why}"
    known = load_factor_words(model, case.load_case, solution.torsion.load_factor)
    least = "" if Stop(solution.torsion_end).answers else "at least "
    verified = "" if not np.isnan(case.checks.torsion_load_factor) else ", not verified"
    return f"with torsion of uniform pressure: {least}{known}{verified}"


FAR_BELOW = 0.03
"""share of the load factor by which the least that was found lies below it from which that is said"""


def least_words(model: Model, case: CaseResult) -> str:
    """The least load factor that a search found; nothing where none did."""
    own, least = result_of(case), least_of(case)
    if own is None or np.isnan(least):
        return ""
    known, rigid = (load_factor_words(model, case.load_case, x) for x in (least, case.checks.least_load_factor))
    if rigid != known:
        return f"no state of rigid joints was found below it: the least of them at {rigid}"
    words = f"least found: {known}, a state of rigid joints, verified"
    if least < (1.0 - FAR_BELOW) * own.load_factor:
        words += "; only another history than this loading leads to it: earlier movements, forces that are locked in"
    return words


BY_STIFFNESS = (
    "how stiff joints are in shear is not known: it moves such a figure by less than 0.5 % on walls and arches in "
    "their plane, by up to 5 % in space and under an axle on a bridge (accuracy: reference follows two others)"
)
AT_BOUND = 1e-3
"""share of the associative load factor within which stiffness was seen to decide nothing, on 120 load cases"""
LEAST_OFF = 1e-4
"""share below which differences by stiffness are not told apart"""


def stiffness_words(model: Model, case: CaseResult) -> str:
    """What joints of other stiffnesses come to, and how far that is off.

    By kind where no such path was followed, unless the load factor is that of associative flow, an upper limit to all.
    """
    own, rows = result_of(case), case.solution.path_by_stiffness
    if own is None or not case.by_path:
        return ""
    if not rows:
        above = associative_of(case)
        return "" if above and own.load_factor >= (1.0 - AT_BOUND) * above.load_factor else BY_STIFFNESS
    factors = [row.load_factor for row in rows]
    told = ["not seen" if np.isnan(each) else load_factor_words(model, case.load_case, each) for each in factors]
    ratios = " and ".join(f"{row.ratio:g}" for row in rows)
    words = f"with joints of {ratios} of their stiffness in shear: {', '.join(told)}"
    off = off_by_stiffness(model, case)
    return words if np.isnan(off) else f"{words}; within ± {100.0 * max(off, LEAST_OFF):.2g} %"


def _known_words(model: Model, case: CaseResult, load_factor: float) -> str:
    """A load factor; of one that rounding could have made, how much that is."""
    rounding, question = rounding_of(model, case), case.load_case.question
    nothing = abs(load_factor) <= rounding and question.multiplies
    words = load_factor_words(model, case.load_case, 0.0 if nothing else load_factor)
    if rounding == 0.0 or not question.rounding_told:
        return words
    return f"{words} to within {load_factor_words(model, case.load_case, float(f'{rounding:.1e}'))}"


def _without_load_factor(model: Model, case: CaseResult) -> str:
    best = best_iterate(case)
    if locked_in(case) and case.status is not Status.NO_EQUILIBRIUM:
        return "no collapse load: it stands only by self-stress"
    if best is None:
        return _without_figures(case)
    value = load_factor_words(model, case.load_case, best.load_factor)
    label = "NOT VERIFIED" if case.status is Status.NOT_VERIFIED else f"NOT SOLVED ({_stopped(case)})"
    residual = law_residual(case.checks)
    misses = (
        f"violates the joint law (residual {small(residual)})" if residual > SOLVED_RESIDUAL else "is not confirmed"
    )
    return f"{label}: no load factor; the best iterate, {value}, {misses}"


def _without_figures(case: CaseResult) -> str:
    question, flow_rule = case.load_case.question, case.solution.flow_rule
    if case.status is Status.NO_EQUILIBRIUM:
        return question.no_equilibrium
    if case.status is Status.UNBOUNDED:
        decided = flow_rule in question.decided_by or case.solution.lock is not None
        words = question.unbounded
        return words if decided else f"{words} by associative flow; undecided for the flow rule of the deck"
    if case.status is Status.NOT_VERIFIED:
        return f"NOT VERIFIED: no {'load factor' if case.load_case.has_load_factor else question.title}"
    return f"NOT SOLVED ({_stopped(case)})"


def _stopped(case: CaseResult) -> str:
    return BROKEN.get(case.status, status_name(case.status))


def bound_words(model: Model, case: CaseResult) -> str:
    """What is known although a case has no verified load factor; nothing for others.

    The kinematic bound limits the associative load factor, and that limits the load factor of any other flow rule.
    """
    verified = case.status is Status.SOLVED and not locked_in(case)
    if verified or case.status is Status.UNBOUNDED or np.isnan(case.checks.kinematic_bound):
        return ""
    value = load_factor_words(model, case.load_case, case.checks.kinematic_bound)
    return f"certain: {case.load_case.question.limited(value)}"


def uniqueness_words(model: Model, case: CaseResult) -> str:
    """Whether another load factor would fit as well; nothing for associative flow, whose factor is unique."""
    own, associative = result_of(case), associative_of(case)
    if own is None or case.solution.flow_rule == "associative":
        return ""
    above = ""
    if associative:
        wide = case.checks.gap > GAP_TOLERANCE  # then what is proved of it
        value = case.checks.kinematic_bound if wide else associative.load_factor
        of = "the kinematic bound of " if wide else ""
        limit = load_factor_words(model, case.load_case, value)
        above = f"; {of}the associative load factor, {limit}, is an upper limit to all"
    if case.by_path:
        return f"The load factor is the greatest on the path of elastic joints from the stress-free assembly{above}."
    return f"Without normality other load factors may fit the joint law as well{above}."


OF_SOIL = (
    "by associative flow in soil and joints, between two proved bounds of cells, an upper figure for soil; with less "
    "dilatancy it is less, or the same"
)
OF_SOIL_AT_REST = (
    "by associative flow in soil and joints, between two proved bounds of cells, a lower figure for soil; with less "
    "dilatancy it is more, or the same"
)
NO_RANGE = " (soil_range tells how much)"


def soil_flow_words(model: Model, case: CaseResult) -> str:
    """What the figure of a structure with soil of cells is, where bounds prove it; nothing for others."""
    flows = case.solution.flow_rule == "associative" and case.load_case.question.collapses
    if not (model.soils and flows and case.status is Status.SOLVED):
        return ""
    words = OF_SOIL_AT_REST if case.load_case.question.group == "reaction" else OF_SOIL
    return words if case.solution.further.soil_range else words + NO_RANGE


def soil_range_words(model: Model, case: CaseResult) -> str:
    """The load factors of soil that slides without dilatancy and with that of its friction angle; nothing without."""
    paths = case.solution.further.soil_range if model.soils else ()
    found = [_soil_path_words(model, case.load_case, path) for path in paths]
    return f"on paths of elastic joints, those of masonry without dilatancy: {', '.join(found)}" if found else ""


def _soil_path_words(model: Model, load_case: LoadCase, path: SoilPath) -> str:
    dilates = "where soil dilates by its friction angle" if path.share else "where soil does not dilate"
    if np.isnan(path.load_factor):
        return f"not found {dilates} ({path.reason or path.status.replace('_', ' ')})"
    known = load_factor_words(model, load_case, path.load_factor)
    return f"{known if path.status == Status.SOLVED else f'about {known}, approximate,'} {dilates}"


PUBLISHED = (
    "The published procedure starts from the associative forces and ends high among the load factors that fit the "
    "joint law, on the unsafe side."
)


def known_words(model: Model, case: CaseResult) -> list[str]:
    """Sentences on the quality of the figure, with the solver's own remarks."""
    published = PUBLISHED if case.solution.scheme == "published" and case.solution.mechanics is not None else ""
    texts = (
        soil_flow_words(model, case),
        soil_range_words(model, case),
        uniqueness_words(model, case),
        stiffness_words(model, case),
        least_words(model, case),
        torsion_words(model, case),
        published,
        *case.solution.remarks,
    )
    return [f"{text[0].upper()}{text[1:]}".rstrip(".") + "." for text in texts if text]


def reasons(case: CaseResult) -> list[str]:
    """Why a case is not plainly solved, each reason once."""
    reason = [] if case.status is Status.SOLVED or not case.solution.reason else [case.solution.reason]
    return list(dict.fromkeys([*reason, *case.checks.failures]))
