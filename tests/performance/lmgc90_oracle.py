"""Structures in time by LMGC90 and by mbla: peaks and residuals of some points, to results/lmgc90.csv.

::

    python -m tests.performance.lmgc90_oracle mbla [SCENE ...]
    python -m tests.performance.lmgc90_oracle lmgc90 [SCENE ...] --python PYTHON    with compas_lmgc90
    python -m tests.performance.lmgc90_oracle table                                 of lmgc90.md, from recorded rows

LMGC90 is no dependency: ``python -m venv FOLDER && FOLDER/bin/pip install compas_lmgc90==0.1.11`` makes an environment
of its own, and PYTHON is its interpreter. Scenes: :mod:`tests.performance.lmgc90_scenes`.

Two kinds of joints. *rigid*: the law IQS_CLB of LMGC90 (inelastic shock, Coulomb friction), beside joints of 1e12 Pa/m.
*elastic*: its law ELASTIC_REPELL_CLB, a spring without tension at each contact point with Coulomb friction, rigid in
shear, beside joints of 1e10 Pa/m with the same share of area a point. There the structure sinks in for ``SETTLING``
seconds before the pulse; of mbla the gravity state comes first. *usual*: as elastic, with the shear stiffness that mbla
has by default, 0.4 of the normal one; LMGC90 has none like it.

A row: peak, the greatest displacement along x, or y, relative to the base, its time from the start of the pulse, the
greatest displacement the other way, and that at the end.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly import build_assembly
from mbla.deck import Deck, read_deck_text
from mbla.model import Model, build_model
from mbla.solution.settings import solver_settings
from mbla.solution.time_history.follow import follow
from tests.performance.lmgc90_scenes import SCENES, SOFT, STEEP_RATIO, STIFF, Scene, scaled
from tests.performance.recording import CASES, RESULTS, Row, read_rows, record

LMGC90, MBLA = "LMGC90", "mbla"
KEYS = CASES["lmgc90"]
STEPS = (2e-3, 1e-3, 5e-4)
GREATER = 1.01
SETTLING = 0.5
CORNERS = 4
"""contact points of an interface in LMGC90"""
SAME = 1e-5
"""relative, of the peak: what has come to rest still creeps by rounding"""
RIGID, ELASTIC, USUAL = "rigid", "elastic", "usual"
JOINTS = {RIGID: (STIFF, 0.4), ELASTIC: (SOFT, STEEP_RATIO), USUAL: (SOFT, 0.4)}
"""normal stiffness in mbla, Pa/m, and shear stiffness over it"""


@dataclass(frozen=True)
class Run:
    """Kind of joints, step, s, and factor on the amplitude of the pulse."""

    joints: str
    step: float
    amplitude: float = 1.0


@dataclass(frozen=True)
class History:
    """Displacements of points in time, and what they took.

    times         : (n_steps,) s, from the start of the pulse
    displacements : (n_steps, n_points) m, of each along its axis, relative to the base and to where it was then
    seconds       : of the processor
    """

    times: FloatArray
    displacements: FloatArray
    seconds: float
    notes: str


def rows_of(model: Model, group: str) -> IntArray:
    """Blocks of a group in their order."""
    return np.array([row for row, name in enumerate(model.blocks.groups) if name == group])


def deck_of(text: str) -> Deck:
    """Read as a file."""
    return read_deck_text(text, Path("scene.yaml"), ())


def question_for(scene: Scene, run: Run) -> dict[str, object]:
    """What ``lmgc90_run.py`` reads."""
    model = build_model(deck_of(scene.text()))
    blocks, solids = model.blocks, []
    for block in range(len(blocks)):
        corners = slice(blocks.vertex_start[block], blocks.vertex_start[block + 1])
        faces = [
            (blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]] - corners.start).tolist()
            for face in range(blocks.face_start[block], blocks.face_start[block + 1])
        ]
        solids.append({"vertices": blocks.vertices[corners].tolist(), "faces": faces})
    law, coefficients, before = "IQS_CLB", [scene.friction], 0.0
    if run.joints == ELASTIC:
        assert scene.area is not None
        law, coefficients, before = "ELASTIC_REPELL_CLB", [SOFT * scene.area / CORNERS, scene.friction], SETTLING
    times = np.arange(round((before + scene.duration) / run.step) + 2) * np.float64(run.step)
    return {
        "blocks": solids,
        "density": scene.density,
        "held": rows_of(model, scene.held).tolist(),
        "times": times.tolist(),
        "velocities": scene.pulse.velocities(times - before).T.tolist(),
        "law": law,
        "coefficients": coefficients,
        "step": run.step,
        "steps": len(times) - 2,
        "points": [[int(rows_of(model, point.group)[point.index]), point.place] for point in scene.points.values()],
    }


def along_axes(scene: Scene, displacements: FloatArray) -> FloatArray:
    """Of points (n_steps, n_points, 3), each along its own axis, (n_steps, n_points)."""
    axes = [point.axis for point in scene.points.values()]
    return np.asarray(displacements[:, range(len(axes)), axes])


def by_lmgc90(python: Path, scene: Scene, run: Run) -> History:
    """One run by another interpreter; from the start of the pulse, relative to where points were then."""
    script = Path(__file__).with_name("lmgc90_run.py")
    with TemporaryDirectory() as folder:
        path = Path(folder) / "answer.json"
        question = json.dumps(question_for(scene, run))
        words = [str(python), str(script), str(path)]
        subprocess.run(words, input=question, text=True, check=True, stdout=subprocess.DEVNULL)
        answer = json.loads(path.read_text(encoding="utf-8"))
    before = round(SETTLING / run.step) if run.joints == ELASTIC else 0
    moved = along_axes(scene, np.array(answer["displacements"]))
    along = np.vstack([np.zeros(len(scene.points)), moved])[before:]
    along = along - along[0]
    times = np.arange(len(along)) * np.float64(run.step)
    return History(times, along, answer["seconds"], answer["versions"])


def by_mbla(scene: Scene, run: Run) -> History:
    """One run in this process; from rest under the dead load."""
    deck = deck_of(scene.text(*JOINTS[run.joints], run.step))
    model = build_model(deck)
    assembly, started = build_assembly(deck, model), time.process_time()
    result, _ = follow(assembly, deck.contacts, model.load_cases[0], solver_settings(deck.analysis))
    seconds, found, rows = time.process_time() - started, result.histories, result.rows
    assert found is not None  # it stands
    assert rows is not None
    each = rows.factorisations[-1] / (len(rows) - 1)
    notes = f"{each:.1f} factorisations a step, {rows.halved[-1]} halved, {rows.missed[-1]} missed"
    return History(found.times, along_axes(scene, found.displacements), seconds, notes)


def tell(program: str, name: str, run: Run, found: History) -> None:
    """A row for each point of a scene."""
    for column, point in enumerate(SCENES[name]().points):
        along = found.displacements[:, column]
        size = np.abs(along)
        peak = int(np.argmax(size >= (1.0 - SAME) * size.max()))
        row = {"scene": name, "point": point, "joints": run.joints, "program": program}
        row |= {"step_ms": f"{1e3 * run.step:g}", "amplitude": f"{run.amplitude:g}"}
        row |= {"peak_mm": f"{1e3 * along[peak]:.4g}", "peak_s": f"{found.times[peak]:.4g}"}
        other = float(np.max(-np.sign(along[peak]) * along))
        row |= {"back_mm": f"{1e3 * other:.3f}", "end_mm": f"{1e3 * along[-1]:.3f}", "end_s": f"{found.times[-1]:.3g}"}
        record("lmgc90", row | {"seconds": f"{found.seconds:.2g}", "notes": found.notes})


def runs_of(scene: Scene, program: str) -> list[Run]:
    """All joints and steps that a program has, and once a pulse that is a little greater."""
    kinds = [RIGID] if scene.area is None else [RIGID, ELASTIC]
    if program == LMGC90:
        return [*(Run(joints, step) for joints in kinds for step in STEPS), Run(RIGID, STEPS[1], GREATER)]
    return [Run(joints, step) for joints in [*kinds, USUAL] for step in STEPS[:2]]


def other_joints(scene: str, joints: str) -> str:
    """Those of LMGC90 beside which some of mbla stand."""
    if joints != USUAL:
        return joints
    return RIGID if SCENES[scene]().area is None else ELASTIC


def table(rows: Sequence[Row]) -> Iterator[str]:
    """A line for each point and kind of joints: both programs at all their steps, and how far mbla is off."""
    last = {tuple(row[key] for key in KEYS): row for row in rows}
    cases = dict.fromkeys((row["scene"], row["point"], row["joints"]) for row in rows if row["program"] == MBLA)
    steps = [f"{1e3 * step:g}" for step in STEPS]
    own_columns = "mbla: peak, mm | off | at, s | s | back, mm | end, mm"
    yield f"| scene, point | joints | LMGC90: peak, mm | at, s | s | {own_columns} |"
    yield "|---" * 11 + "|"
    for scene, point, joints in sorted(cases, key=lambda case: list(SCENES).index(case[0])):
        key = (scene, point, other_joints(scene, joints), LMGC90)
        oracle, own = (
            [last[*first, step, "1"] for step in steps if (*first, step, "1") in last]
            for first in (key, (scene, point, joints, MBLA))
        )
        off = float(own[-1]["peak_mm"]) / float(oracle[-1]["peak_mm"]) - 1.0
        cells = [f"{scene}, {point}", joints]
        for found in (oracle, own):
            cells += [", ".join(row["peak_mm"] for row in found), found[-1]["peak_s"], found[-1]["seconds"]]
        cells.insert(6, f"{100.0 * off:+.1f} %")
        for what in ("back_mm", "end_mm"):
            cells.append("; ".join(f"{round(float(found[-1][what]), 1) + 0.0:.1f}" for found in (oracle, own)))
        yield f"| {' | '.join(cells)} |"
    for scene, point in dict.fromkeys((scene, point) for scene, point, _ in cases):
        first = (scene, point, RIGID, LMGC90, steps[1])
        more = float(last[*first, f"{GREATER:g}"]["peak_mm"]) / float(last[*first, "1"]["peak_mm"]) - 1.0
        yield f"\npulse {GREATER:g} times as strong: {scene}, {point} {100.0 * more:+.1f} %"


def main() -> None:
    """As the first lines say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["mbla", "lmgc90", "table"])
    parser.add_argument("scene", nargs="*", help=f"of: {', '.join(SCENES)}; else all")
    parser.add_argument("--python", type=Path, help="interpreter with compas_lmgc90")
    options = parser.parse_args()
    if options.what == "table":
        sys.stdout.write("\n".join(table(read_rows(RESULTS / "lmgc90.csv"))) + "\n")
        return
    if options.what == "lmgc90" and options.python is None:
        parser.error("lmgc90 needs --python, an interpreter with compas_lmgc90")
    program = LMGC90 if options.what == "lmgc90" else MBLA
    for name in options.scene or SCENES:
        scene = SCENES[name]()
        for run in runs_of(scene, program):
            pushed = scaled(scene, run.amplitude)
            tell(
                program,
                name,
                run,
                by_lmgc90(options.python, pushed, run) if program == LMGC90 else by_mbla(pushed, run),
            )


if __name__ == "__main__":
    main()
