"""A quantity of blocks, interfaces, contact points or load cases with how it is read from a scene: one column."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from mbla.results.record.quantity import Quantity, whole
from mbla.results.record.scene import FIGURES, Scene
from mbla.results.record.stored import STORED_BY_PATH

Values: TypeAlias = "np.typing.NDArray[Any]"


FIGURES_TOLD = whole(
    "figures",
    "what forces and velocities are: 1 result, 2 best_iterate: no result, 3 lock: balance the live load, 0 none",
)


@dataclass(frozen=True)
class Column:
    """A quantity and its values in a scene.

    of    : values of every item, (n_items, ...); None where there are none. Whole numbers may be masked
    names : what tables say in the place of numbers, one for each
    files : what it stands in: ``table``, and VTU files by their kind
    """

    quantity: Quantity
    of: Callable[[Scene], Values | None]
    names: Callable[[Scene], Sequence[str]] | None = None
    files: tuple[str, ...] = ("table",)


def column(
    quantity: Quantity | str,
    of: Callable[[Scene], Values | None],
    files: str = "table",
    names: Callable[[Scene], Sequence[str]] | None = None,
) -> Column:
    """A column; what the result file holds is named by its path there."""
    return Column(STORED_BY_PATH[quantity] if isinstance(quantity, str) else quantity, of, names, tuple(files.split()))


def as_text(values: Sequence[str]) -> Values:
    """Text as an array of objects."""
    array = np.empty(len(values), dtype=object)
    array[:] = list(values)
    return array


def masked(values: Values) -> Values:
    """Whole numbers, without the -1 that stand for none."""
    return np.ma.masked_equal(values, -1)


def figures(size: Callable[[Scene], int]) -> Callable[[Scene], Values]:
    """Values of ``FIGURES_TOLD``."""
    return lambda scene: np.full(size(scene), FIGURES.index(scene.figures))
