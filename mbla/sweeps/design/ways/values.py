"""A list of values: numbers, texts, truth values, or lists as the deck takes them; drawn, each equally often."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.way import Filled, Form, Vector, Way, register
from mbla.sweeps.plan import Plain


def kind_of(values: Sequence[Plain]) -> str:
    """Kind of the column: that of all values, ``float`` for whole and broken numbers together, else ``text``."""
    if all(isinstance(value, bool) for value in values):
        return "bool"
    if any(isinstance(value, bool) or not isinstance(value, (int, float)) for value in values):
        return "text"
    return "int" if all(isinstance(value, int) for value in values) else "float"


def _shown(value: Plain, kind: str) -> Plain:
    """A value as its column holds it; what is no text, in a column of text, as JSON."""
    if kind == "float" and isinstance(value, (int, float)):
        return float(value)
    return value if kind != "text" or isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _levels(section: Sequence[Plain], vector: Vector | None) -> Filled:
    kind = kind_of(section)
    return Filled(([_shown(value, kind) for value in section],), list(section))


def _at(section: Sequence[Plain], u: FloatArray, vector: Vector | None) -> Filled:
    levels = _levels(section, vector)
    picked = np.floor(u[:, 0] * len(section)).astype(int).tolist()
    return Filled(([levels.columns[0][i] for i in picked],), [levels.settings[i] for i in picked])


register("values", Way(_levels, _at, random=False, forms=lambda section: (Form(kind_of(section)),)))
