"""What may be reported of a case: which figures are results, which only those of the best iterate.

A load factor is a result where the case is solved or approximate. Without associative flow it is no result
where the structure stands only in a self-stressed state: equilibrium under that load exists, but nothing leads to it.
Everything that shows figures (listing, JSON, summary, pictures) asks here, so that all agree.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from mbla.errors import Notice
from mbla.model.model import LoadCase, Model
from mbla.results.demand.cracking import cracking_notices
from mbla.results.findings import found_notices, magnitude_notices
from mbla.results.history_figures import HistoryFigures, history_figures
from mbla.results.results import CaseResult, Results
from mbla.solution.flow.path_record import Stop
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.solution import PROVED_STANDING, Checks, Mechanics, Standing, Status
from mbla.solution.standing.standing import DOUBTFUL
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL

WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)
"""statuses whose load factor is a result"""
CLEAN_RESIDUAL = 1e-6
"""residual up to which a solved case without associative flow needs no warning"""
RESIDUALS = {
    "equilibrium_residual": "of the mean load of a block",
    "yield_violation": "of the mean load of a block",
    "tension_violation": "of the mean load of a block",
    "penetration": "of the largest contact velocity",
    "complementarity_residual": "of the power",
    "slip_residual": "of the power",
    "elastic_residual": "of the largest force",
    "power_balance": "of the power",
}
"""measures of how badly forces and velocities fit the joint law, and what each is relative to"""
WORST_STANDING = (Standing.NO, Standing.SELF_STRESS, Standing.DOUBTFUL)
"""verdicts that apply to the whole structure as soon as one case has them, the worst first"""


def result_of(case: CaseResult) -> Mechanics | None:
    """Forces, velocities and load factor that are a result; None where there are none."""
    return case.solution.mechanics if case.status in WITH_VALUE and not locked_in(case) else None


def best_iterate(case: CaseResult) -> Mechanics | None:
    """The best iterate where that is no result; nothing where it is settled that there is none."""
    return None if result_of(case) is not None or case.status is Status.UNBOUNDED else case.solution.mechanics


def associative_of(case: CaseResult) -> Mechanics | None:
    """The associative answer where it is a result: bounds confirm it whatever the deck's own flow rule gave."""
    associative = case.solution.associative
    if case.status is Status.UNBOUNDED:
        return None
    if case.solution.flow_rule == "associative":
        return None if result_of(case) is None else associative
    confirmed = case.status in WITH_VALUE or case.checks.gap <= APPROXIMATE_RESIDUAL
    return associative if confirmed else None


def locked_in(case: CaseResult) -> bool:
    """Whether a load factor without associative flow rests on forces that only self-stress would cause."""
    standing = case.solution.standing
    return (
        case.solution.flow_rule != "associative"
        and standing is not None
        and standing.verdict in (Standing.SELF_STRESS, Standing.NO)
    )


def standing_unproved(case: CaseResult) -> bool:
    """Whether the verdict on standing cannot be proved: that it stands only by self-stress, or is doubtful."""
    standing = case.solution.standing
    return standing is not None and standing.verdict not in PROVED_STANDING


def presumes_standing(case: CaseResult) -> bool:
    """Whether what is claimed of the live load counts only if it stands, which nothing proves.

    Associative flow presumes nothing: its bounds hold with and without self-stress.
    """
    claimed = case.status in (*WITH_VALUE, Status.UNBOUNDED)
    return claimed and case.solution.flow_rule != "associative" and standing_unproved(case)


def unproved_words(cases: Sequence[CaseResult]) -> tuple[str, ...]:
    """Cases whose verdict on standing nothing proves, a sentence each."""
    return tuple(
        f"{case.load_case.name}: whether it stands under its dead load alone is not verified, the run reported "
        f"{case.solution.standing.verdict.value!r}"
        + ("; statements on the live load presume that it stands" if presumes_standing(case) else "")
        for case in cases
        if case.solution.standing is not None and standing_unproved(case)
    )


def least_of(case: CaseResult) -> float:
    """Least load factor that a search found, that of the state shown where states of rigid joints lie above it.

    nan where none ran, or it came to no state.
    """
    own, least = result_of(case), case.checks.least_load_factor
    return math.nan if own is None or math.isnan(least) else min(own.load_factor, least)


def torsion_of(case: CaseResult) -> float:
    """Load factor on the path with torsion of uniform pressure; nan where none was followed, or it is not verified."""
    return math.nan if result_of(case) is None else case.checks.torsion_load_factor


def least_known(case: CaseResult) -> float:
    """The smaller of the load factor and of the least that a search found: to design with; nan without a result."""
    own = result_of(case)
    return math.nan if own is None else float(np.fmin(own.load_factor, least_of(case)))


