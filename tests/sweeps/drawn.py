"""What a figure of matplotlib shows, for tests of pictures of studies."""

from __future__ import annotations

from typing import Any


def names_in_legend(figure: Any) -> list[str]:
    """What the legend below the diagrams names."""
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def places(line: Any) -> list[tuple[float, float]]:
    """Where a line or its marks are, in the units of the axes."""
    return [(float(x), float(y)) for x, y in zip(*line.get_data(), strict=True)]
