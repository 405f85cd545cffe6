"""The ways to say the values of a parameter, and what is common to some of them."""

from __future__ import annotations

from mbla.sweeps.file.content import Parameter

DISTRIBUTIONS = ("normal", "lognormal", "uniform", "triangular")
"""they have no levels: a grid cannot take them"""
WITH_POINTS = ("linear", "log", "horizon", "sphere")
"""they need a number of points where they are levels, and have none where they are sampled"""
WAYS = ("values", "linear", "log", "whole", *DISTRIBUTIONS, "horizon", "sphere")
RANDOM = (*DISTRIBUTIONS, "whole", "horizon", "sphere")
"""drawn values of these have a probability; those of plain ranges and lists only fill the space"""
DIRECTIONS = ("horizon", "sphere")
"""they turn a vector of the deck"""


def way_of(parameter: Parameter) -> str:
    """The one way that a checked parameter uses."""
    return next(way for way in WAYS if getattr(parameter, way) is not None)


def level_count(parameter: Parameter) -> int | None:
    """How many values a parameter has in a grid; None where it does not say, or has no levels."""
    if parameter.values is not None:
        return len(parameter.values)
    if parameter.whole is not None:
        return parameter.whole.end - parameter.whole.start + 1
    points: int | None = getattr(getattr(parameter, way_of(parameter)), "points", None)
    return points
