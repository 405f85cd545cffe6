"""Demands of the fragility of a sweep, from its record."""

from __future__ import annotations

import json
from pathlib import Path

from mbla.errors import FileError
from mbla.results.disk import file_errors
from mbla.sweeps.tables.read_table import JSON


def demands_of(folder: Path) -> dict[str, tuple[float, ...]]:
    """Demands on each result column by its name, ascending; none where the sweep asks for no fragility.

    Raises FileError where the record cannot be read or is none.
    """
    path = folder / JSON
    with file_errors(path):
        text = path.read_bytes()
    found: dict[str, set[float]] = {}
    try:
        for one in json.loads(text)["fragility"]:
            found.setdefault(str(one["result"]), set()).update(float(each["demand"]) for each in one["demands"])
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise FileError("sweep-table-damaged", f"{path}: its fragility cannot be read") from error
    return {name: tuple(sorted(demands)) for name, demands in found.items()}
