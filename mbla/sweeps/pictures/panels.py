"""Small multiples: one diagram for each value of a parameter, side by side and one above the other."""

from __future__ import annotations

import math
from typing import Any

from mbla.sweeps.pictures.axes import Axis

MOST_PANELS = 16
"""diagrams on a page in which anything can be read"""


def panel_places(count: int, sheet: Any) -> tuple[int, int]:
    """Rows and columns of diagrams that are about half as wide again as high, no row empty."""
    width, height = sheet.page.options.size
    columns = min(count, max(1, round(math.sqrt(count * width / (1.5 * height * max(sheet.top - sheet.bottom, 0.2))))))
    rows = -(-count // columns)
    return rows, -(-count // rows)


def panel_title(axis: Axis | None, number: int) -> str:
    """``thickness 0.3 m``."""
    if axis is None:
        return ""
    unit = f" {axis.column.unit}" if axis.column.unit else ""
    return f"{axis.column.name} {axis.names[number]}{unit}"
