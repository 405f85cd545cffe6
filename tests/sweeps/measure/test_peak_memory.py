"""What a process holds and has held, as the system tells it, and what is said where it tells nothing."""

from __future__ import annotations

import math
import resource
import sys
from pathlib import Path

import pytest

from mbla.sweeps.measure import peak_memory

MEGABYTE = 1024.0**2


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system tells no peak")
def test_the_peak_is_that_since_it_was_forgotten() -> None:
    held = bytearray(64 * 2**20)
    before = peak_memory.peak()
    assert before >= peak_memory.resident() >= len(held)
    del held
    peak_memory.forget_peak()
    assert peak_memory.peak() < before - 32 * MEGABYTE
    assert 0 < peak_memory.of_files() < peak_memory.resident()


def test_where_the_system_tells_no_more_it_is_the_peak_of_the_usage(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(peak_memory, "SELF", tmp_path / "none")
    monkeypatch.setattr(sys, "platform", "linux")
    peak_memory.forget_peak()
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert peak_memory.resident() >= 1024.0 * kilobytes
    assert peak_memory.of_files() == 0.0
    monkeypatch.setattr(sys, "platform", "darwin")
    assert kilobytes <= peak_memory.peak() < 1024.0 * kilobytes


def test_where_the_system_tells_nothing_there_is_no_figure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peak_memory, "SELF", tmp_path / "none")
    monkeypatch.setitem(sys.modules, "resource", None)
    assert math.isnan(peak_memory.resident())
    assert math.isnan(peak_memory.peak())
