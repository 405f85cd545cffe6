"""Travelling loads in the JSON record."""

from __future__ import annotations

from typing import Any

from mbla.model.model import Model
from mbla.results.records.numbers import number, numbers
from mbla.results.results import CaseResult
from mbla.results.series import Series, factor_of, position_of


def series_json(model: Model, series: Series) -> dict[str, Any]:
    """Load factor and status at every position, null where there is none; the worst, null where it is not known."""
    return {
        "name": series.name,
        "complete": series.complete,
        "positions": [_position(model, case) for case in series.cases],
        "worst": None if series.worst is None else _position(model, series.worst),
    }


def _block(model: Model, block: int) -> str | None:
    return model.blocks.name(int(block)) if block >= 0 else None


def _position(model: Model, case: CaseResult) -> dict[str, Any]:
    position = position_of(case)
    return {
        "case": case.load_case.name,
        "position": position.number,
        "point": numbers(position.point),
        "distance": number(position.distance),
        "block": _block(model, position.blocks[0]),
        "axles": [
            {"point": numbers(point), "distance": number(distance), "block": _block(model, block)}
            for point, distance, block in zip(position.points, position.distances, position.blocks, strict=True)
        ],
        "status": case.status.value,
        "load_factor": number(factor_of(case)),
    }
