"""How much a result depends on each parameter.

Of samples: Spearman's rank correlation with its interval by Fisher's transformation, variance of Bonett and Wright,
Psychometrika 65 (2000) 23-28, doi:10.1007/BF02294183. Of grids: the change of the result from the least value of a
parameter to the greatest, and its range over all of them, at each combination of the other parameters.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from scipy.stats import rankdata

from mbla.arrays import FloatArray
from mbla.sweeps.answers import numbers_of, told_apart
from mbla.sweeps.pictures.axes import Axis
from mbla.sweeps.pictures.view import View
from mbla.sweeps.tables.sweep_table import SweepColumn

CONFIDENCE = 0.95
LEAST_POINTS = 10
"""points from which a correlation and its interval are worth a picture; the interval's variance needs more than 3"""


@dataclass(frozen=True)
class Correlation:
    """Rank correlation with one parameter.

    value : -1 to 1; nan where either does not vary
    low, high : of the interval
    points : those with a verified value
    """

    name: str
    value: float
    low: float
    high: float
    points: int


@dataclass(frozen=True)
class Swing:
    """What one parameter of a grid does to the result.

    change : mean change from its least value to its greatest; nan where its values have no order
    least, most : of that change among the combinations of the others; nan where it is
    span : mean of greatest less least result over its values
    combinations : of the other parameters that have a verified value at each value of this one
    left_out : the other combinations
    """

    name: str
    change: float
    least: float
    most: float
    span: float
    combinations: int
    left_out: int


def correlation(view: View, column: SweepColumn) -> Correlation:
    """Rank correlation of the result with a parameter over the points with a verified value."""
    x, y = numbers_of(column, view.table[column.name]), view.answers.values
    good = view.answers.good & np.isfinite(x)
    count = int(good.sum())
    rho = rank_correlation(x[good], told_apart(y[good]))
    if not np.isfinite(rho) or count <= 3:
        return Correlation(column.name, rho, np.nan, np.nan, count)
    reach = NormalDist().inv_cdf((1 + CONFIDENCE) / 2) * np.sqrt((1 + rho**2 / 2) / (count - 3))
    centre = np.arctanh(np.clip(rho, -1 + 1e-15, 1 - 1e-15))
    return Correlation(column.name, rho, float(np.tanh(centre - reach)), float(np.tanh(centre + reach)), count)


def rank_correlation(x: FloatArray, y: FloatArray) -> float:
    """Spearman's coefficient, equal values at their mean rank; nan where either does not vary."""
    if len(x) < 2 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return float("nan")
    return float(np.corrcoef(rankdata(x), rankdata(y))[0, 1])


def swing(view: View, axis: Axis) -> Swing:
    """What a parameter of a grid does; combinations of the others in which a point is missing are left out."""
    others = [i for i, own in enumerate(view.table.dimensions) if own.name != axis.column.dimension]
    _, group = np.unique(view.table.position[:, others], axis=0, return_inverse=True)
    group = group.reshape(-1)
    result = np.full((int(group.max()) + 1, len(axis.levels)), np.nan)
    result[group, axis.place] = np.where(view.answers.good, view.answers.values, np.nan)
    whole = np.isfinite(result).all(axis=1)
    own = told_apart(result[whole])
    count = len(own)
    if not count:
        return Swing(axis.column.name, np.nan, np.nan, np.nan, np.nan, 0, len(result))
    span = float(np.ptp(own, axis=1).mean())
    ordered = not axis.categorical and axis.column.role == "parameter"
    change = own[:, -1] - own[:, 0] if ordered else np.array([np.nan])
    least, most = float(change.min()), float(change.max())
    return Swing(axis.column.name, float(change.mean()), least, most, span, count, len(result) - count)
