"""Probabilities of a sweep in words, as JSON and as CSV."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mbla.results.listing.text import sentence, table
from mbla.results.records.key import Key
from mbla.results.records.numbers import number, numbers
from mbla.results.tables.csv_file import csv_text
from mbla.sweeps.fragility import Fragility
from mbla.sweeps.plan import Plain
from mbla.sweeps.tables.from_outcomes import as_text, column_values
from mbla.sweeps.tables.sweep_table import header_of

NOT_INDEPENDENT = (
    "the points of a {} are not independent: the interval is that of as many points drawn at random, mostly too wide "
    "for these, and not guaranteed"
)
SAMPLED = {
    "random": "",
    "latin_hypercube": NOT_INDEPENDENT.format("Latin hypercube"),
    "sobol": NOT_INDEPENDENT.format("Sobol sequence"),
}
"""what is said of intervals of samples that are not drawn point by point"""


def fragility_lines(found: Sequence[Fragility]) -> list[str]:
    """A table for each result, a line for each demand and combination, and what must be known of them."""
    lines: list[str] = []
    for name in dict.fromkeys(one.column.name for one in found):
        own = [one for one in found if one.column.name == name]
        lines += sentence(
            f"probability that {name} lies below a demand, with its {100 * own[0].confidence:g} % interval:"
        )
        head = [
            *(header_of(parameter, own[0].units[parameter]) for parameter in own[0].at),
            header_of("demand", own[0].column.unit),
            *("points", "below", "unknown", "probability", "interval"),
        ]
        lines += table(head, [_cells(one, row) for one in own for row in range(len(one.demands))], left=0)
    return lines + [line for remark in _remarks(found) for line in sentence(remark)]


def _cells(one: Fragility, row: int) -> list[str]:
    least, greatest = one.least[row], one.greatest[row]
    return [
        *(_short(value) for value in one.at.values()),
        f"{one.demands[row]:g}",
        str(one.points),
        str(one.below[row]),
        str(one.unknown),
        f"{least:.4f} to {greatest:.4f}" if one.unknown else f"{least:.4f}",
        f"{one.lower[row]:.4f} to {one.upper[row]:.4f}",
    ]


def _short(value: Plain) -> str:
    return f"{value:g}" if isinstance(value, float) else as_text(value)


def _remarks(found: Sequence[Fragility]) -> list[str]:
    remarks = list(dict.fromkeys(SAMPLED[one.sampling] for one in found))
    if any(one.unknown for one in found):
        remarks.append(
            "points without a verified answer are unknown: they are counted both as below and as above a demand, and "
            "the interval holds both"
        )
    return [remark for remark in remarks if remark]


def fragility_json(found: Sequence[Fragility]) -> list[dict[str, Any]]:
    """An object for each result and combination, as ``fragility_keys`` describes them."""
    return [
        {
            "result": one.column.name,
            "unit": one.column.unit,
            "at": dict(one.at),
            "sampling": one.sampling,
            "confidence": one.confidence,
            "points": one.points,
            "left_out": one.left_out,
            "unknown": one.unknown,
            "demands": [
                {
                    "demand": number(demand),
                    "below": int(below),
                    "probability": numbers((least, greatest)),
                    "interval": numbers((lower, upper)),
                }
                for demand, below, least, greatest, lower, upper in zip(
                    one.demands, one.below, one.least, one.greatest, one.lower, one.upper, strict=True
                )
            ],
        }
        for one in found
    ]


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


def fragility_csv(found: Sequence[Fragility]) -> str:
    """The text of sweep_fragility.csv: a row for each result, combination and demand."""
    if not found:
        return ""
    rows = [(one, row) for one in found for row in range(len(one.demands))]
    columns = {
        "result": column_values("text", [one.column.name for one, _ in rows]),
        **{
            header_of(name, found[0].units[name]): column_values(
                _kind([one.at[name] for one in found]), [one.at[name] for one, _ in rows]
            )
            for name in found[0].at
        },
        header_of("demand", found[0].column.unit): np.array([one.demands[row] for one, row in rows]),
        "points": np.array([one.points for one, _ in rows]),
        "below": np.array([one.below[row] for one, row in rows]),
        "unknown": np.array([one.unknown for one, _ in rows]),
        "probability_least": np.array([one.least[row] for one, row in rows]),
        "probability_greatest": np.array([one.greatest[row] for one, row in rows]),
        "interval_lower": np.array([one.lower[row] for one, row in rows]),
        "interval_upper": np.array([one.upper[row] for one, row in rows]),
        "confidence": np.array([one.confidence for one, _ in rows]),
        "sampling": column_values("text", [one.sampling for one, _ in rows]),
    }
    return csv_text(tuple(columns), tuple(columns.values()))


def _kind(values: Sequence[Plain]) -> str:
    """Kind of the column of a parameter, by its values."""
    types = {type(value) for value in values}
    return {float: "float", int: "int", bool: "bool"}.get(types.pop(), "text") if len(types) == 1 else "text"
