"""What may come of a batch that was handed to the workers, and what becomes of its points."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError, UsageError
from mbla.sweeps.plan import DONE, Outcome, record_of
from tests.sweeps.engine.scripted import Script, scripted_engine
from tests.sweeps.engine.test_connection import GONE, NO_WORKER
from tests.sweeps.small_plan import frictions, plan_over


def solved(*numbers: int) -> dict[str, Any]:
    """The answer of a worker that has solved some points."""
    outcomes = [Outcome(f"key{i}", DONE, 0, "", {"load_factor": i / 100}, 1, 0.1) for i in numbers]
    return {"outcomes": [record_of(outcome) for outcome in outcomes]}


def outcomes_of(monkeypatch: pytest.MonkeyPatch, folder: Path, script: Script, points: int = 1) -> list[Outcome]:
    with scripted_engine(monkeypatch, script) as engine:
        return list(engine.run(plan_over(folder), frictions(points)))


def test_points_that_a_worker_did_not_come_to_are_handed_over_again(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    script = Script(batches=[{"outcomes": []}, solved(1)])
    assert [outcome.key for outcome in outcomes_of(monkeypatch, tmp_path, script)] == ["key1"]
    assert script.asked == ["describe", "run_batch", "run_batch", "end_processes", "close"]


def test_the_answer_of_a_worker_that_has_just_gone_is_asked_for_again(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    script = Script(batches=[TimeoutError(), solved(1)])
    (outcome,) = outcomes_of(monkeypatch, tmp_path, script)
    assert (outcome.key, outcome.state, outcome.tries) == ("key1", DONE, 1)


@pytest.mark.parametrize(
    ("batch", "words"),
    [
        (
            {"outcomes": [], "refused": "its numpy is 1.0, here it is 2.0"},
            "a worker cannot solve points of this sweep: its numpy is 1.0, here it is 2.0",
        ),
        (KeyError("no\nkey"), r"a worker cannot solve points: KeyError: 'no\nkey'"),
        (MemoryError(), "a worker cannot solve points: MemoryError: "),
    ],
)
def test_a_worker_that_cannot_solve_points(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, batch: dict[str, Any] | BaseException, words: str
) -> None:
    with pytest.raises(UsageError) as caught:
        outcomes_of(monkeypatch, tmp_path, Script(batches=[batch]))
    assert str(caught.value) == words


def test_a_scheduler_that_is_gone_with_an_answer(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with pytest.raises(FileError) as caught:
        outcomes_of(monkeypatch, tmp_path, Script(batches=[ConnectionResetError()]))
    assert str(caught.value) == GONE


def test_a_scheduler_to_which_nothing_can_be_handed_over(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with pytest.raises(FileError) as caught:
        outcomes_of(monkeypatch, tmp_path, Script(batches=[ConnectionAbortedError()]))
    assert str(caught.value) == GONE


def test_batches_under_way_are_taken_back_where_a_run_is_given_up(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    script = Script(batches=[solved(1), solved(2), solved(3)])
    with scripted_engine(monkeypatch, script) as engine:
        begun = engine.run(plan_over(tmp_path), frictions(3))
        assert next(begun).key == "key1"
    assert script.asked == ["describe", "run_batch", "run_batch", "cancel 1", "end_processes", "close"]


def test_a_point_of_which_every_worker_dies_is_given_up(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    from distributed.scheduler import KilledWorker

    died = KilledWorker("points", None, 3)  # type: ignore[arg-type]
    (outcome,) = outcomes_of(monkeypatch, tmp_path, Script(batches=[died] * 5))
    assert outcome.state == "failed"
    assert outcome.reason == "its worker was ended, as was that of each try before; given up after 2 tries"


def test_workers_that_are_gone_for_too_long(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("mbla.sweeps.engine.cluster.LOOK", 0.02)
    script = Script(threads=(1, 0), batches=[None] * 2)
    with pytest.raises(UsageError) as caught:
        outcomes_of(monkeypatch, tmp_path, script)
    assert str(caught.value) == NO_WORKER
