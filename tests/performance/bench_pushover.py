"""What the way of pushed structures costs and where it is blocked: results/pushover.csv and pushover_random.csv.

::

    python -m tests.performance.bench_pushover              walls in running bond of 50, 410 and 1,041 blocks
    python -m tests.performance.bench_pushover random       200 random structures in their plane, 50 in space

Walls are pushed in their plane by 20 rows, the one of 20 courses by 100; seconds of the processor, on one thread, of
the way alone. Random structures are those of the tests, in space pushed along the diagonal of their plan.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program.build import build_program
from mbla.solution.pushover.control import Control
from mbla.solution.pushover.place import Row
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.pushover.start import start_of
from mbla.solution.pushover.way import Way
from mbla.solution.settings import solver_settings
from mbla.solution.solve import solve
from tests.line import HEAD
from tests.performance.recording import record
from tests.solution.pushover.test_pushover_laws import random_deck

SIDES = {7: 20, 20: 100, 32: 20}
"""courses, as many units long, and rows"""

RANDOM = {"plane": 200, "space": 50}


def wall(side: int, steps: int) -> str:
    """The deck of a wall."""
    return (
        f"{HEAD}joints: {{dry: {{friction: 0.65}}}}\n"
        f"blocks: [{{wall: {{material: stone, unit: [0.4, 0.2, 0.175], length: {0.4 * side}, courses: {side}}}}}]\n"
        "supports: [{ground: {z: 0}}]\n"
        f"load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}], pushover: {{step: 0.005, steps: {steps}}}}}}}\n"
    )


def measured(text: str) -> dict[str, str | float] | None:
    """How a deck is pushed; nothing where there is no state to start from."""
    with TemporaryDirectory() as folder:
        (path := Path(folder) / "deck.yaml").write_text(text, encoding="utf-8")
        deck = read_deck(path)
    assembly = build_assembly(deck, build_model(deck))
    model = assembly.model
    case, settings = model.load_cases[0], solver_settings(deck.analysis)
    solution = solve(build_program(assembly, case, deck.analysis), settings)
    if solution.mechanics is None or case.pushover is None:
        return None
    first, asked = start_of(solution), case.pushover
    started = time.process_time()
    structure = PushedStructure.of(assembly, deck.contacts, case, settings.analysis.flow_rule)
    way = Way(
        structure,
        Control.of(model, case, first.mechanism),
        first,
        asked.step,
        asked.until,
        asked.until_load_factor,
        asked.steps,
    )
    every = list(way.rows())
    rows = [row for row in every if isinstance(row, Row)]
    return {
        "blocks": len(model.blocks),
        "rows": len(rows),
        "missed": way.missed,
        "jumps": way.jumps,
        "factorizations": way.spent,
        "seconds": time.process_time() - started,
        "starts": first.load_factor,
        "displacement": way.displacement(rows[-1].pose) if rows else 0.0,
        "load_factor": rows[-1].load_factor if rows else 0.0,
        "off": max((row.off for row in rows), default=0.0),
        "end": str(every[-1]),
    }


def random_decks(kind: str) -> Iterator[tuple[int, str]]:
    """Random structures, pushed along the diagonal where they are to move in space."""
    for seed in range(RANDOM[kind]):
        text = random_deck(seed)
        yield seed, text if kind == "plane" else text.replace("acceleration: [1, 0, 0]", "acceleration: [0.8, 0.6, 0]")


def main(what: list[str]) -> None:
    """A row for each structure."""
    if what == ["random"]:
        for kind in RANDOM:
            for seed, text in random_decks(kind):
                if (found := measured(text)) is not None:
                    record("pushover_random", {"structure": f"{kind}, {seed}", **found})
        return
    for side in [int(each) for each in what] or list(SIDES):
        found = measured(wall(side, SIDES[side]))
        assert found is not None  # a wall has a load factor
        record("pushover", {"structure": f"wall, planar, {side} x {side}", **found})


if __name__ == "__main__":
    main(sys.argv[1:])
