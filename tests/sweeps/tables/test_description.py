"""Every key of the record of a sweep is described, and every description is of a key."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from mbla.errors import Notice
from mbla.results.record.json_values import json_line
from mbla.sweeps.fragility import fragility_json, fragility_of
from mbla.sweeps.tables.sweep_json import SWEEP_RECORD, SweepRun, sweep_json
from tests.sweeps.tables.synthetic import RUN, table

TYPES: dict[str, Any] = {
    "string": str,
    "number": float,
    "integer": int,
    "boolean": bool,
    "object": dict,
    "list": list,
    "any": object,
}


def paths(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every key path with its value; ``*`` where names are those of parameters."""
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, inside in value.items():
            name = "*" if path.endswith(".at") else key
            yield from paths(inside, f"{path}.{name}" if path else name)
    if isinstance(value, list):
        for item in value:
            yield from paths(item, f"{path}[]")


def test_keys_and_types_of_the_record() -> None:
    full = table()
    found = fragility_json(fragility_of(full, "load_factor", (0.2, 0.4), 0.95))
    run = SweepRun(**{**vars(RUN), "notices": (Notice("warning", "some", "words"),)})
    record = json.loads(json_line(sweep_json(run, full, found, ("sweep.csv",))))
    described = {key.path: key for key in SWEEP_RECORD}
    seen = set()
    for path, value in paths(record):
        assert path in described, path
        kind = described[path].kind
        assert (value is None and kind.endswith("?")) or isinstance(value, TYPES[kind.rstrip("?")]), path
        seen.add(path)
    assert seen == set(described)
