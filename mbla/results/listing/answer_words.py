"""The answer of a case in digits for tables: a load factor, the angle of a tilting table, the reaction of a support."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from mbla.model.model import LoadCase, Model
from mbla.results.listing.settlement_words import reaction_figure, reaction_unit
from mbla.results.listing.text import number
from mbla.results.outcome import associative_of, extent_of, result_of
from mbla.results.results import CaseResult
from mbla.results.tilt_angle import angle_at, angle_bounds
from mbla.solution.solution import Mechanics, Status


def answer_head(model: Model, load_case: LoadCase) -> str:
    """What the load factor of a case stands for: the head of its column."""
    if load_case.settlement is not None:
        return f"reaction [{reaction_unit(model, load_case.settlement)}]"
    return "load factor" if load_case.tilt is None else "angle [degree]"


def answer_figure(load_case: LoadCase, mechanics: Mechanics | None) -> str:
    """The answer of forces and mechanism in six digits; ``-`` where there are none."""
    if mechanics is None:
        return "-"
    if load_case.settlement is not None:
        return reaction_figure(load_case.settlement, mechanics.load_factor)
    if load_case.tilt is None:
        return number(mechanics.load_factor)
    return number(angle_at(load_case.tilt, mechanics.load_factor))


def status_name(status: Status) -> str:
    """A status in words: ``not verified``; files and decks have its key."""
    return status.value.replace("_", " ")


def status_words(status: Status) -> str:
    """``solved``; everything else stands out, ``NOT VERIFIED``."""
    return status_name(status) if status is Status.SOLVED else status_name(status).upper()


def bound_figures(case: CaseResult) -> tuple[str, str]:
    """What associative flow proves to be borne and not to be borne, as the answer of the case, eight digits."""
    if case.load_case.tilt is not None:
        lowest, highest = angle_bounds(case)
        return _digits(lowest), _digits(highest)
    return _of_factor(case.load_case, case.checks.static_bound), _of_factor(case.load_case, case.checks.kinematic_bound)


def answer_columns(model: Model, cases: Sequence[CaseResult]) -> tuple[list[str], list[list[str]]]:
    """Heads and, for each case, figures: of every kind of answer, the least and the greatest found, the associative.

    Least and greatest are there where some case has several figures; a case with one has it in both.
    """
    answers = list(dict.fromkeys(answer_head(model, case.load_case) for case in cases))
    several = any(extent_of(model, case) is not None for case in cases)
    rows = []
    for case in cases:
        own = answer_figure(case.load_case, result_of(case))
        figures = [own if head == answer_head(model, case.load_case) else "" for head in answers]
        ends = extent_figures(model, case) if several else ()
        rows.append([*figures, *ends, answer_figure(case.load_case, associative_of(case))])
    return [*answers, *(LEAST_AND_GREATEST if several else ()), "associative"], rows


LEAST_AND_GREATEST = ("least found", "greatest found")


def extent_figures(model: Model, case: CaseResult) -> tuple[str, str]:
    """The least and the greatest answer that were found, six digits; the answer twice where it is the only one."""
    own, extent = result_of(case), extent_of(model, case)
    if own is None or extent is None:
        figure = answer_figure(case.load_case, own)
        return figure, figure
    figures = [answer_figure(case.load_case, replace(own, load_factor=end)) for end in in_order(case.load_case, extent)]
    return figures[0], figures[1]


def in_order(load_case: LoadCase, ends: tuple[float, float]) -> tuple[float, float]:
    """Load factors of the least and the greatest answer: the greater the loss, the less the reaction."""
    return ends if load_case.settlement is None else (ends[1], ends[0])


def _of_factor(load_case: LoadCase, load_factor: float) -> str:
    if math.isnan(load_factor):
        return "-"
    if load_case.settlement is not None:
        return _digits(load_case.settlement.reaction(load_factor))
    return _digits(load_factor if load_case.tilt is None else angle_at(load_case.tilt, load_factor))


def _digits(value: float) -> str:
    return "-" if math.isnan(value) else f"{value + 0.0:.8g}"
