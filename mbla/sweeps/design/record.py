"""A design as plain data, for JSON."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from mbla.sweeps.design.design import Design


def design_json(design: Design, points: bool = True) -> dict[str, Any]:
    """Parts, axes, columns and counts of a design; its points too unless they are in a table beside it.

    Keys are those of ``Design``, with ``points`` a list of number, position, values by column and settings by key path.
    """
    record: dict[str, Any] = {
        "parts": [asdict(part) for part in design.parts],
        "dimensions": [asdict(dimension) for dimension in design.dimensions],
        "columns": [asdict(column) for column in design.columns],
        "n_points": len(design.points),
        "left_out": design.left_out,
        "constraints": [{"text": text, "broken_by": count} for text, count in design.breaches],
        "samples": design.samples,
        "sampling": design.sampling,
        "remarks": list(design.remarks),
    }
    if points:
        names = [column.name for column in design.columns]
        record["points"] = [
            {
                "number": point.number,
                "position": list(point.position),
                "values": dict(zip(names, point.values, strict=True)),
                "settings": dict(point.settings),
            }
            for point in design.points
        ]
    return record
