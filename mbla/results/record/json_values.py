"""Values as JSON allows them, and a record as one line of it."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import fields
from enum import Enum
from typing import Any

import numpy as np


def number(value: float | None) -> float | None:
    """A finite number or None."""
    return None if value is None or not math.isfinite(value) else float(value)


def numbers(values: Iterable[float]) -> list[float | None]:
    """Several."""
    return [number(value) for value in values]


def as_json(value: Any) -> Any:
    """Any value: fields of dataclasses by their names, arrays and tuples as lists, numbers that are not finite None."""
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, float):
        return number(value)
    if isinstance(value, (np.ndarray, np.generic)):
        return as_json(value.tolist())
    if isinstance(value, Mapping):
        return {name: as_json(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [as_json(item) for item in value]
    if hasattr(value, "__dataclass_fields__"):
        return {field.name: as_json(getattr(value, field.name)) for field in fields(value)}
    return value


def json_line(record: dict[str, Any]) -> str:
    """One line of JSON, without newline; ValueError if a number in it is not finite."""
    return json.dumps(record, ensure_ascii=False, allow_nan=False, default=dict)
