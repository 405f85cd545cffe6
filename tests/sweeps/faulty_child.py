"""The process of points, in which some points do harm; started as the real one is, ``python -P .../faulty_child.py``.

Everything but that is the real process. By the number of the point: 2 kills it, 4 never ends, 6 takes a gigabyte.
"""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

KILLS, HANGS, TAKES = 2, 4, 6
GIGABYTE = 10**9
LOG = "MBLA_TEST_LOG"
"""variable that names a file in which the numbers of the points are written that were begun"""


def main() -> None:
    """As the real process."""
    from mbla.sweeps.engine import child
    from mbla.sweeps.engine.child import PointRunner
    from mbla.sweeps.plan import Plain, PointOutcome, Task

    class Faulty(PointRunner):
        def run(self, task: Task) -> PointOutcome:
            with Path(os.environ[LOG]).open("a", encoding="ascii") as log:
                log.write(f"{task.number}\n")
            if task.number == KILLS:
                os.kill(os.getpid(), signal.SIGKILL)
            while task.number == HANGS:
                time.sleep(60)
            return super().run(task)

        def _solve(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
            taken = bytearray(GIGABYTE) if task.number == TAKES else b""
            assert len(taken) in (0, GIGABYTE)
            return super()._solve(task)

    vars(child)["PointRunner"] = Faulty
    child.main()


if __name__ == "__main__":
    main()
    os._exit(0)
