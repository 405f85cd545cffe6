"""What a scheduler and its workers may say when a sweep connects, and how it is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError, UsageError
from mbla.sweeps.engine import cluster
from mbla.sweeps.engine.on_worker import describe
from tests.sweeps.engine.certificates import write_certificates
from tests.sweeps.engine.scripted import ADDRESS, Script, scripted

NO_WORKER = (
    f"the scheduler {ADDRESS} has had no worker for 0.2 s: start some with `dask worker`; "
    "what was solved is in the journal, --resume continues from it"
)


def refusal(monkeypatch: pytest.MonkeyPatch, script: Script, **options: Any) -> str:
    """Words with which a connection is refused."""
    with pytest.raises((UsageError, FileError)) as caught, scripted(monkeypatch, script, **options):
        pass
    return str(caught.value)


def test_workers_that_are_as_here(monkeypatch: pytest.MonkeyPatch) -> None:
    script = Script(threads=(0, 0, 3))
    with scripted(monkeypatch, script):
        assert script.asked == ["describe"]
    assert script.asked == ["describe", "close"]


def test_a_scheduler_without_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    script = Script(threads=(0,))
    assert refusal(monkeypatch, script) == NO_WORKER
    assert script.asked == ["close"]


def test_certificates_are_handed_on(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    files, script = write_certificates(tmp_path), Script()
    tls = {"tls_ca_file": files["ca"], "tls_client_cert": files["cert"], "tls_client_key": files["key"]}
    with scripted(monkeypatch, script, scheduler="tls://host:8786", tls=tls):
        security = script.options["security"]
    assert script.options["address"] == "tls://host:8786"
    assert security.require_encryption
    assert security.tls_ca_file == str(files["ca"])
    assert (security.tls_client_cert, security.tls_client_key) == (str(files["cert"]), str(files["key"]))


def test_workers_that_differ(monkeypatch: pytest.MonkeyPatch) -> None:
    own = describe()
    workers = {
        "tcp://a": own | {"machine": "north", "program": "0.0.9+abc"},
        "tcp://b": ImportError("No module named\n'mbla.sweeps'"),
        "tcp://c": RuntimeError("no disk"),
        "tcp://d": OSError("connection closed"),
        "tcp://e": own,
        "tcp://f": own | {"machine": "south", "libraries": own["libraries"] | {"numpy": "1.0"}},
    }
    assert refusal(monkeypatch, Script(workers=workers)).splitlines() == [
        f"worker tcp://a on north: its mbla is 0.0.9+abc, here it is {own['program']}",
        "worker tcp://b: ImportError: No module named 'mbla.sweeps'",
        "worker tcp://c: RuntimeError: no disk",
        f"worker tcp://f on south: its numpy is 1.0, here it is {own['libraries']['numpy']}",
        "install the same versions in the workers' environment",
    ]


def test_a_worker_that_does_not_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    within = cluster.within

    def late(seconds: float, ask: Any) -> Any:
        if ask.__qualname__.startswith("Connection._check_workers"):
            raise TimeoutError
        return within(seconds, ask)

    monkeypatch.setattr(cluster, "within", late)
    assert refusal(monkeypatch, Script()) == (
        f"a worker of the scheduler {ADDRESS} does not answer within 30 s: restart it"
    )


@pytest.mark.parametrize("content", ["{}", "[", '"tcp://host"', ""])
def test_a_scheduler_file_that_is_none(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, content: str) -> None:
    path = tmp_path / "scheduler.json"
    path.write_text(content, encoding="utf-8")
    words = refusal(monkeypatch, Script(), scheduler="", scheduler_file=path)
    assert (
        words
        == f"--scheduler-file {path}: there is no file with an address; `dask scheduler --scheduler-file` writes it"
    )
