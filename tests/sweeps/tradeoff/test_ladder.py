"""Which rungs a ladder has, and what becomes of each, by a process made by hand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from mbla.deck import read_deck
from mbla.sweeps.measure.measuring import ChildRun
from mbla.sweeps.tradeoff import ladder_run
from mbla.sweeps.tradeoff.ladder import asked_ladder
from mbla.sweeps.tradeoff.ladder_run import Limits, run_ladder
from mbla.sweeps.tradeoff.rung import Rung
from tests.line import BLOCK
from tests.sweeps.tradeoff.hand_made import measured


@pytest.mark.parametrize(
    ("overrides", "added"),
    [
        ((), ()),
        (("analysis.friction_cone=polyhedral",), ("analysis.friction_cone=circular",)),
        (("analysis.friction_cone=polyhedral", "analysis.solver=highs"),
         ("analysis.friction_cone=circular", "analysis.solver=auto")),
    ],
)  # fmt: skip
def test_the_reference_has_the_true_friction_cone(
    tmp_path: Path, overrides: tuple[str, ...], added: tuple[str, ...]
) -> None:
    """And a solver that takes it."""
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    reference, draft = asked_ladder(read_deck(path, overrides), overrides, [Rung("accuracy: draft")])
    assert reference.name == "accuracy: reference"
    assert reference.setting.overrides == ("analysis.accuracy=reference", *added)
    assert draft == Rung("accuracy: draft")


class Answers:
    """In place of the process that measures: a load case is answered, then the run ends as it is told."""

    end = ChildRun((measured(0.5, 1.0),), "stopped")

    def __enter__(self) -> Answers:
        return self

    def __exit__(self, *what: object) -> None:
        return None

    def run(self, task: Any, until: Any, seconds: Any, report: Callable[[Any], None]) -> ChildRun:
        report(self.end.measurements[0])
        return self.end


@pytest.mark.parametrize(
    ("limits", "words", "expired"),
    [
        (Limits(each=2.5), "stopped after 2.5 s", False),
        (Limits(budget=600.0, each=2.5), "stopped after 2.5 s", False),
        (Limits(budget=1.0, each=2.5), "stopped at the end of the time limit", True),
    ],
)
def test_a_rung_that_was_stopped_says_by_which_limit(
    monkeypatch: pytest.MonkeyPatch, limits: Limits, words: str, expired: bool
) -> None:
    """The clock says 0, then 0.1 as the rung begins and 3 when it was stopped."""
    clock = iter([0.0, 0.1, 3.0])
    monkeypatch.setattr(ladder_run, "MeasuringProcess", Answers)
    monkeypatch.setattr("mbla.sweeps.tradeoff.ladder_run.time", SimpleNamespace(monotonic=lambda: next(clock)))
    told: list[tuple[int, int, str, str]] = []
    (run,) = run_ladder(Path("a.yaml"), (), ("push",), [Rung("accuracy: draft")], limits, lambda *at: told.append(at))
    assert (run.end, run.words, run.expired) == ("stopped", words, expired)
    assert [measurement.answer for measurement in run.measurements] == [0.5]
    assert told == [(1, 1, "accuracy: draft", ""), (1, 1, "accuracy: draft", "push")]


def test_without_a_listener_nothing_is_told_and_the_rest_is_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder_run, "MeasuringProcess", Answers)
    rungs = [Rung("accuracy: draft"), Rung("form: static", unfit="does not fit")]
    ends = [(run.end, run.words) for run in run_ladder(Path("a.yaml"), (), (), rungs, Limits(each=1.0), None)]
    assert ends == [("stopped", "stopped after 1 s"), ("unfit", "does not fit")]
