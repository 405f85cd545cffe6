"""Which options of engines are refused."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine.engine import EngineOptions, check_options

TLS = "tls://host:8786"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (EngineOptions(workers=0), "-j 0: at least 1"),
        (EngineOptions(2, TLS), "-j is for processes of this machine; with a scheduler its workers are all used"),
        (EngineOptions(1, TLS, Path("f")), "--scheduler and --scheduler-file: one of them says where the scheduler is"),
        (
            EngineOptions(scheduler="host:8786"),
            "--scheduler host:8786: an address is tcp://HOST:PORT or tls://HOST:PORT",
        ),
    ],
)
def test_refused(options: EngineOptions, words: str) -> None:
    with pytest.raises(UsageError) as refused:
        check_options(options)
    assert str(refused.value) == words


def test_without_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    check_options(EngineOptions(workers=2))
    with pytest.raises(UsageError, match=r"an extra that is not installed: pip install 'mbla\[dask\]'$"):
        check_options(EngineOptions(scheduler="tcp://host:8786"))
