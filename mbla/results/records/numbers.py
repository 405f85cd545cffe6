"""Numbers as JSON allows them."""

from __future__ import annotations

import math
from collections.abc import Iterable


def number(value: float | None) -> float | None:
    """A finite number or None."""
    return None if value is None or not math.isfinite(value) else float(value)


def numbers(values: Iterable[float]) -> list[float | None]:
    """Several."""
    return [number(value) for value in values]
