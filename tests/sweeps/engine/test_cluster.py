"""Points in processes of this machine and on workers of Dask: the same answers, and nothing left of what is stopped."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError, UsageError
from mbla.sweeps.engine.engine import EngineOptions, outcomes_of
from mbla.sweeps.engine.supervised import PACKAGES
from mbla.sweeps.plan import DONE, PointOutcome, Task
from tests.sweeps.engine.real_cluster import kill, real_cluster
from tests.sweeps.engine.test_supervised import children
from tests.sweeps.small_plan import ROW, frictions, plan_over

pytestmark = pytest.mark.long


def check_answers(outcomes: Iterable[PointOutcome], tasks: Iterable[Task]) -> None:
    """Each point once, with the load factor that is its friction."""
    listed = list(outcomes)
    found = {outcome.key: outcome for outcome in listed}
    assert len(found) == len(listed)
    assert set(found) == {task.key for task in tasks}
    for task in tasks:
        assert found[task.key].state == DONE, found[task.key].reason
        assert found[task.key].results["load_factor"] == pytest.approx(task.settings["parameters.mu"], rel=1e-5)


def test_two_workers_of_this_machine(tmp_path: Path) -> None:
    """Each point once; their processes are gone when the last is done, before the workers are."""
    before, tasks = set(children()), frictions(6)
    check_answers(outcomes_of(EngineOptions(workers=2), plan_over(tmp_path), tasks), tasks)
    assert not set(children()) - before


@pytest.mark.parametrize("workers", [1, 2])
def test_nothing_is_left_of_a_run_that_is_given_up(tmp_path: Path, workers: int) -> None:
    """In the middle of large points."""
    before = set(children())
    large = [Task(f"large{n}", n, {"parameters.n": 40}) for n in range(9)]
    begun = outcomes_of(EngineOptions(workers=workers), plan_over(tmp_path, ROW), (Task("small", 1, {}), *large))
    next(begun)
    assert 0 < len(set(children()) - before) <= workers
    begun.close()
    assert not set(children()) - before


def test_over_tcp(tmp_path: Path) -> None:
    tasks = frictions(40)
    with real_cluster(tmp_path) as cluster:
        check_answers(outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path), tasks), tasks)
        check_answers(outcomes_of(EngineOptions(scheduler_file=cluster.file), plan_over(tmp_path), tasks), tasks)


def test_a_worker_with_another_mbla_or_other_libraries(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    package = other / "mbla"
    shutil.copytree(PACKAGES / "mbla", package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "arrays.py").write_text((package / "arrays.py").read_text() + "\n# changed\n")
    fake = other / "clarabel-0.0.1.dist-info"
    fake.mkdir()
    (fake / "METADATA").write_text("Metadata-Version: 2.1\nName: clarabel\nVersion: 0.0.1\n")
    with real_cluster(tmp_path, 0) as cluster:
        cluster.start_worker(PYTHONPATH=str(other))
        expected = r"^worker on \S+: its clarabel is 0\.0\.1, here it is \S+; install the same versions"
        with pytest.raises(UsageError, match=expected):
            next(outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path), frictions(1)))
        shutil.rmtree(fake)
        kill(cluster.workers.pop())
        cluster.start_worker(PYTHONPATH=str(other))
        with pytest.raises(UsageError, match=r"^worker on \S+: its mbla is \S+, the sweep was planned by \S+"):
            next(outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path), frictions(1)))


def test_a_scheduler_that_goes(tmp_path: Path) -> None:
    with real_cluster(tmp_path, 1) as cluster:
        begun = outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path), frictions(40))
        assert next(begun).state == DONE
        assert cluster.scheduler is not None
        kill(cluster.scheduler)
        with pytest.raises(FileError, match=r"^the scheduler tcp://.* is gone; finished points are in the journal"):
            list(begun)


def test_no_scheduler_there(tmp_path: Path) -> None:
    def refused(words: str, **options: Any) -> None:
        with pytest.raises(UsageError, match=words):
            next(outcomes_of(EngineOptions(**options), plan_over(tmp_path), frictions(1)))

    gone = "tcp://127.0.0.1:9"
    refused(f"no connection to the scheduler {gone}", scheduler=gone, patience=0.5)
    words = r"none\.json: there is no file with an address; `dask scheduler --scheduler-file`"
    refused(words, scheduler_file=tmp_path / "none.json")
    with real_cluster(tmp_path, 0) as cluster:
        refused("has had no worker for 0.5 s: start some with `dask worker`", scheduler=cluster.address, patience=0.5)
