"""Walls of Ferris and Tin-Loi 2001 (Int. J. Mech. Sci. 43, 209-224), and what the default scheme makes of a program.

Without dilatancy a structure has many load factors, and these walls have been searched for low ones by several methods:
``LEAST`` are the least states of the exact law that any of them found.
"""

from __future__ import annotations

import numpy as np
from mbla.solution.nonassociative.default_scheme import solve_by_default

from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.refine_equilibrium import sharpened
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import HEAD

SETTINGS = SolverSettings(tolerance=1e-8)


def opening(length: float, courses: str, *openings: str) -> str:
    """A running-bond wall with openings."""
    wall = f"{{material: stone, unit: [0.4, 0.2, 0.175], length: {length}, courses: {courses}"
    return HEAD + (
        "joints: {dry: {friction: 0.65}}\n"
        f"blocks: [{{wall: {wall}, openings: [{', '.join(openings)}]}}}}]\n"
        "supports: [{ground: {z: 0}}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
    )


FERRIS_1 = opening(2.0, "6, start: half")
FERRIS_3 = opening(1.6, "11", "{from: [0.6, 0.525], to: [1.0, 1.4]}")
FERRIS_5 = opening(
    1.2, "19, start: half", "{from: [0.4, 0.525], to: [0.8, 1.4]}", "{from: [0.4, 1.925], to: [0.8, 2.8]}"
)
LEAST = {FERRIS_1: 0.638982, FERRIS_3: 0.355817, FERRIS_5: 0.207973}


def sequence_of(program: Program, settings: SolverSettings = SETTINGS) -> SequenceResult:
    """What the default scheme finds without dilatancy, sharpened as it is in every run."""
    associative = solve_associative(program, settings, lambda record: None)
    none = np.zeros(program.n_points)
    found = solve_by_default(program, associative, none, settings, lambda record: None)
    return sharpened(program, associative, none, found)


def solved(program: Program, settings: SolverSettings = SETTINGS) -> LawState:
    """Its state, which must fit the law."""
    sequence = sequence_of(program, settings)
    assert sequence.status is Status.SOLVED, sequence.reason
    assert sequence.state is not None
    return sequence.state
