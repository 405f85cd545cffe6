"""Decks, points and diagrams made by hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from mbla.deck import Deck, read_deck
from mbla.model import build_model
from mbla.process.run_options import RunOptions
from mbla.sweeps.command import Prepared
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.interaction.domain import Domain, RayPoints, domain_of, points_of
from mbla.sweeps.interaction.question import DIRECTION, InteractionQuestion, question_of
from mbla.sweeps.interaction.study import prepared_diagram, study_result_of
from mbla.sweeps.plan import PointOutcome
from mbla.sweeps.tables.sweep_table import SweepTable, sweep_table
from mbla.sweeps.tables.write_tables import StudyResult
from tests.line import HEAD

BLOCK = (
    HEAD
    + """\
parameters: {mu: 0.9, bx: 1, by: 1, h: 2, W: "=2000*9.81*bx*by*h"}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=bx", "=by", "=h"]}
supports: [{ground: {z: 0}}]
loads: {quake: [{acceleration: [0, -2, 0]}]}
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  top: {live: [{force: ["=W", 0, 0], on: block, at: ["=bx/2", "=by/2", "=h"]}]}
  named: {live: [{loads: quake, factor: -0.5}]}
  down: {live: [{force: [0, 0, -1], on: block}]}
  slanted: {live: [{acceleration: [1, 0, -0.5]}]}
  apart: {live: [{acceleration: [1, 0, 0]}, {force: [0, "=W", 0], on: block}]}
  weighed: {dead: [{gravity: [0, 0, -5]}], live: [{acceleration: [1, 0, 0]}]}
  twist: {live: [{acceleration: [1, 0, 0]}, {moment: [0, 0, 1], on: block}]}
  tilted: {live: [{tilt: {axis: [0, 1, 0]}}]}
analysis: {flow_rule: associative}
"""
)
"""A block on the ground under loads of many kinds."""


@dataclass(frozen=True)
class Diagram:
    """A diagram and what follows from it."""

    deck: Deck
    question: InteractionQuestion
    table: SweepTable

    @property
    def points(self) -> RayPoints:
        """Its points."""
        return points_of(self.table, self.question)

    @property
    def domain(self) -> Domain:
        """Its safe domain."""
        found = domain_of(self.points, self.question)
        assert found is not None
        return found

    @property
    def study(self) -> StudyResult:
        """What is told of it."""
        return study_result_of(self.deck, self.question, self.table)

    @property
    def words(self) -> str:
        """All that the terminal shows."""
        return " ".join(" ".join(self.study.lines).split())


def written(folder: Path) -> Path:
    """The deck of the block as a file."""
    path = folder / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    return path


def question(folder: Path, overrides: Sequence[str] = (), **asked: Any) -> InteractionQuestion:
    """What is asked of the block."""
    return question_of(read_deck(written(folder), overrides), options(**asked))


def options(**asked: Any) -> Any:
    """As of the command line."""
    return SimpleNamespace(**dict.fromkeys(("case", "loads", "directions", "start", "end")) | asked)


def solved(folder: Path, overrides: Sequence[str] = (), **asked: Any) -> Diagram:
    """The diagram of the block, its points solved in this process, the last first: the order must not matter."""
    deck = read_deck(written(folder), overrides)
    wanted = question_of(deck, options(**asked))
    prepared = prepared_diagram(deck, RunOptions(overrides=tuple(overrides)), wanted, folder)
    runner = PointRunner(prepared.plan)
    outcomes = {task.key: runner.run(task) for task in reversed(prepared.tasks)}
    return Diagram(deck, wanted, _table(prepared, outcomes))


def _table(prepared: Prepared, outcomes: Mapping[str, PointOutcome]) -> SweepTable:
    return sweep_table(prepared.title, prepared.design, prepared.columns, outcomes, prepared.keys)


def live_load(folder: Path, settings: Sequence[str], case: str) -> Any:
    """Live load of the block under a case, (6,), and its dead load."""
    model = build_model(read_deck(written(folder), settings))
    (found,) = [one for one in model.load_cases if one.name == case]
    return found.live_load[0], found.dead_load[0]


BOUNDS = ("static_bound", "kinematic_bound")
FIGURES = ("load_factor", "associative_load_factor", *BOUNDS)


def made(
    folder: Path, kind: str, factors: Sequence[float], changes: Mapping[int, Mapping[str, Any]] | None = None
) -> Diagram:
    """Verified points whose mechanisms bound the domain across their rays.

    factors : of points evenly around, or evenly over a quarter
    changes : by the number of a point, results of it that are others, or ``state``, ``exit_code`` and ``reason``
    """
    deck = read_deck(written(folder))
    asked = {"case": "push"} if kind == DIRECTION else {"loads": ("push", "top")}
    wanted = question_of(deck, options(directions=len(factors), **asked))
    prepared = prepared_diagram(deck, RunOptions(), wanted, folder)
    outcomes = {}
    results: dict[str, Any]
    for number, (factor, angle, key) in enumerate(zip(factors, wanted.angles, prepared.keys, strict=True)):
        powers = dict(zip((f"powers.{name}" for name in wanted.pair), horizontal(angle, 1.0), strict=True))
        results = {**dict.fromkeys(FIGURES, factor), **powers, "status": "solved", "verified": True}
        results |= {"standing.verdict": "yes", "mechanism.class": "sliding"} | dict((changes or {}).get(number, {}))
        state, code, reason = results.pop("state", "done"), results.pop("exit_code", 0), results.pop("reason", "")
        outcomes[key] = PointOutcome(key, str(state), int(code), str(reason), results, 1, 0.1)
    return Diagram(deck, wanted, _table(prepared, outcomes))


def both_bounds(value: float) -> dict[str, float]:
    """Bounds that are another value."""
    return dict.fromkeys(BOUNDS, value)


def area_of_circle(count: int, radius: float) -> tuple[float, float]:
    """Area of the polygons with so many corners in a circle and around it."""
    turn = np.pi / count
    return count * radius**2 * np.sin(turn) * np.cos(turn), count * radius**2 * np.tan(turn)
