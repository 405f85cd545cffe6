"""The process that solves points, alone: it ends with its parent, whatever it is doing."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

from mbla.studies.line_process import PACKAGES
from tests.studies.sweep.worker.test_supervised import wait_for
from tests.studies.test_measuring import runs

PARENT = """
import sys
from pathlib import Path
from mbla.studies.sweep.plan import Task
from mbla.studies.sweep.worker.supervised import SupervisedRunner
from tests.studies.sweep.small_plan import ROW, plan_over
runner = SupervisedRunner(plan_over(Path(sys.argv[1]), ROW))
runner.run(Task("small", 1, {}))
print(runner._process._process.pid, flush=True)
runner.run(Task("large", 2, {"parameters.n": 40}))
print("solved")
"""


def test_it_ends_in_the_middle_of_a_point_when_its_parent_is_killed(tmp_path: Path) -> None:
    command = (sys.executable, "-c", PARENT, str(tmp_path))
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=PACKAGES) as parent:
        assert parent.stdout is not None
        child = int(parent.stdout.readline())
        assert runs(child)
        parent.send_signal(signal.SIGKILL)
        assert parent.stdout.read() == ""  # the large point was not solved yet
    wait_for(lambda: not runs(child))
