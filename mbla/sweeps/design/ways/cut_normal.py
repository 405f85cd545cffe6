"""Quantiles of the normal distribution, cut off at one or both ends or not at all.

The distribution that is cut off is what remains of the whole one, in proportion: with F its distribution function,
x(u) = F⁻¹(F(a) + u (F(b) − F(a))). scipy works it out from the nearer tail, so that it holds far from the mean too.
"""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray


def cut_normal(u: FloatArray, mean: float, deviation: float, least: float | None, greatest: float | None) -> FloatArray:
    """Values at quantiles u, (n,) as u."""
    from scipy.stats import truncnorm  # takes half a second to import, and is for drawn values only

    low = -math.inf if least is None else (least - mean) / deviation
    high = math.inf if greatest is None else (greatest - mean) / deviation
    with np.errstate(
        over="ignore", invalid="ignore"
    ):  # infinite values are told as what they are, with the place in the file
        values: FloatArray = mean + deviation * np.asarray(truncnorm.ppf(u, low, high), dtype=float)
    return values
