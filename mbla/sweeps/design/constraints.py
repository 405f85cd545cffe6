"""Points that break a constraint: comparisons of the parameters of the sweep, and of the deck as they are there.

A comparison is evaluated once for each combination of positions along the axes that it depends on, however many other
axes the design has.
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.expressions import CONSTANTS, ExpressionError, ParameterFaultError, Parameters
from mbla.deck.suggestions import unknown
from mbla.errors import DeckError, Fault
from mbla.sweeps.design.design import DesignAxis, FaultAt
from mbla.sweeps.file.comparisons import ParameterComparison, read_comparison

OF_DECK = "parameters."
"""begins the key paths of the deck's own parameters"""


def constrained(
    constraints: Sequence[str], axes: Sequence[DesignAxis], known: Mapping[str, object], fault_at: FaultAt
) -> tuple[BoolArray, tuple[tuple[str, int], ...]]:
    """Which points stay, and every constraint with how many points break it.

    known : the deck's own parameters by name, as they are written

    Returns (size of each dimension, ...) True where no constraint is broken; the constraints as they are shown.
    Raises DeckError where a constraint names something else, or has no value at a point.
    """
    keep = np.ones([axis.dimension.size for axis in axes], dtype=bool)
    breaches: list[tuple[str, int]] = []
    faults: list[Fault] = []
    for number, comparison in enumerate(map(read_comparison, constraints)):
        try:
            holds = np.broadcast_to(_holds(comparison, axes, known), keep.shape)
        except ExpressionError as error:
            faults.append(fault_at(("constraints", number), error.message))
            continue
        breaches.append((comparison.text, int(np.count_nonzero(~holds))))
        keep &= holds
    if faults:
        raise DeckError(faults)
    return keep, tuple(breaches)


def _holds(comparison: ParameterComparison, axes: Sequence[DesignAxis], known: Mapping[str, object]) -> BoolArray:
    """Whether a comparison is true along the axes that it depends on; one position along the others."""
    columns = {column.name: column for axis in axes for column in axis.columns}
    replaced = {name for axis in axes for name in _of_deck(axis.settings[0])}
    for name in comparison.names:
        if name in columns and name in CONSTANTS:
            words = f"{name} is {CONSTANTS[name]:.6g} in expressions: give the parameter another name"
            raise ExpressionError("wrong-comparison", words)
        if name in columns and name in known and name not in replaced:
            words = f"{name} is a parameter of the sweep and another one of the deck: rename one of them"
            raise ExpressionError("wrong-comparison", words)
        names = dict.fromkeys([*columns, *known, *replaced, *CONSTANTS])
        if name not in names:
            raise ExpressionError("unknown-name", unknown(f"parameter {name}", name, names, "known"))
        if name in columns and name not in replaced and columns[name].kind in ("text", "bool"):
            words = f"{name} has values that are no numbers, which cannot be compared"
            raise ExpressionError("wrong-comparison", words)
    rows = [_rows(axis, set(comparison.names) - replaced) for axis in axes]
    holds = [_holds_at(comparison, ChainMap(*row, dict(known))) for row in product(*rows)]
    return np.array(holds, dtype=bool).reshape([len(of_axis) for of_axis in rows])


def _rows(axis: DesignAxis, names: set[str]) -> list[dict[str, object]]:
    """Values of these names and of the deck's own parameters at each position along an axis; one row if it has none."""
    columns = [column.name for column in axis.columns]
    rows = [
        {name: value for name, value in zip(columns, values, strict=True) if name in names} | _of_deck(settings)
        for values, settings in zip(axis.values, axis.settings, strict=True)
    ]
    return rows if rows[0] else [{}]


def _of_deck(settings: Mapping[str, object]) -> dict[str, object]:
    """Those of the deck's own parameters by name."""
    return {key.removeprefix(OF_DECK): value for key, value in settings.items() if key.startswith(OF_DECK)}


def _holds_at(comparison: ParameterComparison, raw: Mapping[str, object]) -> bool:
    parameters = Parameters(raw)
    try:
        return comparison.holds(parameters.value)
    except ExpressionError as error:
        of_deck = parameters.failures() if isinstance(error, ParameterFaultError) else ()
        said = "; ".join(f"{name} {message}" for name, message in of_deck) or str(error)
        where = " and ".join(f"{name} = {_shown(raw[name])}" for name in comparison.names if name in raw)
        raise ExpressionError("wrong-comparison", f"{said}{where and ', where '}{where}") from None


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, (int, float)) and math.isfinite(value) else str(value)
