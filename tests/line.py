"""The line from deck to solution for tests: small decks as text, and what each stage makes of them."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from mbla.assembly import Assembly, build_assembly
from mbla.contacts import Contacts, find_contacts
from mbla.deck import Deck, read_deck
from mbla.model import Model, build_model
from mbla.model.model import LoadCase
from mbla.program import Program, assemble
from mbla.program.reductions import ModelSize, Reduced, allowed_reductions, reduce_program
from mbla.results.provenance import with_loads_found
from mbla.results.results import CaseResult
from mbla.results.status_file import StatusFile
from mbla.run import solve_case
from mbla.solution.proof.claim import with_proof
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.solve import solve_parts
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status

HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
contacts: {joint: dry}
"""

BLOCK = (
    HEAD
    + """\
parameters: {mu: 0.5, b: 1, h: 2, c: 0, ft: 0}
joints: {dry: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, "=h"]}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)
"""One block on the ground, pushed by its weight times the load factor."""

WALL = (
    HEAD
    + """\
parameters: {mu: 0.65, n: 5}
joints: {dry: {friction: "=mu"}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: "=0.4*n", courses: "=n"}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)
"""Running-bond wall on the ground, n units long and n courses high."""


@dataclass(frozen=True)
class Line:
    """Everything up to the program of the first load case."""

    deck: Deck
    model: Model
    contacts: Contacts
    load_case: LoadCase
    program: Program

    @property
    def assembly(self) -> Assembly:
        """Of model and contacts, as they are."""
        return Assembly(self.model, self.contacts)


def unreduced(program: Program, contacts: Contacts) -> Reduced:
    """The program as it is."""
    size = ModelSize(3, 0, 1, len(program.facts.free), program.n_points, 0)
    return Reduced((program,), size, contacts.interface_of_point)


def line_of(text: str, *overrides: str, case: int = 0) -> Line:
    """Read, build, find contacts, assemble."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(text, encoding="utf-8")
        return line_of_file(path, *overrides, case=case)


def line_of_file(path: Path, *overrides: str, case: int = 0) -> Line:
    """The same for a deck on the disk, which may name other files."""
    deck = read_deck(path, overrides)
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    load_case = model.load_cases[case]
    return Line(deck, model, contacts, load_case, assemble(model, contacts, load_case))


def solution_of(line: Line) -> Solution:
    """Solve without verification."""
    analysis = line.deck.analysis
    associative = analysis.flow_rule == "associative"
    reduced = reduce_program(
        line.model, line.contacts, line.program, allowed_reductions(analysis), associative=associative
    )
    solution = solve_parts(reduced, solver_settings(analysis))
    return with_proof(line.model, line.contacts, line.load_case, solution)


def verified(line: Line) -> tuple[Solution, Checks, Status]:
    """Solve and verify."""
    solution = solution_of(line)
    checks = verify(line.assembly, line.load_case, solution)
    return solution, checks, verified_status(solution, checks)


def load_factor(text: str, *overrides: str, case: int = 0) -> float:
    """Load factor of a deck whose case must come out solved and verified."""
    solution, checks, status = verified(line_of(text, *overrides, case=case))
    assert status is Status.SOLVED, (status, solution.reason, checks.failures)
    assert solution.mechanics is not None
    return solution.mechanics.load_factor


def case_of(text: str, *overrides: str, case: int = 0) -> tuple[Model, CaseResult]:
    """A load case as ``mbla run`` solves it: any contact model, glued blocks as one."""
    assembly, (solved,) = cases_of(text, *overrides, chosen=slice(case, case + 1))
    return assembly.model, solved


def cases_of(text: str, *overrides: str, chosen: slice = slice(None)) -> tuple[Assembly, tuple[CaseResult, ...]]:
    """Several load cases in the same way, with their assembly."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(text, encoding="utf-8")
        deck = read_deck(path, overrides)
        model = build_model(deck)
        assembly = build_assembly(deck, model)
        settings, status_file = solver_settings(deck.analysis), StatusFile(io.StringIO(), "test")
        solved = tuple(
            solve_case(deck, assembly, each, settings, status_file, None) for each in model.load_cases[chosen]
        )
        return with_loads_found(assembly, solved), solved


def factor_of(text: str, *overrides: str, case: int = 0) -> float:
    """Its load factor; it must come out solved and verified."""
    _, result = case_of(text, *overrides, case=case)
    assert result.status is Status.SOLVED, (result.status, result.solution.reason, result.checks.failures)
    assert result.solution.mechanics is not None
    return result.solution.mechanics.load_factor