FALLEN = 0.05
"""Share of the load factor by which less is carried at the end of a path that does not end as a fall, from which that
is said: a tie has broken, or the load has not come back after a dip."""


def falls_while_moving(case: CaseResult) -> bool:
    """Whether the load falls on the path once the structure moves."""
    own, last = case.solution.mechanics, case.solution.path_last
    if own is None:
        return False
    room = 0.0 if case.solution.path_end == Stop.FALLS else FALLEN * abs(own.load_factor)
    return last < own.load_factor - room


def rises_where_it_ends(case: CaseResult) -> bool:
    """Whether the load still rises where the path ends."""
    return any(remark.identifier == "elastic-path-rises" for remark in case.solution.remarks)


def least_factor(model: Model, load_case: LoadCase) -> float:
    """Load factors below are compared as if they were that."""
    return load_case.question.least_factor(dead_over_live(model, load_case))


def least_answer(model: Model, load_case: LoadCase) -> float:
    """Figures that answer the case are compared as if they were that where they are below."""
    return load_case.question.least(dead_over_live(model, load_case))


def dead_over_live(model: Model, load_case: LoadCase) -> float:
    """Dead over live forces on the free blocks; 0 without live ones."""
    dead, live = (float(np.abs(load[model.free, :3]).sum()) for load in (load_case.dead_load, load_case.live_load))
    return dead / live if live > 0.0 else 0.0


def apart(model: Model, load_case: LoadCase, one: float, other: float) -> float:
    """Difference of two load factors, or of the reactions that they stand for, over the second; 0 of equal ones."""
    if one == other:
        return 0.0
    question = load_case.question
    least = least_factor(model, load_case) * question.scale
    one, other = question.compared(one), question.compared(other)
    return abs(one - other) / max(abs(other), least)


def off_by_stiffness(model: Model, case: CaseResult) -> float:
    """Share by which joints of other stiffnesses come to other answers; nan where that of any is not known."""
    own, rows = result_of(case), case.solution.path_by_stiffness
    if own is None or not rows:
        return math.nan
    return float(np.max([apart(model, case.load_case, row.load_factor, own.load_factor) for row in rows]))


def ratio_of(own: Mechanics) -> float:
    """Shear over normal stiffness of joints in the step of a state of the path; nan for rigid joints."""
    return math.nan if own.stiffness is None else float(np.median(own.stiffness[:, 1] / own.stiffness[:, 0]))


def law_residual(checks: Checks) -> float:
    """The largest of the residuals that say how badly forces and velocities fit the joint law; nan without any."""
    known = [value for value in (getattr(checks, name) for name in RESIDUALS) if not np.isnan(value)]
    return max(known, default=float("nan"))


def standing_of(cases: Sequence[CaseResult]) -> str | None:
    """The worst verdict over the cases; ``yes`` only where every case has it, None where one was not assessed."""
    verdicts = [
        Standing.NO
        if case.status is Status.NO_EQUILIBRIUM
        else None
        if case.solution.standing is None
        else case.solution.standing.verdict
        for case in cases
    ]
    for worst in WORST_STANDING:
        if worst in verdicts:
            return worst.value
    return Standing.YES.value if verdicts and None not in verdicts else None


def dimension_of(cases: Sequence[CaseResult]) -> int:
    """2 where every case was solved as planar, else 3."""
    planar = [case.solution.size is not None and case.solution.size.dimension == 2 for case in cases]
    return 2 if planar and all(planar) else 3


def case_notices(case: CaseResult) -> tuple[Notice, ...]:
    """What a reader must know of a case's figures, as warnings."""
    name, standing, notices = case.load_case.name, case.solution.standing, []
    if standing is not None and standing.verdict is Standing.SELF_STRESS:
        figures = ["load factor is no collapse load"] if locked_in(case) and case.solution.mechanics is not None else []
        safety = case.solution.further.geometric_safety
        figures += ["geometric factor is no safety"] if safety is not None and safety.factor >= 1.0 else []
        what = f"; its {' and its '.join(figures)}" if figures else ""
        text = f"{name}: the structure stands only in a self-stressed state{what}"
        notices.append(Notice("warning", "only-by-self-stress", f"{text}: {standing.reason}", name))
    if standing is not None and standing.verdict is Standing.DOUBTFUL:
        text = f"{name}: whether the structure stands without self-stress could not be decided"
        cause = standing.reason.removeprefix(f"{DOUBTFUL}: ")
        notices.append(Notice("warning", "standing-doubtful", f"{text}: {cause}", name))
    residual = law_residual(case.checks)
    if case.status is Status.SOLVED and case.solution.flow_rule != "associative" and residual > CLEAN_RESIDUAL:
        text = f"{name}: forces and velocities violate the joint law: residual {residual:.1e}, more than"
        text = f"{text} {CLEAN_RESIDUAL:g}; the load factor is good to about that share"
        notices.append(Notice("warning", "law-residual", text, name))
    return tuple(notices)


