"""Points in a process of their own: what its limits and its death come to in the outcome."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine.supervised import StoppedError, SupervisedRunner
from mbla.sweeps.plan import DONE, FAILED, Plan, PointOutcome, Task
from tests.sweeps.killed_sweeps import runs
from tests.sweeps.small_plan import ROW, frictions, plan_over

pytestmark = pytest.mark.long

TASK = Task("key", 1, {})
SAYS = (
    "import sys, os, time\n"
    "from dataclasses import replace\n"
    "from multiprocessing.connection import Connection\n"
    "from mbla.sweeps.plan import DONE, FAILED, PointOutcome\n"
    "pipe = Connection(int(sys.argv[1])); pipe.recv(); pipe.send('')\n"
    "for number in range(1, 99):\n"
    "    task = pipe.recv()\n"
    "    outcome = PointOutcome('key', DONE, 0, '', {'load_factor': 0.5}, 1, 0.1)\n"
)
"""the start of a process that speaks as the real one does"""


def runner_that(plan: Plan, code: str) -> SupervisedRunner:
    """With a process that runs ``code`` at each point, then answers with ``outcome``."""
    return SupervisedRunner(plan, (sys.executable, "-c", f"{SAYS}    {code}\n    pipe.send(outcome)\n"))


def children() -> list[int]:
    """Numbers of the processes that this one began."""
    tasks = Path("/proc/self/task")
    return [
        int(number) for path in tasks.glob("*/children") for number in path.read_text().split() if runs(int(number))
    ]


def wait_for(condition: Callable[[], object]) -> None:
    """At most half a minute: a test fails then rather than hanging."""
    for _ in range(3000):
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError("it never came")


def test_points_are_solved_and_faulty_ones_told(tmp_path: Path) -> None:
    faulty = Task("bad", 9, {"parameters.mu": -1.0})
    before = set(children())
    with closing(SupervisedRunner(plan_over(tmp_path, memory_limit=1e9, time_limit=60.0))) as runner:
        outcomes = [runner.run(task) for task in (*frictions(2), faulty, *frictions(1))]
        assert runner.started == 1
        assert set(children()) - before
    assert not set(children()) - before
    assert [outcome.results["load_factor"] for outcome in outcomes[:2]] == [pytest.approx(f) for f in (0.01, 0.02)]
    assert [outcome.state for outcome in outcomes] == [DONE, DONE, FAILED, DONE]
    assert outcomes[2].exit_code == 3
    assert outcomes[2].reason.endswith('friction = "=mu": must be >= 0; this is -1')
    assert outcomes[3].results == outcomes[0].results


def test_time_limit(tmp_path: Path) -> None:
    """A point without end is stopped; the next has a process of its own."""
    code = "task.number == 1 and time.sleep(60)"
    with closing(runner_that(plan_over(tmp_path, time_limit=0.5), code)) as runner:
        stopped, done = (runner.run(task) for task in frictions(2))
        assert runner.started == 2
    assert (stopped.state, stopped.exit_code, stopped.tries, stopped.results) == (FAILED, 7, 1, {})
    assert stopped.reason == "stopped at the limit of 0.5 s for a point"
    assert done.state == DONE


def test_memory_limit(tmp_path: Path) -> None:
    """Two megabytes above the base deck are enough for no wall of 400 blocks."""
    with closing(SupervisedRunner(plan_over(tmp_path, ROW, memory_limit=2e6))) as runner:
        outcome = runner.run(Task("key", 1, {"parameters.n": 20}))
    assert (outcome.state, outcome.exit_code) == (FAILED, 7)
    assert outcome.reason.startswith("more than the 2 MB of memory that a point may take")


@pytest.mark.parametrize("say", ["memory allocation of 8000000000 bytes failed", "std::bad_alloc"])
def test_a_library_that_aborts_under_the_memory_limit(tmp_path: Path, say: str) -> None:
    code = f"print({say!r}, file=sys.stderr, flush=True); os.abort()"
    with closing(runner_that(plan_over(tmp_path, memory_limit=1e8), code)) as runner:
        outcome = runner.run(TASK)
        assert runner.started == 1  # it was the first point of its process
    assert (outcome.exit_code, outcome.tries) == (7, 1)
    assert outcome.reason == ("more than the 100 MB of memory that a point may take (its process was ended by SIGABRT)")
    with closing(runner_that(plan_over(tmp_path), code)) as runner:
        unlimited = runner.run(TASK)
    assert (unlimited.exit_code, unlimited.tries) == (1, 2)


def test_memory_that_earlier_points_left_is_not_held_against_a_point(tmp_path: Path) -> None:
    code = "outcome = replace(outcome, state=FAILED, exit_code=7, reason='out of memory') if number > 1 else outcome"
    with closing(runner_that(plan_over(tmp_path, memory_limit=1e8), code)) as runner:
        outcomes = [runner.run(TASK) for _ in range(2)]
    assert [(outcome.state, outcome.tries) for outcome in outcomes] == [(DONE, 1), (DONE, 2)]


def test_killed_in_the_middle_of_a_point_it_is_solved_again(tmp_path: Path) -> None:
    before = set(children())
    found: list[PointOutcome] = []
    with closing(SupervisedRunner(plan_over(tmp_path, ROW))) as runner:
        runner.run(Task("small", 1, {}))
        (child,) = set(children()) - before
        thread = threading.Thread(target=lambda: found.append(runner.run(Task("large", 2, {"parameters.n": 20}))))
        thread.start()
        time.sleep(0.1)
        assert not found
        os.kill(child, signal.SIGKILL)
        thread.join()
        again = runner.run(Task("large", 2, {"parameters.n": 20}))
    assert (found[0].state, found[0].tries) == (DONE, 2)
    assert found[0].results == again.results  # to the last bit, in whatever process and after whatever points


def test_a_point_that_kills_its_process_is_given_up(tmp_path: Path) -> None:
    with closing(runner_that(plan_over(tmp_path), "os.kill(os.getpid(), 9)")) as runner:
        outcome = runner.run(TASK)
        assert runner.started == 2
    assert (outcome.state, outcome.exit_code, outcome.tries) == (FAILED, 1, 2)
    assert outcome.reason == (
        "its process was ended by SIGKILL, as the system does where memory runs out; given up after 2 tries"
    )


def test_one_that_refuses_the_plan(tmp_path: Path) -> None:
    code = SAYS.replace("send('')", "send('another deck')")
    with (
        closing(SupervisedRunner(plan_over(tmp_path), (sys.executable, "-c", code))) as runner,
        pytest.raises(UsageError, match=r"^another deck$"),
    ):
        runner.run(TASK)


def test_one_that_cannot_start_is_no_fault_of_the_point(tmp_path: Path) -> None:
    with (
        closing(
            SupervisedRunner(plan_over(tmp_path), (sys.executable, "-c", "import sys; sys.exit('no disk')"))
        ) as runner,
        pytest.raises(UsageError, match="cannot be started: its process ended with status 1: no disk"),
    ):
        runner.run(TASK)
    with (
        closing(SupervisedRunner(plan_over(tmp_path), (str(tmp_path / "none"),))) as runner,
        pytest.raises(UsageError, match=r"cannot be started: .*No such file"),
    ):
        runner.run(TASK)


def test_stopped_from_another_thread(tmp_path: Path) -> None:
    mark = tmp_path / "begun"
    with closing(runner_that(plan_over(tmp_path), f"open({str(mark)!r}, 'w'); time.sleep(60)")) as runner:

        def kill_when_begun() -> None:
            wait_for(mark.exists)
            runner.close()

        thread = threading.Thread(target=kill_when_begun)
        thread.start()
        with pytest.raises(StoppedError):
            runner.run(TASK)
        thread.join()
        assert runner.started == 1
