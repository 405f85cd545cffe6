"""Limits on memory that leave no room for the libraries are refused before these are loaded."""

from __future__ import annotations

import resource
import subprocess
import sys

import pytest

from mbla.errors import LimitError
from mbla.process.memory_limit import MIB, can_limit, limited, refuse_too_low_limits

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux")


@pytest.mark.parametrize(
    ("limit", "mib", "words", "least"),
    [
        ("RLIMIT_AS", 100, "address space (ulimit -v)", 400),
        ("RLIMIT_AS", 200, "address space (ulimit -v)", 400),
        ("RLIMIT_DATA", 100, "data (ulimit -d)", 256),
    ],
)
def test_a_limit_that_is_too_low(limit: str, mib: int, words: str, least: int) -> None:
    program = (
        f"import resource, sys; resource.setrlimit(resource.{limit}, ({mib << 20}, {mib << 20})); "
        "from mbla.cli import main; sys.exit(main(['run', 'none.yaml']))"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 7
    assert ended.stderr == (
        f"mbla: out of memory: the limit of {mib} MiB on {words} is below the {least} MiB that the program itself "
        "takes; raise the limit  [out-of-memory]\n"
    )


def test_without_a_limit_there_is_none_in_the_block() -> None:
    before = resource.getrlimit(resource.RLIMIT_DATA)
    with limited(None):
        assert resource.getrlimit(resource.RLIMIT_DATA) == before
    with limited(1e12):
        assert resource.getrlimit(resource.RLIMIT_DATA)[0] == 10**12
    assert resource.getrlimit(resource.RLIMIT_DATA) == before


def test_limits_of_other_systems_are_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resource, "getrlimit", lambda _: (MIB, MIB))
    with pytest.raises(LimitError, match="the limit of 1 MiB on address space"):
        refuse_too_low_limits()
    monkeypatch.setattr(sys, "platform", "win32")
    refuse_too_low_limits()
    assert not can_limit()
