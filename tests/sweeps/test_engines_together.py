"""One sweep by several engines: each gives the table of one process, and goes on with what another left."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.sweeps.commands import DASK_KILLED, Command, check_clean, nothing_left, rows_in, run
from tests.sweeps.engine.certificates import write_certificates
from tests.sweeps.engine.real_cluster import RealCluster, real_cluster
from tests.sweeps.killed_sweeps import written

pytestmark = pytest.mark.long

ONE, TWO, CLUSTER = "one", "two", "cluster"


@pytest.mark.parametrize("protocol", ["tcp", "tls"])
def test_a_cluster_of_two_workers(tmp_path: Path, protocol: str) -> None:
    path, folder, clean = written(tmp_path, 60), tmp_path / "cluster", tmp_path / "clean"
    files = write_certificates(tmp_path / "tls") if protocol == "tls" else {}
    names = {"ca": "ca-file", "cert": "cert", "key": "key"}
    keys = [part for kind, name in names.items() if files for part in (f"--tls-{name}", str(files[kind]))]
    with real_cluster(tmp_path, options=keys) as cluster:
        assert cluster.address.startswith(f"{protocol}://")
        assert run(path, folder, "--scheduler", cluster.address, *keys).status == 8
    assert run(path, clean).status == 8
    check_clean(folder, clean)


@pytest.mark.parametrize("engines", [(TWO, CLUSTER, ONE, TWO), (CLUSTER, TWO, ONE, CLUSTER)])
def test_one_goes_on_where_another_was_killed(tmp_path: Path, engines: Sequence[str]) -> None:
    path, folder, clean = written(tmp_path, 200), tmp_path / "killed", tmp_path / "clean"
    *killed, last = engines
    with nothing_left(tmp_path / "temporary", DASK_KILLED), real_cluster(tmp_path) as cluster:
        for engine in killed:
            with Command(path, folder, "--resume", *options_of(engine, cluster)) as command:
                command.await_rows(rows_in(folder) + 2)
        assert run(path, folder, "--resume", *options_of(last, cluster)).status == 8
    assert run(path, clean).status == 8
    check_clean(folder, clean)


def options_of(engine: str, cluster: RealCluster) -> tuple[str, str]:
    """Of the command line."""
    return {ONE: ("-j", "1"), TWO: ("-j", "2"), CLUSTER: ("--scheduler", cluster.address)}[engine]
