"""Every file of tests/invalid_sweeps/sweep_*.yaml is refused with exactly the messages that its last comments say."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.errors import DeckError
from mbla.sweeps.base import read_base
from mbla.sweeps.file.read import read_sweep
from tests.sweeps.file.sweeps import INVALID

MARK = "# expect: "


def test_there_are_enough() -> None:
    assert len(INVALID) >= 100


@pytest.mark.parametrize("path", INVALID, ids=lambda path: path.stem)
def test_messages(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    expected = [line.removeprefix(MARK) for line in lines if line.startswith(MARK)]
    with pytest.raises(DeckError) as caught:
        read_base(read_sweep(path))
    found = [fault.line().removeprefix(f"{path}:").removeprefix(f"{path.parent}/") for fault in caught.value.faults]
    assert found == expected
    assert expected, "a faulty sweep file says what is expected of it"
