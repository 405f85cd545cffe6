"""How a load factor changes with a parameter, as results have it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Side(StrEnum):
    """On which side of the value of a parameter a slope holds; at a kink, with a slope on each side, the one above."""

    BOTH = "both"
    ABOVE = "above"
    BELOW = "below"
    KINK = "kink"
    NONE = "not known"


@dataclass(frozen=True)
class Slope:
    """How the associative load factor changes with a parameter.

    parameter  : key path in the deck; ``dead load`` or ``live load``: a factor on all of it; ``tie`` and a name:
                 the force at which that yields
    value      : in the deck's unit
    unit       : empty for plain numbers, and for parameters of expressions
    slope      : derivative of the load factor by it, nan where it is not known
    elasticity : relative change of the load factor over that of the parameter; nan where the load factor is 0
    side       : see ``Side``
    remark     : in words; empty for nothing
    """

    parameter: str
    value: float
    unit: str
    slope: float
    elasticity: float
    side: Side
    remark: str
