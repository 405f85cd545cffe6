"""Sweeps whose processes are killed at any moment end in the table of one that ran undisturbed."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from mbla.sweeps.engine.engine import EngineOptions
from tests.sweeps.commands import DASK_KILLED, nothing_left
from tests.sweeps.engine.certificates import write_certificates
from tests.sweeps.journal.forked import forked
from tests.sweeps.killed_sweeps import (
    Cluster,
    Scene,
    finish,
    keys_in_journals,
    scene,
    table_of,
    with_cluster_kills,
    with_kills,
    written,
)

pytestmark = pytest.mark.long

OF_EACH_KIND = 3
"""kills of client, scheduler, nanny, worker and points by each way to a cluster: 45, and 80 without one"""


def check_like_clean(killed: Scene, clean: Scene, reported: set[str]) -> None:
    """The same table, no row lost that was reported, and no point solved again whose row was there."""
    assert reported <= set(keys_in_journals(killed.folder))
    assert finish(killed) == finish(clean) == "exit 8"
    keys = keys_in_journals(killed.folder)
    assert sorted(keys) == sorted(task.key for task in killed.prepared.tasks)
    assert table_of(killed.folder) == table_of(clean.folder)
    assert not [path for path in killed.folder.iterdir() if path.name.startswith(".")]


def test_client_and_process_killed_a_few_times(tmp_path: Path) -> None:
    path = written(tmp_path, 12)
    killed, clean = scene(path, tmp_path / "killed"), scene(path, tmp_path / "clean")
    kills, reported = with_kills(killed, 2, Random(1), 0.1, 0.5)
    assert kills == 2
    check_like_clean(killed, clean, reported)


def test_kills_of_client_and_process(tmp_path: Path) -> None:
    path = written(tmp_path, 500)  # so many that no fast machine is done before the last kill
    killed, clean = scene(path, tmp_path / "killed"), scene(path, tmp_path / "clean")
    kills, reported = with_kills(killed, 20, Random(2), 2.5, 0.6)
    assert kills == 20
    check_like_clean(killed, clean, reported)


def test_kills_with_two_workers(tmp_path: Path) -> None:
    path = written(tmp_path, 500)
    killed = scene(path, tmp_path / "killed", EngineOptions(workers=2))
    kills, reported = with_kills(killed, 10, Random(3), 3.0, 0.5)
    assert kills == 10
    check_like_clean(killed, scene(path, tmp_path / "clean"), reported)


@pytest.mark.parametrize("way", ["file", "tcp", "tls"])
def test_kills_in_a_cluster(tmp_path: Path, way: str) -> None:
    """Scheduler, nannies, workers, processes of points, client: whichever is hit."""
    path = written(tmp_path, 300)
    clean = scene(path, tmp_path / "clean")
    tls = write_certificates(tmp_path / "tls") if way == "tls" else None
    with nothing_left(tmp_path / "temporary", DASK_KILLED), Cluster(tmp_path, 2, tls) as cluster:
        killed = scene(path, tmp_path / "killed", engine_of(cluster, way, tls))
        assert with_cluster_kills(killed, cluster, OF_EACH_KIND, Random(way), 3.0) == 15
        with forked(killed.goes_on()) as client:  # to its end, by the cluster
            assert client.lines()[-1] == "finished 8"
    check_like_clean(killed, clean, set())


def engine_of(cluster: Cluster, way: str, tls: dict[str, Path] | None) -> EngineOptions:
    """How its scheduler is named."""
    if way == "file":
        return EngineOptions(scheduler_file=cluster.file)
    files = {} if tls is None else {"tls_ca_file": tls["ca"], "tls_cert": tls["cert"], "tls_key": tls["key"]}
    return EngineOptions(scheduler=cluster.address, **files)  # type: ignore[arg-type]
