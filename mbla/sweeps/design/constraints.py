"""Points that break a constraint: comparisons of the parameters of the sweep, and of the deck as they are there.

A comparison is worked out once for each combination of positions along the axes that it depends on, however many other
axes the design has.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.comparisons import Comparison, read_comparison
from mbla.deck.expressions import (
    CONSTANTS,
    ExpressionError,
    ParameterFaultError,
    Parameters,
)
from mbla.deck.suggestions import unknown
from mbla.errors import DeckError, Fault
from mbla.sweeps.design.design import Axis, FaultAt

OF_DECK = "parameters."
"""begins the key paths of the deck's own parameters"""
NO_VALUES: list[dict[str, object]] = [{}]
"""of an axis that does not matter: one position for all"""


def constrained(
    constraints: Sequence[str], axes: Sequence[Axis], known: Mapping[str, object], fault_at: FaultAt
) -> tuple[BoolArray, tuple[tuple[str, int], ...]]:
    """Which points stay, and every constraint with how many points break it.

    known : the deck's own parameters by name, as they are written

    Returns
    -------
    tuple
        (size of each dimension, ...) True where no constraint is broken; the constraints as they are shown

    Raises
    ------
    DeckError
        a constraint that names something else, or has no value at a point
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


def _holds(comparison: Comparison, axes: Sequence[Axis], known: Mapping[str, object]) -> BoolArray:
    """Whether a comparison is true along the axes that it depends on; one position along the others."""
    columns = {column.name: column for axis in axes for column in axis.columns}
    set_names = [_deck_names(axis) for axis in axes]
    raw = {**known, **{name: value for axis in axes for name, value in _deck_values(axis, 0).items()}}
    own = {name for name in comparison.names if name in columns and name not in raw}
    for name in comparison.names:
        if name in columns and name in CONSTANTS:
            raise ExpressionError(
                "wrong-comparison", f"{name} is {CONSTANTS[name]:.6g} in expressions: give the parameter another name"
            )
        if name in columns and name in known and not any(name in names for names in set_names):
            raise ExpressionError(
                "wrong-comparison",
                f"{name} is a parameter of the sweep and another one of the deck: rename one of them",
            )
        if name not in columns and name not in raw and name not in CONSTANTS:
            raise ExpressionError(
                "unknown-name", unknown(f"parameter {name}", name, dict.fromkeys([*columns, *raw, *CONSTANTS]), "known")
            )
        if name in own and columns[name].kind in ("text", "bool"):
            raise ExpressionError(
                "wrong-comparison", f"{name} has values that are no numbers, which cannot be compared"
            )
    rows = [_rows(axis, own) if own & _names(axis) or _deck_names(axis) else NO_VALUES for axis in axes]
    holds = [_holds_at(comparison, known, row) for row in product(*rows)]
    return np.array(holds, dtype=bool).reshape([len(of_axis) for of_axis in rows])


def _names(axis: Axis) -> set[str]:
    return {column.name for column in axis.columns}


def _rows(axis: Axis, own: set[str]) -> list[dict[str, object]]:
    """Values by name at each position along an axis: its own columns, and the deck's parameters that it sets."""
    names = [column.name for column in axis.columns]
    return [
        {name: value for name, value in zip(names, values, strict=True) if name in own} | _deck_values(axis, position)
        for position, values in enumerate(axis.values)
    ]


def _deck_names(axis: Axis) -> set[str]:
    return set(_deck_values(axis, 0))


def _deck_values(axis: Axis, position: int) -> dict[str, object]:
    """Values of the deck's own parameters that are set at a position."""
    return {
        key.removeprefix(OF_DECK): value for key, value in axis.settings[position].items() if key.startswith(OF_DECK)
    }


def _holds_at(comparison: Comparison, fixed: Mapping[str, object], rows: Sequence[Mapping[str, object]]) -> bool:
    raw: dict[str, object] = dict(fixed)
    for row in rows:
        raw.update(row)
    parameters = Parameters(raw)
    try:
        return comparison.holds(parameters.value)
    except ParameterFaultError as error:
        told = [f"{name} {message}" for name, message in parameters.failures()] or [str(error)]
        raise ExpressionError("wrong-comparison", f"{'; '.join(told)}{_where(comparison, raw)}") from None
    except ExpressionError as error:
        raise ExpressionError("wrong-comparison", f"{error}{_where(comparison, raw)}") from None


def _where(comparison: Comparison, raw: Mapping[str, object]) -> str:
    """``, where a = 1 and b = 0``."""
    told = [f"{name} = {_shown(raw[name])}" for name in comparison.names if name in raw]
    return f", where {' and '.join(told)}" if told else ""


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, (int, float)) and math.isfinite(value) else str(value)
