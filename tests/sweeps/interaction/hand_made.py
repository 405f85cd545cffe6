"""Decks, points and diagrams made by hand."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from mbla.deck import read_deck
from mbla.deck.units import Units
from mbla.model import build_model
from mbla.sweeps.design.design import SweepColumn
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.engine.engine import Engine
from mbla.sweeps.interaction.domain import Point, domain_of
from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS, Question
from mbla.sweeps.interaction.study import Interaction, question_of, study_points
from mbla.sweeps.plan import DONE, Outcome, Plan, Task
from mbla.sweeps.studies import About, study_table
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


class Asked:
    """What the command line asks."""

    def __init__(self, **given: Any) -> None:
        self.case = given.get("case")
        self.loads = given.get("loads")
        self.directions = given.get("directions")
        self.start = given.get("start")
        self.end = given.get("end")


class ThisProcess(Engine):
    """An engine that solves the points where it is."""

    def _solved(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes, the last task first: the order must not matter."""
        runner = PointRunner(plan)
        for task in reversed(tasks):
            yield runner.run(task)


def question(folder: Path, overrides: Sequence[str] = (), **asked: Any) -> Question:
    """What is asked of the block."""
    return question_of(read_deck(written(folder), overrides), Asked(**asked))


def written(folder: Path) -> Path:
    """The deck of the block as a file."""
    path = folder / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    return path


def solved(folder: Path, overrides: Sequence[str] = (), **asked: Any) -> Interaction:
    """The diagram of the block."""
    deck = read_deck(written(folder), overrides)
    wanted = question_of(deck, Asked(**asked))
    return study_points(deck, overrides, wanted, ThisProcess(), None)


def live_load(folder: Path, settings: Sequence[str], case: str) -> Any:
    """Live load of the block under a case, (6,), and its dead load."""
    model = build_model(read_deck(written(folder), settings))
    (found,) = [one for one in model.load_cases if one.name == case]
    return found.live_load[0], found.dead_load[0]


def point(angle: float, factor: float = 0.5, **changes: Any) -> Point:
    """A verified point of associative flow whose mechanism bounds the domain across its ray."""
    cosine, sine = horizontal(angle, 1.0)
    plain = Point(
        angle,
        True,
        0,
        "solved",
        factor,
        factor,
        factor,
        factor,
        "yes",
        "sliding",
        {"A": cosine, "B": sine},
        seconds=0.1,
    )
    return replace(plain, **changes)


def study(points: Sequence[Point], kind: str = DIRECTION, flow_rule: str = "associative") -> Interaction:
    """The diagram of these points."""
    pair = ("A", "B")
    closed = kind == DIRECTION
    asked = Question(
        kind=kind,
        case="push" if closed else "interact",
        axes=("along x", "along y") if closed else ("factor of A", "factor of B"),
        short=("x", "y") if closed else pair,
        pair=pair,
        angles=tuple(one.angle for one in points),
        settings=tuple({} for _ in points),
        fixed=(),
        closed=closed,
        absolute=True,
        words=("what is asked",),
    )
    assert kind in (DIRECTION, TWO_LOADS)
    domain = domain_of(points, pair, closed=closed)
    of = About("block.yaml", "Block", (), Units("m", "N", "kg"), flow_rule, {"mbla": "0"})
    angle = SweepColumn("azimuth", "degree", "", "float", "azimuth", "azimuth")
    plan = Plan("", "", (), ("push",), ("load_factor",), "none", "", None, None, "")
    outcomes = {n: Outcome(str(n), DONE, 0, "", {}, 1, 0.1) for n in range(1, len(points) + 1)}
    table = study_table(of, angle, asked.angles, plan, outcomes)
    return Interaction(of, table, 0, 1.0, asked, tuple(points), domain)


def around(count: int, **changes: Any) -> list[Point]:
    """Points all around at one radius."""
    return [point(360.0 * number / count, **changes) for number in range(count)]
