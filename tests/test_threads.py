"""The command keeps the linear algebra libraries to the threads that it is given."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from mbla.threads import VARIABLES

ASK = """
import os, sys
from mbla.cli import main
assert "numpy" not in sys.modules
main(sys.argv[1:])
print("|", *(os.environ[name] for name in {names!r}))
"""


@pytest.mark.parametrize(
    ("arguments", "given", "expected"),
    [
        (["run", "missing.yaml"], {}, "1 1 1"),
        (["run", "missing.yaml", "--threads", "2"], {}, "2 2 2"),
        (["run", "missing.yaml", "--threads", "2"], {"OMP_NUM_THREADS": "3"}, "2 3 2"),
    ],
)
def test_one_thread_unless_more_are_asked_for(arguments: list[str], given: dict[str, str], expected: str) -> None:
    surroundings = {name: value for name, value in os.environ.items() if name not in VARIABLES} | given
    command = [sys.executable, "-c", ASK.format(names=VARIABLES), *arguments]
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=True)
    assert done.stdout.split("|")[-1].strip() == expected
