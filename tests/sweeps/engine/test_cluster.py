"""Points on workers of Dask: the same answers, and what becomes of them where something is killed."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from distributed import Client

from mbla.errors import FileError, UsageError
from mbla.sweeps.engine.engine import EngineOptions, outcomes_of
from mbla.sweeps.engine.supervised import PACKAGES
from mbla.sweeps.plan import DONE, Outcome, Task
from tests.sweeps.engine.certificates import write_certificates
from tests.sweeps.engine.real_cluster import kill, real_cluster
from tests.sweeps.engine.test_supervised import children, wait_for
from tests.sweeps.small_plan import ROW, frictions, plan_over

pytestmark = pytest.mark.long

WALLS = tuple(Task(f"key{i}", i, {"parameters.n": 7, "parameters.mu": i / 50}) for i in range(1, 25))
"""points that take some tenths of a second each"""


def check_answers(outcomes: Iterable[Outcome], tasks: Iterable[Task]) -> None:
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


def tls(files: Mapping[str, Path]) -> dict[str, Path]:
    return {"tls_ca_file": files["ca"], "tls_client_cert": files["cert"], "tls_client_key": files["key"]}


def test_over_tls(tmp_path: Path) -> None:
    tasks, files = frictions(20), write_certificates(tmp_path / "tls")
    options = [f"--tls-{name}={files[kind]}" for name, kind in (("ca-file", "ca"), ("cert", "cert"), ("key", "key"))]
    with real_cluster(tmp_path, options=options) as cluster:
        assert cluster.address.startswith("tls://")
        plain = EngineOptions(scheduler=cluster.address, patience=3.0)
        fit = replace(plain, tls=tls(files))
        check_answers(outcomes_of(fit, plan_over(tmp_path), tasks), tasks)
        other = write_certificates(tmp_path / "other", "another authority")
        strange = replace(plain, tls=tls(other))
        for wrong in (strange, plain):
            with pytest.raises(UsageError, match=r"no connection to the scheduler tls://.*--tls-ca-file"):
                next(outcomes_of(wrong, plan_over(tmp_path), tasks))


def test_workers_killed_in_the_middle(tmp_path: Path) -> None:
    """One of two workers is killed with its process of points, then another that came in its place."""
    with real_cluster(tmp_path) as cluster:
        found = []
        for outcome in outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path, ROW), WALLS):
            found.append(outcome)
            if len(found) in (3, 12):
                kill(cluster.workers[-1])
                cluster.start_worker()
    check_answers(found, WALLS)


def test_scheduler_killed_in_the_middle(tmp_path: Path) -> None:
    with real_cluster(tmp_path) as cluster:
        begun = outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path, ROW), WALLS)
        found = [next(begun)]
        assert cluster.scheduler is not None
        kill(cluster.scheduler)
        with pytest.raises(FileError, match=r"^the scheduler tcp://.* is gone; finished points are in the journal"):
            found.extend(begun)
    assert 0 < len(found) < len(WALLS)
    assert all(outcome.state == DONE for outcome in found)


def test_all_workers_gone(tmp_path: Path) -> None:
    with real_cluster(tmp_path, 1) as cluster:
        options = EngineOptions(scheduler=cluster.address, patience=2.0)
        begun = outcomes_of(options, plan_over(tmp_path, ROW), WALLS)
        assert next(begun).state == DONE
        kill(cluster.workers[0])
        with pytest.raises(UsageError, match=r"has had no worker for 2 s: start some with `dask worker`"):
            list(begun)
        with pytest.raises(UsageError, match="has had no worker for 2 s"):
            next(outcomes_of(options, plan_over(tmp_path, ROW), WALLS))


def test_a_point_of_which_workers_die(tmp_path: Path) -> None:
    """The worker is killed whenever it has begun the one slow point; that point alone is given up."""
    slow = Task("slow", 9, {"parameters.n": 30})
    quick = tuple(Task(f"key{i}", i, {"parameters.n": 1, "parameters.mu": i / 50}) for i in range(1, 9))
    with real_cluster(tmp_path, 1) as cluster:
        done = outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path, ROW), (*quick, slow))
        check_answers([next(done) for _ in quick], quick)
        over = threading.Event()

        def kill_again() -> None:
            while not over.wait(1.0):
                kill(cluster.workers[-1])
                cluster.start_worker()
                wait_for(lambda: over.is_set() or points_in(cluster.workers[-1].pid))

        thread = threading.Thread(target=kill_again)
        thread.start()
        try:
            outcome = next(done)
        finally:
            over.set()
            thread.join()
    assert (outcome.key, outcome.state, outcome.exit_code) == ("slow", "failed", 1)
    assert outcome.reason == "its worker was ended, as was that of each try before; given up"


def points_in(worker: int) -> bool:
    """Whether a worker has begun a process for its points."""
    return any(path.read_text().split() for path in Path(f"/proc/{worker}/task").glob("*/children"))


def test_a_worker_with_another_mbla_or_other_libraries(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    package = other / "mbla"
    shutil.copytree(PACKAGES / "mbla", package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "arrays.py").write_text((package / "arrays.py").read_text() + "\n# changed\n")
    fake = other / "clarabel-0.0.1.dist-info"
    fake.mkdir()
    (fake / "METADATA").write_text("Metadata-Version: 2.1\nName: clarabel\nVersion: 0.0.1\n")
    with real_cluster(tmp_path, 1) as cluster:
        cluster.start_worker(PYTHONPATH=str(other))
        with Client(cluster.address, set_as_default=False) as client:  # type: ignore[no-untyped-call]
            client.wait_for_workers(2, timeout=30)
        expected = r"^worker tcp://\S+ on \S+: its mbla is \S+, here it is \S+, its clarabel is 0\.0\.1, here it is"
        with pytest.raises(UsageError, match=expected):
            next(outcomes_of(EngineOptions(scheduler=cluster.address), plan_over(tmp_path), frictions(1)))


def test_no_scheduler_there(tmp_path: Path) -> None:
    def refused(words: str, **options: Any) -> None:
        with pytest.raises(UsageError, match=words):
            next(outcomes_of(EngineOptions(**options), plan_over(tmp_path), frictions(1)))

    gone = "tcp://127.0.0.1:9"
    refused(f"no connection to the scheduler {gone}", scheduler=gone, patience=0.5)
    words = r"none\.json: there is no file with an address; `dask scheduler --scheduler-file`"
    refused(words, scheduler_file=tmp_path / "none.json", patience=0.1)
