"""Where on its path a travelling load is worst: the load factor at each of its positions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from mbla.questions.load_factor import LoadFactor
from mbla.questions.travel_position import TravelPosition


@dataclass(frozen=True)
class Travel(LoadFactor):
    """The load factor of one position."""

    position: TravelPosition
    name: ClassVar[str] = "travel"

    @property
    def place(self) -> TravelPosition:
        """That position."""
        return self.position

    @property
    def series(self) -> str:
        """Load case of all positions."""
        return self.position.series
