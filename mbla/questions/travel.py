"""Where on its path a travelling load is worst: the load factor at each of its positions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from mbla.questions.load_factor import LoadFactor
from mbla.questions.travel_position import TravelPosition


@dataclass(frozen=True)
class Travel(LoadFactor):
    """The load factor of one position."""

    place: TravelPosition
    name: ClassVar[str] = "travel"
