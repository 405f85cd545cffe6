"""Blocks for the convex contact model, and its answers for a deck."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mbla.program.build import build_program
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.solve import solve
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.line import HEAD, Line, line_of, solution_of

DECKS = Path(__file__).parents[2] / "decks" / "benchmarks" / "closed_forms"

TWIST = (
    HEAD
    + """\
parameters: {mu: 0.6, a: 1.0, h: 0.5, W: "=2000*9.81*a*a*h", e1: 0, e2: 0, c: 0, ft: 0, arm: 0.5}
joints: {dry: {friction: "=mu", cohesion: "=c*W/(a*a)", tensile_strength: "=ft*W/(a*a)"}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: ["=a", "=a", "=h"]}
supports: [{ground: {z: 0}}]
load_cases:
  couple:
    dead: [{gravity: [0, 0, -9.81]}, {force: [0, 0, "=-W"], on: block, at: ["=a/2 + e1", "=a/2 + e2", "=h"]}]
    live:
      - {force: [0, "=W", 0], on: block, at: ["=a", "=a/2", "=h/2"]}
      - {force: [0, "=-W", 0], on: block, at: [0, "=a/2", "=h/2"]}
  push:
    live: [{force: [0, "=W", 0], on: block, at: ["=a/2 + arm*a", "=a/2", 0]}]
analysis: {flow_rule: associative, contact_model: convex}
"""
)
"""Square block twisted by a couple W a under twice its weight W, or pushed along its base at an arm."""

SLAB = (
    HEAD
    + """\
parameters: {fc: 2.e+4}
joints: {dry: {friction: 0.5, compressive_strength: "=fc"}}
blocks:
  - polyhedron: {group: block, material: stone, vertices: VERTICES, faces: FACES}
supports: [{ground: {z: 0}}]
load_cases:
  press:
    dead: [{gravity: none}, {force: [0, 0, -1000], on: block, at: POINT}]
    live: [{force: [0, 0, -1000], on: block, at: POINT}]
analysis: {flow_rule: associative, contact_model: convex}
"""
)
"""A prism without weight, pressed by 1000 N at a point of its top."""


def prism(outline: Sequence[tuple[float, float]], point: Sequence[float]) -> str:
    n = len(outline)
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return SLAB.replace("VERTICES", str(vertices)).replace("FACES", str(faces)).replace("POINT", str([*point, 1]))


def convex(line: Line, flow_rule: str = "associative") -> tuple[Solution, Checks]:
    """Solve and verify with interface resultants."""
    analysis = line.deck.analysis.model_copy(update={"flow_rule": flow_rule, "contact_model": "convex"})
    solution = solve(build_program(line.assembly, line.load_case, analysis), solver_settings(analysis))
    return solution, verify(line.assembly, line.load_case, solution)


def factor(text: str, *overrides: str, case: int = 0, flow_rule: str = "associative") -> float:
    """Load factor of a case that must come out solved and verified."""
    solution, checks = convex(line_of(text, *overrides, case=case), flow_rule)
    assert verified_status(solution, checks) is Status.SOLVED, (solution.status, solution.reason, checks.failures)
    assert solution.mechanics is not None
    return solution.mechanics.load_factor


def concave(line: Line) -> float:
    """By contact points alone."""
    solution = solution_of(line)
    assert solution.associative is not None
    return solution.associative.load_factor
