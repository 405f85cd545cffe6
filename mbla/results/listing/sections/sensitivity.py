"""How the load factor changes with parameters, in words and as a table."""

from __future__ import annotations

import math

from mbla.results.listing.blocks import Block, Paragraph, apart, table_of
from mbla.results.listing.text import number
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.thresholds import SOLVED_RESIDUAL

OF_ASSOCIATIVE = "Sensitivities to the parameters of the deck are those of the associative load factor, {}"
OF_ANOTHER = ": the load factor of this case is another one, without sensitivities"
THE_SAME = ", which is the load factor of this case"
MEANING = (
    "Elasticity: relative change of the load factor over that of the parameter. Where several mechanisms or fields of "
    "force give the same load factor, the slopes to both sides differ, and the one given lies between them."
)


SIDES = {Side.ABOVE: "above only", Side.BELOW: "below only", Side.KINK: "above"}
"""to which side a slope holds, where not to both"""


ROUNDING = 1e-7
"""Elasticity below which a slope is nothing but rounding."""


def sensitivity_blocks(case: CaseResult) -> list[Block]:
    """A row for each parameter that the deck asks for; nothing where it asks for none."""
    slopes, associative = case.solution.further.sensitivity, case.solution.associative
    if not slopes or associative is None:
        return []
    rows = [
        [
            each.parameter,
            f"{number(each.value)} {each.unit}".rstrip(),
            *(_figure(value, each) for value in (each.slope, each.elasticity)),
            "; ".join(words for words in (SIDES.get(each.side, ""), each.remark) if words),
        ]
        for each in slopes
    ]
    own = result_of(case)
    same = own is not None and math.isclose(own.load_factor, associative.load_factor, rel_tol=SOLVED_RESIDUAL)
    says = OF_ASSOCIATIVE.format(number(associative.load_factor))
    if case.solution.flow_rule != "associative":
        says += THE_SAME if same else OF_ANOTHER
    head = ["parameter", "value", "slope", "elasticity", ""]
    return [Paragraph(f"{says}."), *apart(table_of(head, rows)), *apart([Paragraph(MEANING)])]


def _figure(value: float, slope: Slope) -> str:
    """A figure of a row, 0 where it is rounding, a dash where it is not known."""
    if not math.isfinite(value):
        return "-"
    return "0" if slope.value != 0.0 and abs(slope.elasticity) < ROUNDING else number(value)
