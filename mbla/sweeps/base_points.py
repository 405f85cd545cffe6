"""Whether the deck with the values of a point can be read at all, tried before anything is started."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.deck.reading import read_deck
from mbla.errors import DeckError
from mbla.sweeps.base import Base
from mbla.sweeps.design.design import Point
from mbla.sweeps.settings import override_texts


def check_points(base: Base, points: Sequence[Point]) -> None:
    """Refuse a sweep whose first, middle and last points are all refused as decks.

    One that is readable is enough: corners of a design may be no structure, and their rows then say so.

    Raises
    ------
    DeckError
        with what is wrong with the first point
    """
    tried = list({point.number: point for point in (points[0], points[len(points) // 2], points[-1])}.values())
    refused: list[DeckError] = []
    for point in tried:
        try:
            read_deck(base.path, (*base.fixed, *override_texts(point.settings)), expected=False)
        except DeckError as error:
            refused.append(error)
        else:
            return
    where = "first, middle and last point" if len(tried) > 1 else "only point"
    said = f"the deck is refused at the {where}: "
    raise DeckError(
        [
            base.sweep.fault_at(
                ("parameters",), fault.message.around(before=f"{said}{fault.key}: " if fault.key else said)
            )
            for fault in refused[0].faults
        ]
    )
