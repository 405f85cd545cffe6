"""What a diagram asks of a deck: one point for each angle, each a setting of the deck."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mbla.sweeps.plan import Plain

DIRECTION, TWO_LOADS = "direction", "two_loads"


@dataclass(frozen=True)
class Question:
    """The points of one diagram.

    kind     : ``direction`` or ``two_loads``
    case     : load case that is solved at each point
    axes     : what the coordinates of the diagram are, in words: load factor times cosine, times sine of the angle
    short    : the same for the names of columns
    pair     : load cases of the deck as it is solved whose live loads add up, times cosine and sine, to that of each
               point; empty where they do not
    angles   : degrees, one for each point
    settings : values by key path of the deck, one mapping for each point
    fixed    : ``key.path=value`` texts for every point, after those of the command line
    closed   : the last point is followed by the first
    absolute : azimuths count from +x, rather than from the directions that the deck gives
    words    : what is turned or added, in sentences
    """

    kind: str
    case: str
    axes: tuple[str, str]
    short: tuple[str, str]
    pair: tuple[str, str] | tuple[()]
    angles: tuple[float, ...]
    settings: tuple[Mapping[str, Plain], ...]
    fixed: tuple[str, ...]
    closed: bool
    absolute: bool
    words: tuple[str, ...]
