"""The answer of a case in digits for tables: a load factor, the angle of a tilting table, the reaction of a support."""

from __future__ import annotations

import math

from mbla.model.model import LoadCase, Model
from mbla.results.outcome import range_of
from mbla.results.results import CaseResult
from mbla.results.tilt_angle import angle_at, angle_bounds
from mbla.results.words.settlement_words import reaction_figure, reaction_unit
from mbla.results.words.text import number
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


def range_figures(case: CaseResult) -> str:
    """``0.56 .. 0.6``: verified ends of the range for the mechanism found, as the answer of the case."""
    ends = range_of(case)
    if ends is None:
        return "-"
    figures = [_of_factor(case.load_case, end) for end in ends]
    if case.load_case.settlement is not None:  # the greater the loss, the less the reaction
        figures.reverse()
    return " .. ".join(figures)


def _of_factor(load_case: LoadCase, load_factor: float) -> str:
    if math.isnan(load_factor):
        return "-"
    if load_case.settlement is not None:
        return _digits(load_case.settlement.reaction(load_factor))
    return _digits(load_factor if load_case.tilt is None else angle_at(load_case.tilt, load_factor))


def _digits(value: float) -> str:
    return "-" if math.isnan(value) else f"{value + 0.0:.8g}"
