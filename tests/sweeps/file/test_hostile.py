"""Whatever stands in a sweep file, what comes is a design or faults in lines that can be read, never anything else."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.errors import DeckError
from mbla.sweeps.base import read_base
from mbla.sweeps.design.build import design_of
from mbla.sweeps.file.read import read_sweep
from mbla.sweeps.identity import PointKeys
from tests.deck.decks import write
from tests.sweeps.file.sweeps import ALL_WAYS, ARCH

LONGEST = 700
"""characters of a fault; the longest list all that is allowed"""
ODD: list[Any] = [
    *(0, -1, 1, 1e300, -1e-300, 3.5, True, False, 10**30),
    *("", "x", "=1", "=", ".", "..", "a.b", "key=1", "1 m", "a\u2028b", "é", "a" * 5000),
    *("parameters", "parameters.", "mu", "blocks", "blocks.0", "blocks.-1.arch", "blocks.0.arch.points", "supports"),
    *("analysis", "load_cases.push_x.live.0", "load_cases.push_x.live.0.acceleration", "contacts.overrides.0"),
    *([], [[]], {}, {"a": 1}, [1, 2, 3], ["mu"], ["mu", "t"]),
]


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Paths of all values but the whole."""
    below = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, each in below:
        yield (*path, key)
        yield from places(each, (*path, key))


def mutated(number: int) -> dict[str, Any]:
    """A sweep file with one or two values replaced, dropped or renamed."""
    choose = random.Random(number)
    content: dict[str, Any] = json.loads(json.dumps(read_yaml(SourceText("sweep", ALL_WAYS), 0).data))
    for _ in range(choose.choice((1, 1, 2))):
        *path, key = choose.choice(list(places(content)))
        holder: Any = content
        for each in path:
            holder = holder[each]
        kind = choose.random()
        if kind < 0.6:
            holder[key] = choose.choice(ODD)
        elif kind < 0.8:
            del holder[key]
        elif isinstance(holder, dict):
            holder[str(choose.choice(ODD))] = holder.pop(key)
    return content


@pytest.mark.parametrize("hundred", range(2))
def test_short(tmp_path: Path, hundred: int) -> None:
    refused = sum(is_refused(tmp_path, number) for number in range(20 * hundred, 20 * hundred + 20))
    assert 5 < refused < 20  # most changes are faults, not all


@pytest.mark.long
def test_long(tmp_path: Path) -> None:
    assert sum(is_refused(tmp_path, number) for number in range(1000, 3000)) > 1000


def is_refused(folder: Path, number: int) -> bool:
    write(folder, ARCH)
    path = write(folder, json.dumps(mutated(number)), "sweep.yaml")
    try:
        base = read_base(read_sweep(path))
        design = design_of(base.sources)
    except DeckError as error:
        lines = [str(fault) for fault in error.faults]
        assert lines
        for line in lines:
            assert line.startswith(str(folder)), line
            assert len(line.removeprefix(str(folder))) < LONGEST, line
            assert "\n" not in line
        return True
    assert len(PointKeys(base.fingerprint, base.deck).of(design.points[0].settings)) == 64
    return False
