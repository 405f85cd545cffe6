"""What a code says of a load case, as results hold it; :mod:`mbla.codes` finds it."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.errors import Message

OLD = "circolare_617_2009"
NAMES = {"ntc_2018": "NTC 2018 with Circolare 7/2019", OLD: "Circolare 617/2009"}
"""of the codes, in words"""
RATIO = "zeta"
"""symbol of the ratio that decides at a limit state"""
REMARKS = frozenset({"assessment-not-done", "assessment-in-doubt"})
"""identifiers of remarks on an assessment"""


@dataclass(frozen=True)
class Figure:
    """One figure of an assessment.

    limit_state : SLD, SLV or SLC; empty for all of them
    unit        : in the deck's; empty for none
    """

    limit_state: str
    symbol: str
    value: float
    unit: str
    article: str
    words: str


@dataclass(frozen=True)
class Assessment:
    """Figures in the order in which they follow from each other, and what stands against them.

    code : in words
    """

    code: str
    figures: tuple[Figure, ...] = ()
    remarks: tuple[Message, ...] = ()

    @property
    def ratios(self) -> dict[str, Figure]:
        """Capacity over demand at every limit state that has a verdict."""
        return {each.limit_state: each for each in self.figures if each.symbol == RATIO}
