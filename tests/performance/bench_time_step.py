"""What steps of a structure in time cost: results/time_step.csv.

::

    python -m tests.performance.bench_time_step            walls of 410 blocks, half a second
    python -m tests.performance.bench_time_step record     the walls under 2,000 steps of noise of 1 and 0.6 g

Seconds of the processor on one thread. A step is measured in factorisations of the matrix of the structure, assembly
included, of the same run; searches for contacts as their share of the time. Points are those that are solved.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.pushover.pose.moved_joints import MovedJoints
from mbla.solution.settings import solver_settings
from mbla.solution.time_history import follow as following
from tests.performance.recording import record

WALL = """mbla: 1
title: Wall of 410 blocks
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6, stiffness: {{normal: 1.e+10}}}}}}
blocks: [{{wall: {{group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 8, courses: 20, bond: running}}}}]
contacts: {{joint: dry, tolerance: 1.e-3}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{quake: {{time_history: {{motion: {motion}, step: 0.002, duration: {duration}}}}}}}
"""

NOISE = "[{{file: noise.csv, columns: [t, a], unit: g, scale: {scale}, baseline: highpass, direction: {direction}}}]"


def sine(amplitude: float, direction: str) -> str:
    """Motion of 2 Hz."""
    return f"{{pulse: sine, amplitude: {amplitude} g, duration: 0.5, direction: {direction}}}"


SCENES = {
    "plane, slides, 0.7 g": WALL.format(motion=sine(0.7, "x"), duration=0.3),
    "plane, sticks, 0.1 g": WALL.format(motion=sine(0.1, "x"), duration=0.3),
    "space, slides, 0.6 g": WALL.format(motion=sine(0.6, "[1, 1, 0]"), duration=0.2),
}

RECORDS = {
    "plane, 2,000 steps, 1.0 g": WALL.format(motion=NOISE.format(scale=1.0, direction="x"), duration=4),
    "space, 2,000 steps, 0.6 g": WALL.format(motion=NOISE.format(scale=0.6, direction="[1, 0.5, 0]"), duration=4),
}


def noise(folder: Path) -> None:
    """A record of peak 1 g: sines of 0.5 to 8 Hz with random phases under an envelope, the same on every machine."""
    random, t = np.random.default_rng(7), np.arange(0.0, 4.0, 0.01)
    frequencies, phases = np.linspace(0.5, 8.0, 40), random.uniform(0.0, 2.0 * np.pi, 40)
    a = np.sin(2.0 * np.pi * frequencies * t[:, None] + phases).sum(axis=1) * np.sin(np.pi * t / 4.0)
    a /= np.abs(a).max()
    lines = [f"{time:.2f},{value:.6f}" for time, value in zip(t.tolist(), a.tolist(), strict=True)]
    (folder / "noise.csv").write_text("t,a\n" + "\n".join(lines) + "\n", encoding="utf-8")


class Clock:
    """Counts calls of a function and the processor time that they take."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function, self.calls, self.seconds = function, 0, 0.0

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """The function."""
        started = time.process_time()
        found = self.function(*arguments, **named)
        self.seconds += time.process_time() - started
        self.calls += 1
        return found


def measure(scene: str, text: str) -> None:
    """One row."""
    with TemporaryDirectory() as name:
        path = Path(name) / "deck.yaml"
        path.write_text(text, encoding="utf-8")
        noise(path.parent)
        deck = read_deck(path, ())
        model = build_model(deck)
        assembly = build_assembly(deck, model)
    factorised, searched = Clock(Stiffness.factorized), Clock(MovedJoints.at_pose)
    setattr(Stiffness, "factorized", lambda *a, **k: factorised(*a, **k))  # noqa: B010
    setattr(MovedJoints, "at_pose", staticmethod(lambda *a, **k: searched(*a, **k)))  # noqa: B010
    after: list[float] = []
    settings = solver_settings(deck.analysis)
    result, _ = following.follow(
        assembly, deck.contacts, model.load_cases[0], settings, lambda progress: after.append(time.process_time())
    )
    seconds = (after[-1] - after[0]) * len(after) / (len(after) - 1)  # without the rest, which comes before them
    setattr(Stiffness, "factorized", factorised.function)  # noqa: B010
    setattr(MovedJoints, "at_pose", staticmethod(searched.function))  # noqa: B010
    rows = result.rows
    assert rows is not None
    assert result.peaks is not None
    steps, one = len(rows) - 1, factorised.seconds / factorised.calls
    record(
        "time_step",
        {
            "scene": scene,
            "steps": steps,
            "small_steps": int(rows.small_steps[-1]),
            "halved": int(rows.halved[-1]),
            "missed": int(rows.missed[-1]),
            "factorisations": float(rows.factorisations[-1] / steps),
            "factorisation_ms": 1e3 * one,
            "step_ms": 1e3 * seconds / steps,
            "step_in_factorisations": seconds / steps / one,
            "search_share": searched.seconds / seconds,
            "searches": result.searches,
            "seconds": seconds,
            "peak": result.peaks.peak,
            "end": str(result.end),
        },
    )


def main(which: str) -> None:
    """Measure and record."""
    for scene, text in (RECORDS if which == "record" else SCENES).items():
        measure(scene, text)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")
