"""The figures that answer load cases, in digits and words: of each, of the ends of a force, of a load that travels."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mbla.model.model import LoadCase, Model
from mbla.questions.figures import significant
from mbla.questions.modes import FirstPeriod
from mbla.questions.travel_position import TravelPosition
from mbla.results.force_range import ForceRange
from mbla.results.listing.blocks import GAP, Fact, ListingSection, Paragraph, apart, table_of
from mbla.results.listing.places import soil_words
from mbla.results.listing.text import counted, number, vector
from mbla.results.outcome import answer_bounds, answer_of, associative_of, figure_of, least_of, result_of
from mbla.results.results import CaseResult
from mbla.results.series import Series
from mbla.solution.solution import Status
from mbla.solution.time_history.step_rows import HistoryEnd


def answer_facts(model: Model, case: CaseResult) -> list[Fact]:
    """What a case asks for besides its load factor, and its bounds."""
    question = case.load_case.question
    entries = question.entries(question.shown(answer_of(case)), proved_bounds(case), model.units)
    return [Fact(name, text) for name, text in entries]


# --- The answer of a case in digits for tables ----------------------------------------------------------------------


def answer_figure(load_case: LoadCase, load_factor: float) -> str:
    """The answer that a load factor stands for in six digits; ``-`` where there is none."""
    question = load_case.question
    return number(question.shown(question.value(load_factor)))


def status_name(status: Status) -> str:
    """A status in words: ``not verified``; files and decks have its key."""
    return status.value.replace("_", " ")


def status_words(status: Status) -> str:
    """``solved``; everything else stands out, ``NOT VERIFIED``."""
    return status_name(status) if status is Status.SOLVED else status_name(status).upper()


def case_status_words(case: CaseResult) -> str:
    """The same of a case; ``STOPPED`` of a structure in time that the user has stopped."""
    stopped = case.solution.further.time_history.end is HistoryEnd.STOPPED and case.status is Status.TIME_LIMIT
    return "STOPPED" if stopped else status_words(case.status)


def proved_bounds(case: CaseResult) -> tuple[float, float]:
    """What associative flow proves to be borne and not to be borne, as the answer of the case."""
    return case.load_case.question.by_proof(answer_bounds(case))


def bound_figures(case: CaseResult) -> tuple[str, str]:
    """These two in eight digits."""
    low, high = proved_bounds(case)
    return digits(low), digits(high)


def answer_columns(model: Model, cases: Sequence[CaseResult]) -> tuple[list[str], list[list[str]]]:
    """Heads and, for each case, figures: of every kind of answer, the least found, the associative.

    Where modes are some case's answer, those beside the answers of others are in that column as well.
    The least is there where a search was made for some case.
    """
    answers = list(dict.fromkeys(case.load_case.question.head(model.units) for case in cases))
    several = any(not math.isnan(least_of(case)) for case in cases)
    rows = []
    for case in cases:
        own, associative = (
            answer_figure(case.load_case, np.nan if found is None else found.load_factor)
            for found in (result_of(case), associative_of(case))
        )
        own = own if case.load_case.has_load_factor else number(answer_of(case))
        known = _first_period(model, case) | {case.load_case.question.head(model.units): own}
        figures = [known.get(head, "") for head in answers]
        least = [answer_figure(case.load_case, least_of(case))] if several else []
        rows.append([*figures, *least, associative])
    return [*answers, *([LEAST] if several else []), "associative"], rows


def _first_period(model: Model, case: CaseResult) -> dict[str, str]:
    """By the head of its column; nothing without modes that are verified."""
    modes = case.solution.further.modes
    return {FirstPeriod().head(model.units): number(modes.period)} if modes.verified else {}


LEAST = "least found"


def digits(value: float) -> str:
    """Eight significant digits; ``-`` where there is no number."""
    return significant(value, 8)


# --- A force in words: its least and greatest value ------------------------------------------------------------------

PROVED = (
    "Forces that balance the loads within the strengths of the joints reach each end; a mechanism in which the cut "
    "opens shows that none go beyond. Every state of the structure lies between, whatever the flow rule: forces in "
    "joints are not unique, and which of them act is not decided."
)


def objective_section(model: Model, found: ForceRange) -> ListingSection:
    """The section of one force in the listing."""
    unit = model.units.force
    head = ["end", "status", f"force [{unit}]", f"lower bound [{unit}]", f"upper bound [{unit}]"]
    rows = [
        [end, status_name(case.status), _end_figure(case), *(digits(bound) for bound in answer_bounds(case))]
        for end, case in found.ends.items()
    ]
    says = Paragraph(f"{range_words(model, found)}.")
    return ListingSection(f"Force {found.name}", [says, *apart(table_of(head, rows, left=2)), GAP, Paragraph(PROVED)])


def range_words(model: Model, found: ForceRange) -> str:
    """``thrust: force of the supports on 1 block along (1, 0, 0), between 8753.85 N and 13297.7 N``."""
    unit, at = model.units.force, found.question.objective.at
    what = f"{found.name}: {found.question.settlement.words}" + (f" at load factor {number(at)}" if at else "")
    if found.status is Status.NO_EQUILIBRIUM:
        return f"{what}: none, the structure does not carry these loads"
    words = []
    for end, each in found.ends.items():
        value = figure_of(each)
        limit = (
            "without limit" if np.isinf(value) else "not known" if np.isnan(value) else f"{_end_figure(each)} {unit}"
        )
        words.append(f"{end} {limit}" + "".join(f" ({status_name(s)})" for s in (each.status,) if s in UNSURE))
    return f"{what}: {', '.join(words)}"


UNSURE = tuple(status for status in Status if status not in (Status.SOLVED, Status.UNBOUNDED))
"""statuses that are named beside an end"""


def _end_figure(case: CaseResult) -> str:
    return number(case.load_case.question.shown(figure_of(case)))


# --- Travelling loads in words: where a vehicle stands, a row for each position, and the worst ----------------------


MOST_NAMED = 5
"""positions without a load factor that are named"""


def series_section(model: Model, series: Series) -> ListingSection:
    """The section of one travelling load in the listing."""
    length = model.units.length
    says = [Paragraph(f"{words}.") for words in (worst_words(model, series), spread_over_positions(series))]
    head = ["load case", "status", f"along path [{length}]", f"axle 1 at [{length}]", "block", "axles", "load factor"]
    rows = table_of(head, [_row(model, series, case) for case in series.cases], left=2)
    return ListingSection(f"Travelling load {series.name}", [*says, *apart(rows)])


def worst_words(model: Model, series: Series) -> str:
    """``worst at position 6 of 21, at (1.2, 0.5, 3) m: load factor 2.31``; of a vehicle, where its axles stand."""
    among = "" if series.complete else f" among the {counted(len(series.cases), 'position')} solved"
    if series.worst is None:
        unknown = [case for case in series.cases if not figure_of(case) > 0]
        if not unknown:
            return f"{series.name}: no multiple of the load brings the structure down at any position{among}"
        names = ", ".join(case.load_case.name for case in unknown[:MOST_NAMED])
        names += " and others" if len(unknown) > MOST_NAMED else ""
        return f"{series.name}: the worst position is not known, for there is no load factor at {names}"
    position = series.worst.load_case.question.place
    where = f"position {position.number} of {position.count}, {standing_words(model, position)}"
    return f"{series.name}: worst{among} at {where}: load factor {number(figure_of(series.worst))}"


def standing_words(model: Model, position: TravelPosition) -> str:
    """``at (1.2, 0.5, 3) m``; of a vehicle its first axle, and which are on the path where not all are."""
    length, axles = model.units.length, len(position.points)
    if axles == 1:
        return f"at {vector(position.point)} {length}"
    words = f"first axle at {vector(position.point)} {length}, {position.distance:.4g} {length} along the path"
    if position.acting.all():
        return words
    axle = "axle" if position.acting.sum() == 1 else "axles"
    return f"{words}, with only {axle} {_acting(position)} of {axles} on it"


def spread_over_positions(series: Series) -> str:
    """At how many positions the load brings the structure down, and between which load factors."""
    factors = np.array([figure_of(case) for case in series.cases])
    finite, count = factors[np.isfinite(factors)], len(factors)
    ends = f", at load factors from {number(finite.min())} to {number(finite.max())}" if len(finite) else ""
    words = f"{series.name}: it brings the structure down at {len(finite)} of {counted(count, 'position')}{ends}"
    for many, what in ((np.isinf(factors), "no multiple does"), (np.isnan(factors), "there is no load factor")):
        words += f"; at {int(many.sum())} {what}" if many.any() else ""
    return words


def _acting(position: TravelPosition) -> str:
    """Numbers of the axles that act, from 1: ``3, 4``."""
    return ", ".join(str(axle + 1) for axle in np.flatnonzero(position.acting).tolist())


def _carrier(model: Model, block: int) -> str:
    if block < 0:
        return "-"
    soil = model.soil_of_block[[block]]
    return model.blocks.name(block) if soil[0] < 0 else soil_words(model, soil)


def _row(model: Model, series: Series, case: CaseResult) -> list[str]:
    position = case.load_case.question.place
    mark = "  (worst)" if case is series.worst else ""
    return [
        case.load_case.name + mark,
        status_name(case.status),
        number(position.distance),
        vector(position.point),
        _carrier(model, int(position.blocks[0])),
        _acting(position),
        "any multiple" if np.isinf(figure_of(case)) else number(figure_of(case)),
    ]
