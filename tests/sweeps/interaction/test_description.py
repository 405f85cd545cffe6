"""Every key of the record of a diagram is described, and every description is of a key."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from mbla.results.records.json_record import json_line
from mbla.sweeps.interaction.description import INTERACT_RECORD
from mbla.sweeps.interaction.domain import Crossing
from mbla.sweeps.interaction.records import study_json
from tests.sweeps.interaction.hand_made import solved
from tests.sweeps.tables.test_description import TYPES


def paths(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every key path with its value; ``*`` for what provenance names."""
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, inside in value.items():
            name = "*" if path == "provenance" else key
            yield from paths(inside, f"{path}.{name}" if path else name)
    if isinstance(value, list):
        for item in value:
            yield from paths(item, f"{path}[]")


def test_keys_and_types_of_the_record(tmp_path: Path) -> None:
    """Of directions and of two loads; a safe point beyond a bound, which no sound answer has, is put in."""
    turned = solved(tmp_path, ["parameters.mu=0.3"], case="push", directions=3)
    both = solved(tmp_path, loads=("push", "top"), directions=2)
    assert both.domain is not None
    broken = replace(both, domain=replace(both.domain, crossings=(Crossing(0.0, 1.0, 1e-3),)))
    described = {key.path: key for key in INTERACT_RECORD}
    seen = set()
    for study in (turned, broken):
        for path, value in paths(json.loads(json_line(study_json(study, ("block_interact.csv",))))):
            assert path in described, path
            kind = described[path].kind
            assert (value is None and kind.endswith("?")) or isinstance(value, TYPES[kind.rstrip("?")]), path
            seen.add(path)
    assert seen == set(described)
