"""Twenty structures in twelve equivalent forms, and under five kernels of OpenBLAS: how far load factors lie apart.

::

    python -m tests.performance.forms                       all structures, by the path of elastic joints
    python -m tests.performance.forms room push_y           a structure, a load case; a deck by its path as well
    python -m tests.performance.forms --kernels             as given, under each kernel
    python -m tests.performance.forms --table               what was recorded, for README.md

Forms say the same in another way: mirrored, turned with gravity, blocks in another order, 1000 times as long with
stresses as much greater, corners 1e-9 of the size off, a thousandfold density, feet and pounds. Without dilatancy no
theorem makes the load factor unique; the path of elastic joints selects it, and its steps and rounding are all that may
differ. The spread is the greatest distance over the greatest load factor. One thread, seconds of the processor.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mbla.deck import read_deck
from mbla.errors import MblaError
from mbla.model import build_model
from mbla.model.model import select_cases
from tests.decks.folder import DECKS
from tests.performance.recording import ONE_THREAD, PROJECT, RESULTS, Row, read_rows, record
from tests.properties.restatements import rotation
from tests.properties.rigid_motions import moved_scene, renumbered
from tests.properties.scenes import Scene, Solved, solve_scene, with_analysis
from tests.properties.sizes import roughened, scaled

STRUCTURES = (
    ("benchmarks/published/ferris_wall_1", "push_x"),
    ("benchmarks/published/ferris_wall_3", "push_x"),
    ("benchmarks/published/ferris_wall_5", "push_x"),
    ("benchmarks/closed_forms/wall_20x20", "in_plane"),
    ("tutorials/arch", "along"),
    ("tutorials/arch_on_piers", "along"),
    ("tutorials/lintels_and_arches", "in_plane"),
    ("tutorials/displaced_pile", "right"),
    ("structures/colonnade", "along"),
    ("regressions/light_block_pushed", "c"),
    ("regressions/toppling_slope", "slope"),
    ("tutorials/corner", "corner_out"),
    ("tutorials/walls_at_a_corner", "gable_x"),
    ("tutorials/dome", "push_x"),
    ("tutorials/segmental_domes", "slide"),
    ("tutorials/pavilion_vault", "along_y"),
    ("tutorials/cross_vault", "along_x"),
    ("structures/cross_vault_on_piers", "along_x"),
    ("structures/spiral_stair", "one_tread"),
    ("structures/room", "push_y"),
)
"""decks and load cases, those in the plane first; seconds each"""

KERNELS = ("Haswell", "SkylakeX", "Sandybridge", "Nehalem", "Prescott")
"""values of OPENBLAS_CORETYPE"""

LONGER, NOISE, DENSER = 1e3, 1e-9, 1e3
FOOT, POUND = 0.3048, 4.4482216152605
SPREAD = 1e-3
"""spread from which a structure is named"""


def moved(matrix: np.ndarray) -> Callable[[Scene], Scene | None]:
    """Turned or mirrored about the origin, gravity and all other loads with it."""
    return lambda scene: moved_scene(scene, matrix, np.zeros(3))


def in_order(seed: int) -> Callable[[Scene], Scene | None]:
    """Blocks in a random order."""
    return lambda scene: renumbered(scene, np.random.default_rng(seed).permutation(len(scene.model.blocks)))


def denser(scene: Scene) -> Scene | None:
    """Densities, forces and strengths times a thousand."""
    return scaled(scene, 1.0, DENSER)


FORMS: dict[str, Callable[[Scene], Scene | None]] = {
    "given": lambda scene: scene,
    "mirrored in x": moved(np.diag([-1.0, 1.0, 1.0])),
    "mirrored in y": moved(np.diag([1.0, -1.0, 1.0])),
    "17°": moved(rotation((0, 0, 1), 17.0)),
    "90°": moved(rotation((0, 0, 1), 90.0)),
    "slanting": moved(rotation((1, 2, -1), 71.0)),
    "order 1": in_order(1),
    "order 2": in_order(2),
    "longer": lambda scene: scaled(scene, LONGER, LONGER**3),
    "noise": lambda scene: roughened(scene, NOISE, 1),
    "denser": denser,
    "feet": lambda scene: scaled(scene, 1.0 / FOOT, 1.0 / POUND),
}


@dataclass(frozen=True)
class Figure:
    """What came of one form; ``load_factor`` nan where none is claimed."""

    form: str
    load_factor: float
    status: str
    end: str
    seconds: float

    @property
    def words(self) -> str:
        """Load factor, with the status where it is another one than solved."""
        return f"{self.load_factor:.8g}" + ("" if self.status == "solved" else f" {self.status}")


def scene_of(deck_name: str, case: str) -> Scene:
    """A load case without dilatancy, by the path alone: no search for lower states, no question of standing."""
    path = Path(deck_name) if Path(deck_name).is_file() else DECKS / f"{deck_name}.yaml"
    deck = read_deck(path, ())
    model = build_model(deck)
    load_case = replace(select_cases(model, [case] if case else [])[0], pushover=None)
    scene = Scene(deck_name, deck, replace(model, load_cases=(load_case,)))
    return with_analysis(scene, flow_rule="non_associative", scheme="auto", search=0.0, standing=False)


def figure_of(form: str, scene: Scene) -> Figure:
    """One form, solved and verified."""
    started = time.process_time()
    try:
        other = FORMS[form](scene)
        solved = None if other is None else solve_scene(other)
    except MblaError as error:
        return Figure(form, np.nan, f"refused: {error}"[:80], "", time.process_time() - started)
    return _figure(form, solved, time.process_time() - started)


def _figure(form: str, solved: Solved | None, seconds: float) -> Figure:
    if solved is None:
        return Figure(form, np.nan, "does not apply", "", seconds)
    case = solved.cases[0]
    mechanics = case.solution.mechanics
    value = np.nan if mechanics is None else mechanics.load_factor
    return Figure(form, value, case.status.value, case.solution.path_end, seconds)


def forms_of(deck_name: str, case: str) -> list[Figure]:
    """All forms of one structure."""
    scene = scene_of(deck_name, case)
    return [figure_of(form, scene) for form in FORMS]


def kernels_of(deck_name: str, case: str) -> list[Figure]:
    """One structure as given under each kernel, each in a process of its own."""
    code = (
        "import json; from dataclasses import astuple; from tests.performance.forms import figure_of, scene_of; "
        f"print(json.dumps(astuple(figure_of('given', scene_of({deck_name!r}, {case!r})))))"
    )
    found = []
    for kernel in KERNELS:
        variables = {"OPENBLAS_CORETYPE": kernel, **ONE_THREAD}
        words = [sys.executable, "-c", code]
        child = subprocess.run(
            words, env=os.environ | variables, cwd=PROJECT, capture_output=True, text=True, check=True
        )
        _, load_factor, status, end, seconds = json.loads(child.stdout)
        found.append(Figure(kernel, load_factor, status, end, seconds))
    return found


def spread(figures: Sequence[Figure]) -> float:
    """Greatest distance over the greatest size; inf where some have a load factor and others none."""
    values = np.array([figure.load_factor for figure in figures if figure.status != "does not apply"])
    known = values[np.isfinite(values)]
    if len(known) < len(values):
        return float("inf") if len(known) else 0.0
    return float(np.ptp(known) / np.abs(known).max()) if len(known) and np.abs(known).max() > 0.0 else 0.0


def row_of(deck_name: str, case: str, figures: Sequence[Figure]) -> dict[str, object]:
    """For the file: spread, statuses and ends counted, then each form."""
    return {
        "structure": deck_name,
        "case": case,
        "spread": f"{spread(figures):.1e}",
        "statuses": _counted(figure.status for figure in figures),
        "ends": _counted(figure.end for figure in figures),
        "seconds": sum(figure.seconds for figure in figures),
        **{figure.form: figure.words for figure in figures},
    }


def _counted(words: Iterator[str]) -> str:
    return ", ".join(f"{count} {word}" for word, count in Counter(words).most_common())


def table() -> Iterator[str]:
    """Last recorded row of each structure: load factor as given, spreads, and the forms that lie farthest apart."""
    kernels = {(row["structure"], row["case"]): row for row in read_rows(RESULTS / "kernels.csv")}
    last = {(row["structure"], row["case"]): row for row in read_rows(RESULTS / "forms.csv")}
    yield "| structure | load factor | apart, 12 forms | least, greatest | apart, 5 kernels | status | end |"
    yield "|---|---|---|---|---|---|---|"
    for (name, case), row in last.items():
        values = {form: float(row[form].split()[0]) for form in FORMS}
        low, high = min(values, key=lambda form: values[form]), max(values, key=lambda form: values[form])
        ends = f"{values[low]:.6g} ({low}), {values[high]:.6g} ({high})" if float(row["spread"]) > 1e-6 else "–"
        other = kernels.get((name, case), {}).get("spread", "–")
        words = (_percent(row["spread"]), ends, _percent(other), row["statuses"], row["ends"])
        yield f"| {name.split('/')[-1]} {case} | {values['given']:.6g} | {' | '.join(words)} |"


def _percent(share: str) -> str:
    return share if share == "–" else f"{100.0 * float(share):.2g} %"


def main() -> None:
    """As the first lines say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("structure", nargs="?", help="part of a deck's name, or a path; else all")
    parser.add_argument("case", nargs="?", default="")
    parser.add_argument("--kernels", action="store_true")
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    if options.table:
        sys.stdout.write("".join(f"{line}\n" for line in table()))
        return
    measure, benchmark = (kernels_of, "kernels") if options.kernels else (forms_of, "forms")
    if options.structure and Path(options.structure).is_file():  # a deck of somebody else: not recorded
        row: Row | dict[str, object] = row_of(options.structure, options.case, measure(options.structure, options.case))
        sys.stdout.write("  ".join(f"{name} {value}" for name, value in row.items()) + "\n")
        return
    for name, case in STRUCTURES:
        if (options.structure or "") in name and (options.case or case) == case:
            record(benchmark, row_of(name, case, measure(name, case)))


if __name__ == "__main__":
    main()
