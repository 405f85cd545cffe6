"""Walls of Ferris and Tin-Loi 2001 (Int. J. Mech. Sci. 43, 209-224), and what path and search make of a program.

Without dilatancy a structure has many load factors, and these walls have been searched for low ones by several methods:
``LEAST`` are the least states of the exact law that any of them found.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.nonassociative.collapse_state import CollapseState, FlowResult
from mbla.solution.nonassociative.elastic import solve_by_elastic_path
from mbla.solution.nonassociative.least_found import least_found
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord
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


def groove(friction: float, slope: float) -> str:
    """Prism in a groove of two planes inclined at ``slope``, pushed along it."""
    t, s, c = math.tan(slope), math.sin(slope), math.cos(slope)
    return HEAD + (
        f"joints: {{dry: {{friction: {friction!r}}}}}\n"
        "blocks:\n"
        "  - polyhedron:\n"
        "      material: stone\n"
        f"      vertices: [[0, 0, 0], [4, 0, 0], [0, -1, {t!r}], [0, 1, {t!r}], [4, -1, {t!r}], [4, 1, {t!r}]]\n"
        "      faces: [[0, 2, 3], [1, 4, 5], [0, 1, 4, 2], [0, 1, 5, 3], [2, 3, 5, 4]]\n"
        "supports:\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {s!r}, {c!r}]}}\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {-s!r}, {c!r}]}}\n"
        "load_cases: {along: {live: [{acceleration: [1, 0, 0]}]}}\n"
    )


def in_the_groove(friction: float, slope: float, rise: float) -> float:
    """Load factor of a prism that lifts by ``rise``, a tangent, of its sliding on each plane of its groove.

    Velocity 1 along and w upwards: on each plane v_N = w cos b, s = sqrt(1 + w^2 sin^2 b), with v_N = tan(psi) s::

        w^2 (cos^2 b - tan^2 psi sin^2 b) = tan^2 psi.

    Friction mu N against (1, w sin b)/s; with the weight W, 2 N (cos b - mu w sin^2 b/s) = W and 2 mu N/s = load:

        load factor = mu / (s cos b - mu w sin^2 b),

    mu / cos b at psi = 0 and mu / sqrt(cos^2 b - mu^2 sin^2 b) at the friction angle.
    """
    w = rise / math.sqrt(math.cos(slope) ** 2 - (rise * math.sin(slope)) ** 2)
    s = math.hypot(1.0, w * math.sin(slope))
    return friction / (s * math.cos(slope) - friction * w * math.sin(slope) ** 2)


def with_share(program: Program, share: float) -> Program:
    """The program with a dilatancy angle that is a share of the friction angle at every joint."""
    limits = program.limits
    rise = np.tan(share * np.arctan(limits.friction)) * np.ones(program.n_points)
    return replace(program, limits=replace(limits, dilatancy=rise))


def unbalanced(program: Program, state: CollapseState) -> float:
    """Largest unbalanced force of a state, in mean block loads."""
    loads = program.dead_load + state.load_factor * program.live_load
    return float(np.abs(program.equilibrium_matrix @ state.forces.ravel() + loads).max(initial=0.0))


def associative_of(program: Program, settings: SolverSettings = SETTINGS) -> AssociativeResult:
    return solve_associative(program, settings, lambda record: None)


def by_path(
    program: Program, slope: FloatArray | float = 0.0, settings: SolverSettings = SETTINGS
) -> tuple[float, FlowResult]:
    """Greatest load factor on the path of elastic joints, and what is said of it; nan where there is none.

    slope : tangent of the dilatancy angle
    """
    slopes = slope * np.ones(program.n_points)
    found = solve_by_elastic_path(program, associative_of(program, settings), slopes, settings, lambda record: None)
    return np.nan if found.state is None else program.scaling.load_factor(found.state.load_factor), found


def least_of(
    program: Program,
    slope: FloatArray | float = 0.0,
    settings: SolverSettings = SETTINGS,
    records: list[ProgramRecord] | None = None,
) -> CollapseState:
    """The least state of rigid joints that the search finds from the path."""
    slopes = slope * np.ones(program.n_points)
    associative, (_, path) = associative_of(program, settings), by_path(program, slope, settings)
    assert path.state is not None, path.reason
    to = [] if records is None else records
    least = least_found(program, slopes, path.state, associative, settings, lambda record: None, to)
    assert least is not None
    return least
