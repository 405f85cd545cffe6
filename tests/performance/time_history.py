"""Structures in time beside theory and other programs: results/time_history.csv, and the tables of time_history.md.

::

    python -m tests.performance.time_history                 all scenes at steps of 2, 1 and .5 ms, the cheap ones first
    python -m tests.performance.time_history sine arch       those whose names contain one of the words
    python -m tests.performance.time_history --steps 2 1     at some steps only, in ms
    python -m tests.performance.time_history --table         what was recorded last, for time_history.md

A least amplitude is scanned for upwards and halved in to 5e-4; of the column of drums it is the first of two
neighbouring amplitudes, 2 % apart, at both of which it falls, as the programs it stands beside have it. Theory:
``tests/analytic/rocking.py``.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mbla.assembly import build_assembly
from mbla.deck.deck import read_deck_text
from mbla.model import build_model
from mbla.solution.settings import solver_settings
from mbla.solution.time_history.follow import follow
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.analytic.rocking import RockingBlock
from tests.performance.recording import read_rows, record

STEPS = (2.0, 1.0, 0.5)
"""ms"""
SCAN, CLOSE = 1.005, 5e-4
BEYOND = {"rectangle": 1.1, "half_sine": 1.1, "sine": 4.0}
"""turn over α from which a block will fall: under one sine its balance is at 1 + a/(g tan α) at most"""
SLENDER = RockingBlock(0.2, 1.0)
COLUMN = {
    1.0: (0.20, 0.20, 0.21),
    0.6: (0.25, 0.23, 0.24),
    0.4: (0.31, 0.29, 0.30),
    0.34: (0.46, 0.75, 0.44),
    0.3: (0.87, 0.87, 0.88),
    0.2: (1.46, 1.45, 1.48),
}
"""t_p, s: g at which UDEC, HybriDFEM and LMGC90 have the column fall (Bouckaert and others 2025)"""


@dataclass(frozen=True)
class Scene:
    """What is asked of a structure.

    found     : the figure with a step in s
    reference : the same by theory or other programs, and where that is from
    """

    name: str
    unit: str
    reference: str
    source: str
    found: Callable[[float], float]


BLOCK = """mbla: 1
title: block
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: {friction}, stiffness: {{normal: {stiffness}}}}}}}
blocks: [{{box: {{group: b, material: stone, min: [0, 0, 0], max: [{width}, 0.3, {height}]}}}}]
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{case: {{time_history: {{motion: {motion}, step: {step}, duration: {duration}{more}}}}}}}
"""
"""of which a scene fills in the words in braces"""


def block(motion: str, step: float, duration: float, **other: object) -> TimeHistoryResult:
    """A single block, .2 x 1 m unless other figures are given."""
    words = {"friction": 5, "stiffness": "1.e10", "width": 0.2, "height": 1.0, "more": ""} | other
    return followed(BLOCK.format(motion=motion, step=step, duration=duration, **words))


def followed(text: str) -> TimeHistoryResult:
    """The only load case of a deck."""
    deck = read_deck_text(text, Path("scene.yaml"), ())
    model = build_model(deck)
    assembly = build_assembly(deck, model, None)
    found, *_ = follow(assembly, deck.contacts, model.load_cases[0], solver_settings(deck.analysis))
    assert found.peaks is not None
    return found


def falls(found: TimeHistoryResult) -> bool:
    """Whether a block has fallen, or has come as far as the deck says."""
    return found.end in (HistoryEnd.COLLAPSE, HistoryEnd.DISPLACED)


def halved(fails: Callable[[float], bool], reference: float) -> float:
    """The first amplitude at which it falls, scanned for upwards from below the reference, then halved in."""
    low = 0.985 * reference
    while fails(low):
        low *= 0.96
    high = SCAN * low
    while not fails(high):
        low, high = high, SCAN * high
    while high / low - 1.0 > CLOSE:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if fails(middle) else (middle, high)
    return 0.5 * (low + high)


def pulse(form: str, amplitude: float, duration: float) -> str:
    """Of the base along x, amplitude in g."""
    return f'{{pulse: {form}, amplitude: "{amplitude!r} g", duration: {duration!r}, direction: x}}'


def overturned(form: str, duration: float, reference: float) -> Callable[[float], float]:
    """Amplitude in g of a pulse under which the slender block falls: it has passed where anything turns it back."""
    beyond = SLENDER.displaced(BEYOND[form] * SLENDER.alpha)

    def found(step: float) -> float:
        more = f", stop: {{displacement: {beyond:.4f}}}"
        return halved(lambda a: falls(block(pulse(form, a, duration), step, duration + 2.5, more=more)), reference)

    return found


def one_sine(ratio: float, reference: float) -> Callable[[float], float]:
    """Amplitude of one wave of a sine of ω = ratio × p under which it falls, over g tan α."""
    duration = 2.0 * np.pi / (ratio * SLENDER.p)

    def found(step: float) -> float:
        slender = 0.2
        return overturned("sine", float(duration), slender * reference)(step) / slender

    return found


def sliding(step: float) -> float:
    """Slip of a flat block, m."""
    found = block(pulse("rectangle", 0.5, 0.2), step, 1.0, friction=0.3, width=1.0, height=0.2)
    assert found.peaks is not None
    return found.peaks.peak


STACK = """mbla: 1
title: two blocks
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6, stiffness: {{normal: 1.e10}}}}}}
blocks:
  - box: {{group: low, material: stone, min: [0, 0, 0], max: [0.3, 0.3, 0.6]}}
  - box: {{group: top, material: stone, min: [0, 0, 0.6], max: [0.3, 0.3, 1.2]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{case: {{time_history: {{motion: {motion}, step: {step}, duration: 4}}}}}}
"""


def two_blocks(amplitude: float) -> Callable[[float], float]:
    """Greatest displacement of the upper block under one sine of 2 Hz, m."""

    def found(step: float) -> float:
        result = followed(STACK.format(motion=pulse("sine", amplitude, 0.5), step=step))
        assert result.peaks is not None
        return float(result.peaks.displacements[1])

    return found


def two_blocks_residual(amplitude: float) -> Callable[[float], float]:
    """Residual displacement of the upper block, m."""

    def found(step: float) -> float:
        result = followed(STACK.format(motion=pulse("sine", amplitude, 0.5), step=step))
        assert result.peaks is not None
        return float(result.peaks.residuals[1])

    return found


ARCH = """mbla: 1
title: arch of 17 voussoirs
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: "=tan(35)", stiffness: {{normal: {stiffness}}}}}}}
blocks:
  - arch: {{group: arch, material: stone, shape: semicircular, span: 7.5, thickness: 0.5, width: 1,
      voussoirs: 17, springers: ground}}