def notices_of(results: Results) -> tuple[Notice, ...]:
    """Notices of the run, then those of each case: of its figures, its status, its verification, its solver."""
    fallen = {case.load_case.question.series for case in results.cases if result_of(case) is not None} - {None}
    notices = list(results.notices)
    for case in results.cases:
        answer = case.load_case.question.unbounded_answers or case.load_case.question.series in fallen
        harmless = case.status is Status.UNBOUNDED and answer
        own = case_notices(case)
        doubtful = any(notice.identifier == "law-residual" for notice in own)
        notices += (*own, *found_notices(case, harmless=harmless))
        notices += cracking_notices(results.assembly, case) if result_of(case) is not None else ()
        notices += magnitude_notices(results.model, results.contacts, case, doubtful=doubtful)
    return tuple(notices)


def distinct(names: Iterable[str]) -> list[str]:
    """Each once, in the order of their first appearance, none empty."""
    return [name for name in dict.fromkeys(names) if name]


# --- The figure that answers a case ---------------------------------------------------------------------------------


def answer_of(case: CaseResult, group: str = "") -> float:
    """The figure that a case asks for; nan where it is no result, and where its question is of another group."""
    found, question = result_of(case), case.load_case.question
    if group not in ("", question.group):
        return math.nan
    if case.load_case.time_history is not None:
        figures = history_of(case)
        return math.nan if figures is None else figures.peak
    if question.group == "modes":
        return case.solution.further.modes.period if case.status in WITH_VALUE else math.nan
    return math.nan if found is None else question.stated(found.load_factor)


def figure_of(case: CaseResult) -> float:
    """The same; infinite where nothing limits it: no multiple brings anything down, forces of any size fit.

    Where corners of soil were moved for other load cases it is, if less, the upper figure on a mesh of its own.
    """
    figure = case.load_case.question.unlimited if case.status is Status.UNBOUNDED else answer_of(case)
    soil = case.load_case.soil
    if any(mesh.followed for mesh in soil if mesh.shown):
        return figure
    own = min((mesh.load_factor for mesh in soil if mesh.followed), default=math.inf)
    return own if own < figure else figure


def answer_bounds(case: CaseResult) -> tuple[float, float]:
    """Between which figures the answer is proved to lie by associative flow; nan if not known.

    Of a structure in time between which its peaks lie with the step and with half of it, which proves nothing.
    """
    if case.load_case.time_history is not None:
        figures = history_of(case)
        return (math.nan, math.nan) if figures is None else figures.range_of_peak
    associative, checks = case.solution.associative, case.checks
    mechanism = None if associative is None else associative.mechanism
    return case.load_case.question.bounds(checks.static_bound, checks.kinematic_bound, mechanism)


# --- Pushovers ------------------------------------------------------------------------------------------------------


def curve_residual(case: CaseResult) -> float:
    """The greatest residual of the steps of a pushover; 0 without any."""
    return float(np.max([row.residual for row in case.solution.further.pushover.curve[1:]], initial=0.0))


def ultimate_displacement(case: CaseResult, sure: bool = True) -> float:
    """Displacement of the control point at which a pushover leaves no load factor, on the line between two steps.

    That of the last step where it goes on from there by itself, or nothing carries it any more; nan
    where the pushover did not come so far, where there is none, and unless ``sure`` is false where its steps are not
    verified.
    """
    curve = case.solution.further.pushover.curve
    if len(curve) < 2 or (sure and not curve_residual(case) <= APPROXIMATE_RESIDUAL):
        return math.nan
    behind = [row.step for row in curve[1:] if row.load_factor <= 0.0]
    if behind and case.load_case.question.multiplies:
        curve = curve[: behind[0] + 1]
    elif case.solution.further.pushover.curve_end in (CurveEnd.FALLS, CurveEnd.NOT_CARRIED):
        return curve[-1].displacement
    elif case.solution.further.pushover.curve_end is not CurveEnd.NOTHING_LEFT:
        return math.nan
    before, last = curve[-2:]
    share = before.load_factor / (before.load_factor - last.load_factor)
    return before.displacement + share * (last.displacement - before.displacement)


# --- Structures in time ---------------------------------------------------------------------------------------------


def history_of(case: CaseResult) -> HistoryFigures | None:
    """Figures of a structure in time that are a result; None where there are none."""
    return history_figures(case.solution.further.time_history) if case.status in WITH_VALUE else None
