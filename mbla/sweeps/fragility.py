"""Probability that a result lies below a demand, estimated from the random sample of a design.

Of n sample points k lie below the demand. The interval of that probability is that of Clopper and Pearson (1934,
doi:10.1093/biomet/26.4.404), which holds at least the confidence that it is given, whatever n and k: its ends are
quantiles of beta distributions, ::

    lower = I⁻¹(α/2; k, n − k + 1),   upper = I⁻¹(1 − α/2; k + 1, n − k),   α = 1 − confidence.

(The narrower one of Wilson holds it on average only, and fails where k is 0 or 1, which is where safety is judged.) It
is exact for points drawn at random. Points of a Latin hypercube or of a Sobol sequence are not independent; their
fraction mostly scatters less, for a Latin hypercube never notably more (Owen 1997, doi:10.1137/S0036142994277468), so
that the same interval is mostly too wide and nowhere guaranteed.

A structure that does not stand lies below every demand, one that no load brings down above every one. A point without a
verified answer is unknown: it is counted on either side in turn, and the interval holds both.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from scipy.special import betaincinv

from mbla.arrays import IntArray
from mbla.results.listing.text import sentence, table
from mbla.results.record.objects import Key
from mbla.results.tables.formats import csv_text
from mbla.sweeps.answers import answers_of
from mbla.sweeps.design.design import header_of
from mbla.sweeps.plan import Plain
from mbla.sweeps.tables.sweep_table import SweepTable, as_text

SAME = 1e-6
"""relative distance below a demand up to which a value still bears it: load factors are found to that accuracy, and one
that is the demand, as the slenderness of a block that rocks may be, must not be counted by its rounding"""


def fragility_of(table: SweepTable, result: str, demands: Sequence[float], confidence: float) -> list[dict[str, Any]]:
    """For each column of a result and each combination of what is not sampled, in the order of the table.

    result  : name of a column of numbers, or key path, which is one in each load case
    demands : in the unit of the result

    Returns objects as ``fragility_keys`` describes them.
    """
    found = []
    size = next(dimension.size for dimension in table.dimensions if dimension.name == table.samples)
    for column in (column for column in table.of_role("result") if result in (column.name, column.path)):
        answers = answers_of(table, column)
        for at, rows in _combinations(table):
            values, points = answers.values[rows][answers.good[rows]], len(rows)
            fallen, unknown = int(answers.below[rows].sum()), int(answers.unknown[rows].sum())
            counts = []
            for demand in map(float, demands):
                below = fallen + int((values < demand - SAME * abs(demand)).sum())
                probability = [below / points, (below + unknown) / points]
                ends = list(interval(below, unknown, points, confidence))
                counts.append({"demand": demand, "below": below, "probability": probability, "interval": ends})
            one: dict[str, Any] = {"result": column.name, "unit": column.unit, "at": at, "sampling": table.sampling}
            one |= {"confidence": confidence, "points": points, "left_out": size - points}
            found.append(one | {"unknown": unknown, "demands": counts})
    return found


def interval(below: int, unknown: int, points: int, confidence: float) -> tuple[float, float]:
    """Ends of the interval of the probability; 0 and 1 where nothing is known.

    below   : points certainly below
    unknown : points that may be below or not
    """
    tail, most = (1.0 - confidence) / 2.0, below + unknown
    lower = float(betaincinv(below, points - below + 1.0, tail)) if below else 0.0
    upper = float(betaincinv(most + 1.0, points - most, 1.0 - tail)) if most < points else 1.0
    return lower, upper


def _combinations(table: SweepTable) -> Iterator[tuple[dict[str, Plain], IntArray]]:
    """Values of the parameters outside of the sample, and the rows of its points, in the order of the design."""
    names = [dimension.name for dimension in table.dimensions]
    others = [axis for axis, name in enumerate(names) if name != table.samples]
    outside = [
        (column, values)
        for column, values in zip(table.columns, table.values, strict=True)
        if column.dimension and column.dimension != table.samples
    ]
    combinations, row = np.unique(table.position[:, others], axis=0, return_inverse=True)
    for place in range(len(combinations)):
        rows = np.flatnonzero(row.ravel() == place)
        yield {column.name: values[rows[:1]].tolist()[0] for column, values in outside}, rows


NOT_INDEPENDENT = (
    "the points of a {} sample are not independent: the interval is that of as many points drawn at random, mostly too "
    "wide for these, and not guaranteed"
)
UNKNOWN = (
    "points without a verified answer are unknown: they are counted both as below and as above a demand, and the "
    "interval holds both"
)


def fragility_lines(found: Sequence[Mapping[str, Any]], of: SweepTable) -> list[str]:
    """A table of every demand, combination and result, and what must be known of them."""
    if not found:
        return []
    rows = _rows(found, of)
    head = [name for name in rows if name not in ("confidence", "sampling")]
    cells = [[_short(value) for value in row] for row in zip(*(rows[name] for name in head), strict=True)]
    confidence = 100 * found[0]["confidence"]
    lines = sentence(f"probability that a result lies below a demand, with its {confidence:g} % interval:")
    lines += table([SHORT.get(name, name) for name in head], cells)
    if of.sampling != "random":
        lines += sentence(NOT_INDEPENDENT.format(of.sampling.replace("_", " ")))
    return lines + (sentence(UNKNOWN) if any(one["unknown"] for one in found) else [])


SHORT = {"probability_least": "at least", "probability_greatest": "at most"}
SHORT |= {"interval_lower": "from", "interval_upper": "to"}
"""names of columns on the terminal"""


def _short(value: Plain) -> str:
    return f"{value:.4g}" if isinstance(value, float) else as_text(value)


def _rows(found: Sequence[Mapping[str, Any]], of: SweepTable) -> dict[str, list[Any]]:
    """Columns by their headers: a row for each result, combination and demand."""
    rows = [(one, each) for one in found for each in one["demands"]]
    headers = {column.name: column.header for column in of.columns}
    columns = {"result": [one["result"] for one, _ in rows]}
    columns |= {headers[name]: [one["at"][name] for one, _ in rows] for name in found[0]["at"]}
    columns[header_of("demand", found[0]["unit"])] = [each["demand"] for _, each in rows]
    columns |= {
        "points": [one["points"] for one, _ in rows],
        "below": [each["below"] for _, each in rows],
        "unknown": [one["unknown"] for one, _ in rows],
    }
    for name, (low, high) in {"probability": ("least", "greatest"), "interval": ("lower", "upper")}.items():
        columns |= {f"{name}_{end}": [each[name][i] for _, each in rows] for i, end in enumerate((low, high))}
    return columns | {name: [one[name] for one, _ in rows] for name in ("confidence", "sampling")}


def fragility_csv(found: Sequence[Mapping[str, Any]], of: SweepTable) -> str:
    """The text of sweep_fragility.csv: a row for each result, combination and demand."""
    rows = _rows(found, of) if found else {}
    return csv_text(tuple(rows), [np.array(values, dtype=object) for values in rows.values()]) if rows else ""


def fragility_keys(place: str) -> tuple[Key, ...]:
    """Description of these objects in the list at ``place``."""
    return (
        Key(place, "list", "probabilities that a result lies below demands"),
        Key(f"{place}[]", "object", "of a result column at a combination of the parameters outside of the sample"),
        Key(f"{place}[].result", "string", "the column"),
        Key(f"{place}[].unit", "string", "its unit and that of the demands; empty for plain numbers"),
        Key(f"{place}[].at", "object", "the combination"),
        Key(f"{place}[].at.*", "any", "value of a parameter"),
        Key(f"{place}[].sampling", "string", "random, latin_hypercube or sobol; intervals are exact for random alone"),
        Key(f"{place}[].confidence", "number", "of the intervals"),
        Key(f"{place}[].points", "integer", "points of the sample"),
        Key(f"{place}[].left_out", "integer", "more of it, left out by constraints"),
        Key(f"{place}[].unknown", "integer", "those without a verified answer"),
        Key(f"{place}[].demands", "list", "in the order of the sweep file"),
        Key(f"{place}[].demands[]", "object", "a demand"),
        Key(f"{place}[].demands[].demand", "number", "the demand"),
        Key(f"{place}[].demands[].below", "integer", "points certainly below it"),
        Key(f"{place}[].demands[].probability", "list", "fraction below it with unknown points above, and below"),
        Key(f"{place}[].demands[].probability[]", "number", "a fraction"),
        Key(f"{place}[].demands[].interval", "list", "of Clopper and Pearson, over both counts"),
        Key(f"{place}[].demands[].interval[]", "number", "an end"),
    )
