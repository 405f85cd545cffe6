"""What every way of saying the values of a parameter promises, and the register of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from mbla.arrays import FloatArray
from mbla.errors import ValueRefused
from mbla.sweeps.plan import Plain

Vector: TypeAlias = tuple[float, float, float]


class WayError(ValueRefused):
    """The values cannot be had in this design; the message says why and what helps."""


@dataclass(frozen=True)
class Form:
    """A column that a parameter fills.

    suffix : after the name of the parameter
    kind   : ``float``, ``int``, ``bool`` or ``text``
    role   : ``parameter``, ``azimuth`` or ``elevation``
    """

    kind: str = "float"
    role: str = "parameter"
    suffix: str = ""


@dataclass(frozen=True)
class Filled:
    """Values of a parameter.

    columns  : values for each of its columns, one for each position
    settings : what goes into the deck, one for each position
    """

    columns: tuple[Sequence[Plain], ...]
    settings: Sequence[Plain]


@dataclass(frozen=True)
class Way:
    """One way of saying values; ``section`` is what the sweep file holds under its key.

    levels : (section, vector) -> values at the positions of a grid, in order; raises WayError where there are none
    at     : (section, u, vector) -> values at quantiles u (n, n_quantiles), each in the open interval (0, 1)
    random : drawn values follow a distribution, so that a share of points is a probability
    forms  : section -> the columns, each of which takes one quantile where values are drawn

    ``vector`` is that of the base deck which a direction turns; None for everything else.
    """

    levels: Callable[[Any, Vector | None], Filled]
    at: Callable[[Any, FloatArray, Vector | None], Filled]
    random: bool
    forms: Callable[[Any], tuple[Form, ...]] = lambda section: (Form(),)


WAYS: dict[str, Way] = {}
"""by the key of a parameter in the sweep file"""


def register(key: str, way: Way) -> None:
    """Make a way known under its key in the sweep file."""
    WAYS[key] = way


def plain(values: Sequence[Plain]) -> Filled:
    """Values that fill their one column as they go into the deck."""
    return Filled((values,), values)


def no_levels(section: Any, vector: Vector | None) -> Filled:
    """A distribution has no levels."""
    raise WayError(
        "sweep-ranges", "is a distribution, which has no levels: draw it in a part random, latin_hypercube or sobol"
    )


def points_of(section: Any) -> int:
    """How many levels a range has."""
    if section.points is None:
        raise WayError("sweep-ranges", "needs points: how many values there are")
    return int(section.points)
