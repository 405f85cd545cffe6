"""The reaction of a support that gives way, from load factors: value, bounds, and what it falls from.

reaction = reaction at rest − load factor × unit, so that the kinematic bound of the load factor is a lower bound of the
reaction and the static one an upper bound.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.model.model import Model, Settlement
from mbla.results.listing.text import entry
from mbla.results.listing.text import number as figure
from mbla.results.outcome import result_of
from mbla.results.records.numbers import number
from mbla.results.results import CaseResult


def reaction_of(case: CaseResult) -> float | None:
    """Reaction at which the structure follows the support; None where that is no result, or no support gives way."""
    mechanics, settlement = result_of(case), case.load_case.settlement
    return None if mechanics is None or settlement is None else settlement.reaction(mechanics.load_factor)


def reaction_words(model: Model, settlement: Settlement, load_factor: float) -> str:
    """``a reaction of 5232 N``, or ``a reaction of 120 N m``."""
    return f"a reaction of {reaction_figure(settlement, load_factor)} {reaction_unit(model, settlement)}"


def reaction_figure(settlement: Settlement, load_factor: float) -> str:
    """The reaction of a load factor in digits, without its unit."""
    return _figure(settlement.reaction(load_factor), settlement)


def reaction_json(case: CaseResult) -> dict[str, Any] | None:
    """The reaction with its bounds (those of associative flow) and what the load factor is counted from and in."""
    settlement = case.load_case.settlement
    if settlement is None:
        return None
    value = reaction_of(case)
    return {
        "value": None if value is None else number(value),
        "lower_bound": number(settlement.reaction(case.checks.kinematic_bound)),
        "upper_bound": number(settlement.reaction(case.checks.static_bound)),
        "at_rest": number(settlement.reference),
        "unit": number(settlement.unit),
        "kind": "moment" if settlement.turns else "force",
    }


def settlement_lines(model: Model, case: CaseResult) -> list[str]:
    """The reaction, its bounds, and what it falls from, one to a line; nothing where no support gives way."""
    settlement, checks = case.load_case.settlement, case.checks
    if settlement is None:
        return []
    value, unit = reaction_of(case), reaction_unit(model, settlement)
    lines = []
    if value is not None:
        share = _figure(value / settlement.unit, settlement, 1.0)
        words = f"{_figure(value, settlement)} {unit}   ({share} of {_of(settlement)})"
        lines += entry("reaction of the support", words)
        if value < -NOTHING * settlement.unit:
            pushed = "turned" if settlement.turns else "pushed"
            lines += entry("", f"negative: the structure withstands; the support must be {pushed} the way it gives")
    if np.isfinite(checks.kinematic_bound) and np.isfinite(checks.static_bound):
        ends = (settlement.reaction(checks.kinematic_bound), settlement.reaction(checks.static_bound))
        lines += entry("associative, its bounds", f"{' .. '.join(f'{end:.8g}' for end in ends)} {unit}")
    lines += entry("one at rest", f"{figure(settlement.reference)} {unit}   (many may be possible)")
    return lines + entry("load factor counts", f"its loss, in {figure(settlement.unit)} {unit}: {_of(settlement)}")


NOTHING = 1e-9
"""share of its unit below which a reaction is written as zero: rounding of the load factor"""


def _figure(value: float, settlement: Settlement, unit: float | None = None) -> str:
    """A reaction in digits, zero where it is one."""
    return figure(0.0 if abs(value) <= NOTHING * (unit or settlement.unit) else value)


def _of(settlement: Settlement) -> str:
    what = "the dead load of the free blocks"
    return f"{what} times its mean distance from the axis" if settlement.turns else what


def reaction_unit(model: Model, settlement: Settlement) -> str:
    """``N``, or ``N m`` where the support turns."""
    units = model.units
    return f"{units.force} {units.length}" if settlement.turns else units.force
