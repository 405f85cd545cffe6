"""Probability that a result lies below a demand, or reaches a limit, estimated from the sample of a design.

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

Limits are for what grows with what acts: of n points k reach the limit, and a structure in time that falls passes all
of them. A list of values, such as records of earthquakes, may count as a sample.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import betaincinv

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.listing.text import sentence, table
from mbla.results.record.objects import Key
from mbla.results.tables.formats import csv_text
from mbla.sweeps.answers import Answer, Answers, answers_of, numbers_of
from mbla.sweeps.design.design import header_of
from mbla.sweeps.file.content import FALLS, FragilitySection
from mbla.sweeps.plan import Plain
from mbla.sweeps.results import FALLEN, IN_TIME, MOVES
from mbla.sweeps.tables.sweep_table import SweepTable, as_text

SAME = 1e-6
"""relative distance below a demand up to which a value still bears it: load factors are found to that accuracy, and one
that is the demand, as the slenderness of a block that rocks may be, must not be counted by its rounding"""


@dataclass(frozen=True)
class Asked:
    """What probabilities are asked of.

    result     : name of a column of numbers, or key path, which is one in each load case
    demands    : in the unit of the result, which lies below them
    limits     : likewise, which it reaches or passes; infinite: a structure in time falls
    samples    : dimension of the design whose points are the sample
    sampling   : as of the table; ``values`` for a list that counts as one
    over       : parameter over which a curve is fitted; empty for none
    confidence : of the intervals
    """

    result: str
    demands: tuple[float, ...] = ()
    limits: tuple[float, ...] = ()
    samples: str = ""
    sampling: str = ""
    over: str = ""
    confidence: float = 0.95


def asked_of(section: FragilitySection, table: SweepTable) -> Asked:
    """What the sweep file asks for, of the table that it makes."""
    samples, sampling = table.samples, table.sampling
    if section.sample is not None:
        own = section.sample, f"{section.sample}_azimuth"
        (samples,) = (column.dimension for column in table.columns if column.name in own)
        sampling = VALUES
    return Asked(
        section.result,
        tuple(map(float, section.demand or ())),
        tuple(math.inf if limit == FALLS else float(limit) for limit in section.limit or ()),
        samples,
        sampling,
        section.over or "",
        section.confidence,
    )


def fragility_of(table: SweepTable, asked: Asked) -> list[dict[str, Any]]:
    """For each column of a result and each combination of what is not sampled, in the order of the table.

    Returns objects as ``fragility_keys`` describes them.
    """
    found = []
    size = next(dimension.size for dimension in table.dimensions if dimension.name == asked.samples)
    for column in (column for column in table.of_role("result") if asked.result in (column.name, column.path)):
        answers = answers_of(table, column)
        past, unknown_to_limits = beyond(table, answers)
        sides = (
            ("demands", "demand", "below", asked.demands, answers.below, answers.unknown),
            ("limits", "limit", "passing", asked.limits, past, unknown_to_limits),
        )
        for at, rows in combinations(table, asked.samples):
            values, points = np.where(answers.good[rows], answers.values[rows], np.nan), len(rows)
            one: dict[str, Any] = {"result": column.name, "unit": column.unit, "at": at, "sampling": asked.sampling}
            one |= {"confidence": asked.confidence, "points": points, "left_out": size - points, "unknown": 0}
            for name, key, count, thresholds, certain, unknown in sides:
                one[name] = []
                for threshold in thresholds:
                    counted = certain[rows] | reached(values, threshold, name == "limits")
                    open_points = int((unknown[rows] & ~counted).sum())
                    ends = _share(int(counted.sum()), open_points, points, asked.confidence)
                    one[name].append({key: plain(threshold), count: int(counted.sum())} | ends)
                    one["unknown"] = open_points
            found.append(one)
    return found


def _share(counted: int, unknown: int, points: int, confidence: float) -> dict[str, list[float]]:
    probability = [counted / points, (counted + unknown) / points]
    return {"probability": probability, "interval": list(interval(counted, unknown, points, confidence))}


def plain(threshold: float) -> Plain:
    """A demand or limit as the record has it."""
    return FALLS if math.isinf(threshold) else threshold


def reached(values: FloatArray, threshold: float, upwards: bool) -> BoolArray:
    """Which values (n,) reach a limit, or lie below a demand; nan does neither."""
    room = 0.0 if math.isinf(threshold) else SAME * abs(threshold)
    return np.asarray(values >= threshold - room if upwards else values < threshold - room)


def beyond(table: SweepTable, answers: Answers) -> tuple[BoolArray, BoolArray]:
    """Points that pass every limit, and those whose place is unknown; (n_points,) each.

    A structure in time passes them where a block of it falls, and where it does not stand at rest; one whose history
    ends while it still moves may pass those that it has not reached, which is known where the results have that.
    """
    column = answers.column
    if not column.path.startswith(IN_TIME):
        return answers.above, answers.unknown
    own = {each.path: each for each in table.of_role("result") if each.case == column.case}
    past = answers.of(Answer.NO_EQUILIBRIUM)
    if FALLEN in own:
        past = past | (answers.good & (numbers_of(own[FALLEN], table[own[FALLEN].name]) > 0))
    unknown = ~answers.good
    if MOVES in own:
        unknown = unknown | (numbers_of(own[MOVES], table[own[MOVES].name]) > 0)
    return past, unknown & ~past


def interval(below: int, unknown: int, points: int, confidence: float) -> tuple[float, float]:
    """Ends of the interval of the probability; 0 and 1 where nothing is known.

    below   : points certainly below
    unknown : points that may be below or not
    """
    tail, most = (1.0 - confidence) / 2.0, below + unknown
    lower = float(betaincinv(below, points - below + 1.0, tail)) if below else 0.0
    upper = float(betaincinv(most + 1.0, points - most, 1.0 - tail)) if most < points else 1.0
    return lower, upper


def combinations(table: SweepTable, *inside: str) -> Iterator[tuple[dict[str, Plain], IntArray]]:
    """Values of the parameters outside of some dimensions, and the rows of their points, in the order of the design."""
    names = [dimension.name for dimension in table.dimensions]
    others = [axis for axis, name in enumerate(names) if name not in inside]
    outside = [
        (column, values)
        for column, values in zip(table.columns, table.values, strict=True)
        if column.dimension and column.dimension not in inside
    ]
    combinations, row = np.unique(table.position[:, others], axis=0, return_inverse=True)
    for place in range(len(combinations)):
        rows = np.flatnonzero(row.ravel() == place)
        yield {column.name: values[rows[:1]].tolist()[0] for column, values in outside}, rows


VALUES = "values"
"""sampling of a list of values"""
AS_DRAWN = (
    "the sample is a list of values, each counted alike: the interval is that of as many drawn at random from all that "
    "may come"
)
NOT_INDEPENDENT = (
    "the points of a {} sample are not independent: the interval is that of as many points drawn at random, mostly too "
    "wide for these, and not guaranteed"
)
UNKNOWN = (
    "points without a verified answer{} are unknown: they are counted both as below and as above a {}, and the "
    "interval holds both"
)


def fragility_lines(found: Sequence[Mapping[str, Any]], of: SweepTable) -> list[str]:
    """A table of every demand or limit, combination and result, and what must be known of them."""
    if not found:
        return []
    rows = _rows(found, of)
    head = [name for name in rows if name not in ("confidence", "sampling")]
    cells = [[short(value) for value in row] for row in zip(*(rows[name] for name in head), strict=True)]
    confidence, sampling = 100 * found[0]["confidence"], str(found[0]["sampling"])
    what = "reaches a limit" if found[0]["limits"] else "lies below a demand"
    lines = sentence(f"probability that a result {what}, with its {confidence:g} % interval:")
    lines += table([SHORT.get(name, name) for name in head], cells)
    if sampling == VALUES:
        lines += sentence(AS_DRAWN)
    elif sampling != "random":
        lines += sentence(NOT_INDEPENDENT.format(sampling.replace("_", " ")))
    limits = bool(found[0]["limits"])
    words = UNKNOWN.format(", and those that still move at their end," * limits, "limit" if limits else "demand")
    return lines + (sentence(words) if any(one["unknown"] for one in found) else [])


SHORT = {"probability_least": "at least", "probability_greatest": "at most"}
SHORT |= {"interval_lower": "from", "interval_upper": "to"}
"""names of columns on the terminal"""


def short(value: Plain) -> str:
    """A value in few letters."""
    return f"{value:.4g}" if isinstance(value, float) else as_text(value)


def _rows(found: Sequence[Mapping[str, Any]], of: SweepTable) -> dict[str, list[Any]]:
    """Columns by their headers: a row for each result, combination and demand or limit."""
    side, threshold, count = ("limits", "limit", "passing") if found[0]["limits"] else ("demands", "demand", "below")
    rows = [(one, each) for one in found for each in one[side]]
    headers = {column.name: column.header for column in of.columns}
    columns = {"result": [one["result"] for one, _ in rows]}
    columns |= {headers[name]: [one["at"][name] for one, _ in rows] for name in found[0]["at"]}
    columns[header_of(threshold, found[0]["unit"])] = [each[threshold] for _, each in rows]
    columns |= {
        "points": [one["points"] for one, _ in rows],
        count: [each[count] for _, each in rows],
        "unknown": [one["unknown"] for one, _ in rows],
    }
    for name, (low, high) in {"probability": ("least", "greatest"), "interval": ("lower", "upper")}.items():
        columns |= {f"{name}_{end}": [each[name][i] for _, each in rows] for i, end in enumerate((low, high))}
    return columns | {name: [one[name] for one, _ in rows] for name in ("confidence", "sampling")}


def fragility_csv(found: Sequence[Mapping[str, Any]], of: SweepTable) -> str:
    """The text of sweep_fragility.csv: a row for each result, combination and demand or limit."""
    rows = _rows(found, of) if found else {}
    return csv_text(tuple(rows), [np.array(values, dtype=object) for values in rows.values()]) if rows else ""


def fragility_keys(place: str) -> tuple[Key, ...]:
    """Description of these objects in the list at ``place``."""
    return (
        Key(place, "list", "probabilities that a result lies below demands, or reaches limits"),
        Key(f"{place}[]", "object", "of a result column at a combination of the parameters outside of the sample"),
        Key(f"{place}[].result", "string", "the column"),
        Key(f"{place}[].unit", "string", "its unit and that of the demands; empty for plain numbers"),
        Key(f"{place}[].at", "object", "the combination"),
        Key(f"{place}[].at.*", "any", "value of a parameter"),
        Key(
            f"{place}[].sampling",
            "string",
            "random, latin_hypercube or sobol, values for a list of them; intervals are exact for random alone",
        ),
        Key(f"{place}[].confidence", "number", "of the intervals"),
        Key(f"{place}[].points", "integer", "points of the sample"),
        Key(f"{place}[].left_out", "integer", "more of it, left out by constraints"),
        Key(
            f"{place}[].unknown",
            "integer",
            "those without a verified answer, and by limits those that still move at the end",
        ),
        Key(f"{place}[].demands", "list", "in the order of the sweep file; empty where limits are given"),
        Key(f"{place}[].demands[]", "object", "a demand"),
        Key(f"{place}[].demands[].demand", "number", "the demand"),
        Key(f"{place}[].demands[].below", "integer", "points certainly below it"),
        *_share_keys(f"{place}[].demands[]", "below it with unknown points above, and below"),
        Key(f"{place}[].limits", "list", "in the order of the sweep file; empty where demands are given"),
        Key(f"{place}[].limits[]", "object", "a limit"),
        Key(f"{place}[].limits[].limit", "any", "the limit; falls: that a block of a structure in time falls"),
        Key(f"{place}[].limits[].passing", "integer", "points that certainly reach it"),
        *_share_keys(f"{place}[].limits[]", "that reaches it with unknown points below, and above"),
    )


def _share_keys(place: str, words: str) -> tuple[Key, ...]:
    return (
        Key(f"{place}.probability", "list", f"fraction {words}"),
        Key(f"{place}.probability[]", "number", "a fraction"),
        Key(f"{place}.interval", "list", "of Clopper and Pearson, over both counts"),
        Key(f"{place}.interval[]", "number", "an end"),
    )
