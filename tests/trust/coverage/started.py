"""A test that only starts the command: what it covers, a child covered."""

from __future__ import annotations

import subprocess
import sys


def test_the_command_starts() -> None:
    subprocess.run([sys.executable, "-m", "mbla", "--help"], check=True, capture_output=True)
