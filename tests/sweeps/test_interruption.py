"""A sweep that is told to stop does so at once, keeps what it has, leaves nothing behind, and says how to go on."""

from __future__ import annotations

import re
import signal
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.sweeps.commands import DASK_LOCKS, Command, check_clean, nothing_left, rows_in, run
from tests.sweeps.engine.real_cluster import real_cluster
from tests.sweeps.killed_sweeps import written

pytestmark = pytest.mark.long

STATUS = {signal.SIGINT: (130, "interrupted"), signal.SIGTERM: (143, "terminated")}


def interrupt(path: Path, number: signal.Signals, options: Sequence[str] = ()) -> Path:
    """In the middle of a sweep; the folder of its files."""
    folder = path.with_name("interrupted")
    status, word = STATUS[number]
    with nothing_left(path.with_name("temporary"), DASK_LOCKS):
        with Command(path, folder, *options) as command:
            command.await_rows(3)
            ended = command.end(number)
        assert ended.status == status
        said = re.search(
            rf"^mbla: {word}; (\d+) finished points? in the journal, --resume continues  \[exit-{status}\]$",
            ended.said,
            re.M,
        )
        assert said, ended.said
        assert rows_in(folder) - int(said[1]) in (0, 1)  # it may come between writing a row and counting it
        assert [each.name for each in folder.iterdir()] == ["journal.csv"]
    return folder


def check_goes_on(path: Path, folder: Path, options: Sequence[str] = ()) -> None:
    """To the table of a sweep that was not interrupted."""
    clean = path.with_name("clean")
    assert run(path, folder, "--resume", *options).status == run(path, clean).status == 8
    check_clean(folder, clean)


def test_interrupt_from_the_keyboard(tmp_path: Path) -> None:
    interrupt(written(tmp_path, 200), signal.SIGINT)


@pytest.mark.parametrize("number", STATUS)
@pytest.mark.parametrize("options", [("-j", "1"), ("-j", "2")])
def test_signals(tmp_path: Path, number: signal.Signals, options: Sequence[str]) -> None:
    path = written(tmp_path, 200)
    check_goes_on(path, interrupt(path, number, options), options)


@pytest.mark.parametrize("number", STATUS)
def test_signals_to_the_client_of_a_cluster(tmp_path: Path, number: signal.Signals) -> None:
    """Its workers go on without it, the processes of their points do not."""
    with real_cluster(tmp_path) as cluster:
        path, options = written(tmp_path, 200), ("--scheduler", cluster.address)
        check_goes_on(path, interrupt(path, number, options), options)


@pytest.mark.parametrize("workers", ["1", "2"])
def test_interrupted_twice(tmp_path: Path, workers: str) -> None:
    """Somebody who does not want to wait: the second one meets the first one's end."""
    path, folder = written(tmp_path, 200), tmp_path / "interrupted"
    with nothing_left(tmp_path / "temporary", DASK_LOCKS):
        with Command(path, folder, "-j", workers) as command:
            command.await_rows(3)
            command.process.send_signal(signal.SIGINT)
            ended = command.end(signal.SIGINT)
        assert ended.status in (130, -signal.SIGINT)
    check_goes_on(path, folder)
