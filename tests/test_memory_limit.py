"""Limits on memory that leave no room for the libraries are refused before these are loaded."""

from __future__ import annotations

import subprocess
import sys

import pytest

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
