"""What the deck in a file asks for, held against what the file has: cases, and the parts of their answers.

What is missing and a run always leaves is a difference, and so is what the deck does not ask for. What is missing for a
reason that the run alone can state is not confirmed, whatever the file says of it: nothing in it shows that reason.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.model import Model
from mbla.results.outcome import WITH_VALUE, least_factor, ratio_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import series_of, worst_known
from mbla.results.verification.modes_after import lacks_modes_after
from mbla.results.verification.pushover import pushover_claims, pushover_differences
from mbla.results.verification.time_history import history_claims, history_differences
from mbla.solution.flow.path_record import Stop
from mbla.solution.flow.settings import RATIOS, ratios_beside, second_ratio
from mbla.solution.further.geometric_safety.find import why_no_geometric_safety
from mbla.solution.further.soil_range.soil_path import SHARES
from mbla.solution.nonassociative.by_stiffness import same
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.solution import Mechanics, Solution, Status
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.verify import locked_with_normality

SAME = 1e-9
"""relative difference of load factors that are one figure"""


SAME_ROW = 1e-6
"""relative difference of load factors of the end of a path and of its last row"""


@dataclass
class Found:
    """Sentences on a file.

    differences : where it is not what its deck and its arrays give
    unconfirmed : what it lacks, or states, and nothing in it shows
    of_pushover : what it states of a pushover and nothing in it shows, until that is followed anew
    of_history  : the same of a structure in time
    """

    differences: list[str] = field(default_factory=list)
    unconfirmed: list[str] = field(default_factory=list)
    of_pushover: list[str] = field(default_factory=list)
    of_history: list[str] = field(default_factory=list)


def cases_left_out(results: Results) -> tuple[str, ...]:
    """Load cases of the deck of which a file has no result, in words."""
    missing = ", ".join(results.without_result)
    return (f"the deck has load cases of which the file has no result: {missing}",) if missing else ()


def differences_of_positions(deck: Deck, results: Results) -> Iterator[str]:
    """Travelling loads at whose worst position, or the one that is asked for, the structure is not pushed, in words."""
    for series in series_of(results.cases) if results.complete else ():
        asked = deck.content.load_cases[series.name].pushover
        if asked is None:
            continue
        may_be = [case for case in series.cases if asked.position in (None, case.load_case.question.place.number)]
        wanted = [worst_known(may_be).load_case.name] if may_be else []
        pushed = [case.load_case.name for case in series.cases if case.load_case.pushover is not None]
        if pushed != wanted:
            known, other = (", ".join(names) or "none" for names in (pushed, wanted))
            yield f"{series.name}: the structure is pushed at {known}, where the deck asks for {other}"


def differences_of_stop(results: Results) -> tuple[str, ...]:
    """What a partial file says of the run that was stopped and cannot be, in words."""
    if results.complete:
        return ()
    from mbla.results.partial import STOPPED, what_was_done  # late: few files are partial

    found = []
    notice = results.notices[-1] if results.notices else None
    tells = notice is not None and (notice.severity, notice.identifier) == ("warning", "run-stopped")
    said = "" if notice is None or not tells else notice.message
    if not (said.startswith(f"{STOPPED} (") and said.endswith(f"){what_was_done(results)}")):
        found.append("the file is partial, and its last remark does not say what stopped the run and what was done")
    names = [case.name for case in results.model.load_cases]
    done = {case.load_case.name for case in results.cases if not at_work(results, case)}
    if list(results.not_done) != [name for name in names if name in results.not_done and name not in done]:
        found.append("load cases that the run is said not to have done are no others of the deck, in its order")
    return tuple(found)


def at_work(results: Results, case: CaseResult) -> bool:
    """Whether a run was stopped, or is still at work, while it pushed on a load case, or followed it in time: the first
    that is not done.
    """
    takes_long = case.load_case.pushover is not None or case.load_case.time_history is not None
    return case.load_case.name in results.not_done[:1] and takes_long


def held_against_deck(deck: Deck, assembly: Assembly, case: CaseResult, *, done: bool) -> Found:
    """A load case against what its deck asks for.

    case : with checks, status and curve recomputed
    done : False where the run was stopped while it pushed on the load case, so that the rest is missing
    """
    found, end = Found(), case.solution.further.pushover.curve_end
    found.differences += [f"the file has {what}, which the deck does not ask for" for what in _not_asked(deck, case)]
    if (end is CurveEnd.STOPPED) is (done or case.solution.further.pushover.rows is None):
        found.differences.append(f"the load case is {'' if done else 'not '}done, and its pushover ends: {end or '-'}")
    history = case.solution.further.time_history
    if history.end is not HistoryEnd.NONE and (history.end is HistoryEnd.STOPPED) is done:
        found.differences.append(f"the load case is {'' if done else 'not '}done, and its history ends: {history.end}")
    if not done:
        return found
    if case.load_case.time_history is not None:
        found.differences += history_differences(deck, assembly, case)
        found.of_history += [] if found.differences else history_claims(case)
    if case.load_case.pushover is not None:
        found.differences += pushover_differences(deck, assembly, case)
        found.of_pushover += [] if found.differences else pushover_claims(case)
    _limits(found, deck, assembly, case)
    _associative(found, assembly, case)
    _history(found, deck, case)
    _path(found, deck, assembly.model.of_case(case.load_case), case)
    _least(found, deck, case)
    if _torsion_unverified(case):
        found.unconfirmed.append("the state with torsion of uniform pressure is not verified")
    return found


def _torsion_unverified(case: CaseResult) -> bool:
    """Whether a state with torsion of uniform pressure is there that does not fit its law."""
    return case.solution.torsion is not None and bool(np.isnan(case.checks.torsion_load_factor))


def _not_asked(deck: Deck, case: CaseResult) -> Iterator[str]:
    solution, load_case = case.solution, case.load_case
    settings = settings_for(load_case, solver_settings(deck.analysis))
    mechanics = solution.mechanics
    history = None if mechanics is None else mechanics.remembered
    present: Mapping[str, tuple[object, bool]] = {
        "what elastic joints remember": (history, settings.by_elastic_path),
        "a pushover": (solution.further.pushover.rows, load_case.pushover is not None),
        "slopes": (solution.further.sensitivity or None, deck.analysis.sensitivity is not False),
        "a geometric factor of safety": (solution.further.geometric_safety, deck.analysis.geometric_safety),
        "a range by the dilatancy of soil": (solution.further.soil_range or None, deck.analysis.soil_range),
        "a time history": (solution.further.time_history.end or None, load_case.time_history is not None),
        "modes of vibration": (len(solution.further.modes) or None, load_case.modes > 0),
        "modes after a time history": (
            len(solution.further.modes_after) or None,
            load_case.modes > 0 and load_case.time_history is not None,
        ),
        "a verdict on standing": (solution.standing, settings.standing or not load_case.has_load_factor),
        "a state with torsion": (solution.torsion, settings.by_torsion),
        "a least state": (solution.least, settings.by_elastic_path and settings.search > 0.0),
        "the answer of a level table": (solution.level, load_case.question.tilts),
        "the lock of a level table": (solution.level_lock, load_case.question.tilts),
    }
    return (what for what, (part, asked) in present.items() if part is not None and not asked)


def _limits(found: Found, deck: Deck, assembly: Assembly, case: CaseResult) -> None:
    """Standing and geometric safety; slopes are found again."""
    solution, knobs = case.solution, settings_for(case.load_case, solver_settings(deck.analysis))
    claims = solution.status in (*WITH_VALUE, Status.UNBOUNDED)
    if knobs.standing and claims and solution.standing is None:
        found.differences.append(lacks("standing"))
    if deck.analysis.geometric_safety and solution.further.geometric_safety is None:
        against = why_no_geometric_safety(assembly.model, assembly.contacts, case.load_case, deck.analysis)
        if not against:
            _missing(found, "geometric factor of safety", case, "geometric-safety-not-done")
    falls = not case.load_case.has_load_factor and solution.status is not Status.SOLVED
    if case.load_case.modes and not len(solution.further.modes) and not falls:
        _missing(found, "modes of vibration", case, "no-modes")
    if lacks_modes_after(deck, assembly, case):
        _missing(found, "modes after the time history", case, "no-modes-after")
    _soil_range(found, deck, assembly.model, case)


def _soil_range(found: Found, deck: Deck, model: Model, case: CaseResult) -> None:
    """The paths that are asked for, none of them above the bound of associative flow."""
    paths, bound = case.solution.further.soil_range, case.checks.kinematic_bound
    asked = deck.analysis.soil_range and model.soils and case.load_case.question.collapses
    if asked and tuple(path.share for path in paths) != SHARES:
        found.differences.append(lacks("range by the dilatancy of soil"))
    above = [path.load_factor for path in paths if path.load_factor > bound + APPROXIMATE_RESIDUAL * abs(bound)]
    if above and case.load_case.question.multiplies:
        found.differences.append(f"soil carries {above[0]:.6g}, and by associative flow no more than {bound:.6g}")


def _associative(found: Found, assembly: Assembly, case: CaseResult) -> None:
    """The associative answer, which every run with a load factor leaves unless friction locks with normality."""
    solution = case.solution
    if solution.mechanics is None or solution.associative is not None:
        return
    if locked_with_normality(assembly, case.load_case, solution):
        return
    found.unconfirmed.append("the file has no associative answer")


def _history(found: Found, deck: Deck, case: CaseResult) -> None:
    """What elastic joints remember, without which nothing shows that their law holds."""
    mechanics = case.solution.mechanics
    moves = mechanics is not None and mechanics.load_factor != 0.0  # what moves at once has no path
    if mechanics is not None and moves and _by_path(deck, case) and mechanics.remembered is None:
        found.differences.append(lacks("history of elastic joints"))
    if mechanics is not None and mechanics.stiffness is not None:
        ratio, asked = ratio_of(mechanics), deck.analysis.path.ratio
        if not np.isclose(ratio, (asked, *RATIOS, *ratios_beside(asked)), rtol=SAME_ROW, atol=0.0).any():
            found.differences.append(
                f"joints have {ratio:.6g} of their stiffness in shear, which the deck does not say"
            )


def _path(found: Found, deck: Deck, model: Model, case: CaseResult) -> None:
    """How the path of elastic joints ended: a load factor is solved where its greatest load was seen."""
    solution, own = case.solution, case.solution.mechanics
    if own is None or own.remembered is None or not _by_path(deck, case):
        return
    _by_stiffness(found, deck, model, case, own)
    seen = solution.path_end in ANSWERS
    if solution.status is Status.SOLVED and not seen:
        found.differences.append(
            f"the load factor is solved, and the path of elastic joints ended: {solution.path_end or '-'}"
        )
    if seen and not solution.path:
        found.differences.append(lacks("path of elastic joints"))
    last = next((step.load_factor for step in reversed(solution.path) if step.balanced), np.nan)
    last = min(last, own.load_factor)  # a row says less sharply what the state at the greatest load says
    if not np.isclose(solution.path_last, last, rtol=SAME_ROW, atol=0.0, equal_nan=True):
        found.differences.append(
            f"the path ends at the load factor {solution.path_last:.6g}, its last row at {last:.6g}"
        )


def _by_stiffness(found: Found, deck: Deck, model: Model, case: CaseResult, own: Mechanics) -> None:
    """Paths of joints of other stiffnesses beside the one shown: two by ``accuracy: reference``, one in doubt."""
    ratio, reference = deck.analysis.path.ratio, deck.analysis.accuracy == "reference"
    whole = {ratio, *ratios_beside(ratio)} if reference else {ratio, second_ratio(ratio)}
    solution, shown = case.solution, ratio_of(own)
    known = [row.ratio for row in solution.path_by_stiffness]
    known.append(min(whole, key=lambda other: abs(other - shown)))
    nothing = least_factor(model, case.load_case)
    seen = [row.load_factor for row in solution.path_by_stiffness if not math.isnan(row.load_factor)]
    answers = solution.status in WITH_VALUE and solution.path_end != Stop.LATE
    if reference and answers and len(known) == 1:
        found.differences.append(lacks("paths of joints of other stiffnesses"))
    elif solution.status is Status.SOLVED and not all(same(value, own.load_factor, nothing) for value in seen):
        found.differences.append("the load factor is solved, and joints of other stiffnesses come to another one")
    elif sorted(known) not in (sorted(whole), [ratio]):
        found.differences.append("the file has paths of joints of other stiffnesses than the deck leads to")


ANSWERS = tuple(stop.value for stop in Stop if stop.answers)
"""ends of a path of which the greatest load was seen"""


def _least(found: Found, deck: Deck, case: CaseResult) -> None:
    """The least state where one is looked for: that a search came to none is of the run alone.

    In space a run says that it does not look for one unless the deck says how far.
    """
    solution = case.solution
    if solution.mechanics is None or solution.status not in WITH_VALUE or not _by_path(deck, case):
        return
    if solution.least is not None:
        if np.isnan(case.checks.least_load_factor):
            found.unconfirmed.append("the state of the least load factor is not verified")
        return
    settings = settings_for(case.load_case, solver_settings(deck.analysis))
    planar = solution.size is not None and solution.size.dimension == 2
    if not case.load_case.question.multiplies or by_normality(solution):
        return
    by_points = not solution.conditions_on_interfaces
    if by_points and settings.search > 0.0 and (planar or settings.analysis.search is not None):
        found.unconfirmed.append("that the search came to no state of rigid joints is not verified")
    elif all(remark.identifier != "lower-not-searched" for remark in solution.remarks):
        found.differences.append("the remark lower-not-searched is missing")


def _by_path(deck: Deck, case: CaseResult) -> bool:
    """Whether the load factor is one of the path of elastic joints."""
    return settings_for(case.load_case, solver_settings(deck.analysis)).by_elastic_path


def _missing(found: Found, what: str, case: CaseResult, *excuses: str) -> None:
    """Something that is asked for and missing: not confirmed where a remark of the run says why, else a difference."""
    said = [remark for remark in case.solution.remarks if remark.identifier in excuses]
    if said:
        found.unconfirmed.append(f"{lacks(what)}; why is not verified, the file says: {said[0]}")
    else:
        found.differences.append(lacks(what))


def by_normality(solution: Solution) -> bool:
    """Whether the forces are those of associative flow: by that rule, or for want of joints that could flow."""
    own, associative = solution.mechanics, solution.associative
    return own is not None and associative is not None and np.array_equal(own.mechanism, associative.mechanism)


def lacks(what: str) -> str:
    """That something is missing, in words."""
    return f"the deck asks for the {what}, which the file does not have"
