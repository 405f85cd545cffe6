"""Time and load factor with and without each reduction; appends to results/reductions.csv.

::

    python -m tests.performance.bench_reductions            the structures of which each run takes seconds
    python -m tests.performance.bench_reductions --all      the whole standard set: hours
    python -m tests.performance.bench_reductions NAME ...   structures whose names contain one of these
    ... --flow-rule associative                             with this flow rule alone

A row for each reduction that a load case allows and that finds something: processor seconds of the solver stage
(reductions, programs and everything asked for beside the load factor) with all reductions and without that one, one
after the other in one process, and both load factors. Without normality load factors are not unique: the difference of
the two is then no error, both being verified in the whole model.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model, solids_of
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.build import build_program
from mbla.program.reductions import StepState, allowed_reductions, reduce_program
from mbla.solution import Solution, solve, verified_status, verify
from mbla.solution.settings import solver_settings
from tests.performance.recording import record
from tests.performance.standard_set import DECKS, FLOW_RULES, STANDARD_SET, Structure

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.7}}
contacts: {joint: dry}
blocks:
"""
WALL = "  - wall: {{group: {}, material: stone, unit: [0.4, 0.2, 0.2], length: {}, courses: {}, transform: [{}]}}\n"
FIXED = "  - wall: {{group: base, material: stone, unit: [0.4, 0.2, 0.2], length: {}, courses: 1, transform: [{}]}}\n"


def _walls(count: int) -> str:
    """Walls of 8 x 8 units beside each other."""
    return "".join(WALL.format("walls", 3.2, 8, f"{{translate: [0, {y}, 0]}}") for y in range(count))


COLUMN = (
    "  - column: {group: column, material: stone, radius: 0.4, top_radius: 0.35, height: 4, drums: 6, sides: 12, "
    "repeat: {count: 30, translate: [2, 0, 0]}}\n"
)
GROUND = "supports: [{ground: {z: 0}}]\n"
PUSHED = "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
OUTWARDS = "load_cases: {push: {live: [{acceleration: [0, 1, 0]}]}}\n"
ONE_PUSHED = "load_cases: {push: {live: [{acceleration: [1, 0, 0], on: {group: walls, index: 40}}]}}\n"
COURSE = FIXED.format(3.6, "{translate: [-0.2, 0, -0.2]}") + WALL.format("walls", 3.2, 8, "{translate: [0, 0, 0]}")
TEXTS = {
    "thirty columns apart": HEAD + COLUMN + GROUND + PUSHED,
    "two walls apart": HEAD + _walls(2) + GROUND + PUSHED,
    "six walls apart, one pushed": HEAD + _walls(6) + GROUND + ONE_PUSHED,
    "wall, pushed outwards": HEAD + _walls(1) + GROUND + OUTWARDS,
    "wall on a fixed course": HEAD + COURSE + "supports: [{blocks: base}]\n" + PUSHED,
    "wall on a fixed course, pushed outwards": HEAD + COURSE + "supports: [{blocks: base}]\n" + OUTWARDS,
}
"""Structures of which one or the other reduction makes something."""

QUICK = ("5 x 5", "10 x 10", "20 voussoirs", "50 voussoirs", "colonnade", *TEXTS)
"""Parts of the names of structures that are measured unless others are asked for."""


LONG = 5.0
"""Seconds of a run beside which imports do not count."""


@dataclass(frozen=True)
class Run:
    """One run of the solver stage."""

    solution: Solution
    status: str
    seconds: float

    @property
    def load_factor(self) -> float:
        """nan where there is none."""
        return float("nan") if self.solution.mechanics is None else self.solution.mechanics.load_factor


def structures(folder: Path) -> Iterator[Structure]:
    """The standard set, and the structures made for this benchmark."""
    yield from STANDARD_SET
    yield Structure("colonnade", "structures", DECKS / "structures" / "colonnade.yaml", (), "across")
    for name, text in TEXTS.items():
        path = folder / f"{name.replace(' ', '_').replace(',', '')}.yaml"
        path.write_text(text, encoding="utf-8")
        yield Structure(name, "reductions", path, (), "push")


class Measured:
    """A structure up to its contacts, ready to be solved in several ways."""

    def __init__(self, structure: Structure, flow_rule: str) -> None:
        self.deck = read_deck(structure.deck, (*structure.overrides, f"analysis.flow_rule={flow_rule}"))
        model = build_model(self.deck)
        self.contacts = contacts_of(self.deck, model)
        (self.load_case,) = (case for case in model.load_cases if case.name == structure.load_case)
        self.model = held_model(model, self.contacts)

    def run(self, without: str | None = None) -> Run:
        """The solver stage with all reductions, or without one; verified on the whole model."""
        analysis = self.deck.analysis
        solids = solids_of(self.model, self.contacts)
        started = time.process_time()
        program = build_program(solids, self.load_case, analysis)
        if without is not None:
            allowed = replace(allowed_reductions(analysis), **{without: False})
            associative = analysis.flow_rule == "associative"
            model, contacts = solids.model, solids.contacts
            whole = assemble(model, contacts, solids.load_case(self.load_case))
            reduced = reduce_program(model, contacts, whole, allowed, associative=associative)
            program = replace(program, reduced=reduced)
        solution = solve(program, analysis, solver_settings(analysis))
        seconds = time.process_time() - started
        checks = verify(self.model, self.contacts, self.load_case, solution)
        return Run(solution, str(verified_status(solution, checks)), seconds)


def measure(structure: Structure, flow_rule: str) -> None:
    """A row for each reduction that applies."""
    measured = Measured(structure, flow_rule)
    own = measured.run()
    if own.seconds < LONG:  # what is imported or built once would count
        own = measured.run()
    for step in own.solution.reductions:
        if step.state is not StepState.APPLIED or step.name == "glued":  # no switch: glued joints are rigid
            continue
        other = measured.run(step.name)
        last, others = own.solution.reductions[-1].after, other.solution.reductions[-1].after
        size = abs(own.load_factor) or 1.0
        record(
            "reductions",
            {
                "structure": structure.name,
                "flow_rule": flow_rule,
                "without": step.name,
                "found": step.found,
                "unknowns": last.unknowns,
                "unknowns_without": others.unknowns,
                "cones": last.cones,
                "cones_without": others.cones,
                "entries": last.entries,
                "entries_without": others.entries,
                "processor_seconds": own.seconds,
                "processor_seconds_without": other.seconds,
                "times_faster": other.seconds / own.seconds,
                "status": own.status,
                "status_without": other.status,
                "load_factor": f"{own.load_factor:.9g}",
                "load_factor_without": f"{other.load_factor:.9g}",
                "difference": (own.load_factor - other.load_factor) / size,
            },
        )


def main(arguments: Sequence[str]) -> None:
    """Measure what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=list(QUICK), metavar="NAME")
    parser.add_argument("--all", action="store_true", help="the whole standard set")
    parser.add_argument("--flow-rule", choices=FLOW_RULES, action="append", help="only with this one")
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        for structure in structures(Path(folder)):
            if options.all or any(name in structure.name for name in options.names):
                for flow_rule in options.flow_rule or FLOW_RULES:
                    measure(structure, flow_rule)


if __name__ == "__main__":
    main(sys.argv[1:])