contacts: {{joint: dry}}
load_cases:
  case:
    time_history:
      motion: {{pulse: half_sine, amplitude: "1.5 m/s2", duration: 0.25, direction: x}}
      step: {step}
      duration: 1.5
      record: {{points: {{crown: {{on: {{group: arch, index: 8}}}}}}}}
"""


def arch(stiffness: float) -> Callable[[float], float]:
    """Greatest displacement of the crown along x, mm."""

    def found(step: float) -> float:
        result = followed(ARCH.format(step=step, stiffness=f"{stiffness:.0e}".replace("e", ".e")))
        assert result.histories is not None
        return 1e3 * float(np.abs(result.histories.displacements[:, 0, 0]).max())

    return found


def drums(amplitude: float, duration: float, step: float) -> str:
    """The column of 7 drums and a cap: 1.11 m wide at the foot, .0352941 m less for each metre of height."""
    levels = [*(0.82 * i for i in range(8)), 5.95]
    blocks = []
    for low, high in itertools.pairwise(levels):
        a, b = (0.5 * (1.11 - 0.0352941 * z) for z in (low, high))
        ends = [(-a, low), (a, low), (b, high), (-b, high)]
        points = ", ".join(f"[{x:.9f}, {y}, {z:.9g}]" for y in (-0.5, 0.5) for x, z in ends)
        faces = "[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]"
        shape = f"vertices: [{points}], faces: [{faces}]"
        blocks.append(f"  - polyhedron: {{group: column, material: stone, {shape}}}")
    motion = pulse("dejong", amplitude, duration)
    return "\n".join(
        [
            "mbla: 1",
            "title: column of drums",
            "materials: {stone: {density: 2620}}",
            "joints: {dry: {friction: 0.7, stiffness: {normal: 1.e10}}}",
            "blocks:",
            *blocks,
            "contacts: {joint: dry}",
            "supports: [{ground: {z: 0}, joint: dry}]",
            f"load_cases: {{case: {{time_history: {{motion: {motion}, step: {step}, duration: {3 * duration + 3}}}}}}}",
        ]
    )


def column(duration: float) -> Callable[[float], float]:
    """First of two amplitudes, 2 % apart, in g, at both of which the column falls."""

    def found(step: float) -> float:
        amplitude, last = 0.96 * min(COLUMN[duration]), False
        while falls(followed(drums(amplitude, duration, step))):
            amplitude *= 0.96
        while True:
            amplitude *= 1.02
            now = falls(followed(drums(amplitude, duration, step)))
            if now and last:
                return amplitude / 1.02
            last = now

    return found


def scenes() -> Iterator[Scene]:
    """Cheap ones first."""
    newmark = "Newmark: (a − μ g) a t²/(2 μ g), the block against its base"
    yield Scene("sliding, 0.5 g for 0.2 s, friction 0.3", "m", "0.0654", newmark, sliding)
    housner = "Housner's equation of motion (tests/analytic/rocking.py)"
    for duration, value in ((0.25, 0.3263117), (0.5, 0.2350597)):
        found = overturned("rectangle", duration, value)
        yield Scene(f"block falls, rectangle {duration:g} s", "g", f"{value}", housner, found)
    for duration, value in ((0.25, 0.4899322), (0.5, 0.3264602), (1.0, 0.2487556)):
        found = overturned("half_sine", duration, value)
        yield Scene(f"block falls, half sine {duration:g} s", "g", f"{value}", housner, found)
    for ratio, value in ((1, 1.1010749), (2, 1.2198727), (3, 1.3876887), (5, 2.5781881)):
        yield Scene(f"block falls, one sine, ω/p {ratio}", "g tan α", f"{value}", housner, one_sine(ratio, value))
    yield Scene("two blocks, 0.3 g, top", "m", "", "", two_blocks(0.3))
    yield Scene("two blocks, 0.4 g, residual of the top", "m", "", "", two_blocks_residual(0.4))
    for stiffness in (1e10, 1e12):
        words = "LMGC90 12.66–12.80; rigid 12.35"
        yield Scene(f"arch, crown, k_N {stiffness:.0e}", "mm", words, "own runs", arch(stiffness))
    for duration, others in COLUMN.items():
        words = " ".join(f"{value:g}" for value in others)
        yield Scene(f"column falls, t_p {duration:g} s", "g", words, "UDEC, HybriDFEM, LMGC90", column(duration))


def measured(scene: Scene, step: float) -> None:
    """Record a scene with a step in ms."""
    begun = time.process_time()
    value = scene.found(1e-3 * step)
    row = {"scene": scene.name, "step": f"{step:g}", "unit": scene.unit, "found": f"{value:.6g}"}
    record("time_history", row | {"reference": scene.reference, "seconds": time.process_time() - begun})


def table() -> None:
    """The rows of time_history.md, of what was recorded last."""
    found: dict[str, dict[str, str]] = {}
    for row in read_rows(Path(__file__).parent / "results" / "time_history.csv"):
        found.setdefault(row["scene"], {})[row["step"]] = row["found"]
    for scene in scenes():
        mine = found.get(scene.name, {})
        cells = [mine.get(f"{step:g}", "–") for step in STEPS]
        words = " | ".join([f"{scene.name} [{scene.unit}]", scene.reference or "–", *cells])
        sys.stdout.write(f"| {words} |\n")


def main() -> None:
    """Measure, or print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs="*")
    parser.add_argument("--steps", nargs="*", type=float, default=STEPS)
    parser.add_argument("--table", action="store_true")
    asked = parser.parse_args()
    if asked.table:
        table()
        return
    for step in asked.steps:
        for scene in scenes():
            if not asked.words or any(word in scene.name for word in asked.words):
                measured(scene, step)


if __name__ == "__main__":
    main()
