"""Cost of factorising condensed matrices N = A D Aᵀ with each library that is installed; to results/factorization.csv.

::

    python -m tests.performance.bench_factorization [LIBRARY ...]

A is the equilibrium matrix of a running-bond wall, spatial or reduced to its plane, D a random definite block for every
contact point with eigenvalues over sixteen decades. ``analysis`` is what the first factorisation takes beyond the
following ones, all in seconds by the clock; ``residual`` that of one solution without refinement, over the right-hand
side, in the scaling to a diagonal of ones; ``memory_gb`` the most that the process took, with
wall and contacts.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions import allowed_reductions, reduce_program
from mbla.solution.linear_algebra import SymmetricPattern, factorization, installed, lower_triangle
from tests.line import HEAD, line_of
from tests.performance.recording import best_time, record

REGULARIZATION = 1e-10  # share of the diagonal that is added to it

WALL = (
    HEAD
    + """\
parameters: {m: 20, n: 20}
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.175], length: "=0.4*m", courses: "=n"}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)

CASES = {
    "5x5": (5, 5, False),
    "10x10": (10, 10, False),
    "20x20": (20, 20, False),
    "40x25 planar": (40, 25, True),
    "40x25": (40, 25, False),
    "60x60": (60, 60, False),
    "100x100 planar": (100, 100, True),
    "100x100": (100, 100, False),
}
"""Units, courses, whether reduced to the plane."""


def program_of(units: int, courses: int, planar: bool) -> Program:
    """Program of a wall."""
    line = line_of(WALL, f"parameters.m={units}", f"parameters.n={courses}")
    if not planar:
        return line.program
    switches = allowed_reductions(line.deck.analysis)
    return reduce_program(line.model, line.contacts, line.program, switches, associative=True).parts[0]


def condensed(program: Program) -> tuple[SymmetricPattern, FloatArray]:
    """N with random definite blocks."""
    rng, size = np.random.default_rng(3), program.components
    turned, _ = np.linalg.qr(rng.standard_normal((program.n_points, size, size)))
    blocks = (turned * 10.0 ** rng.uniform(-8, 8, (program.n_points, 1, size))) @ turned.transpose(0, 2, 1)
    each = np.arange(program.n_points + 1)
    matrix = program.equilibrium_matrix
    normal = sp.csc_array(matrix @ sp.csr_array(sp.bsr_array((blocks, each[:-1], each))) @ matrix.T)
    return lower_triangle(sp.csc_array(normal + sp.diags_array(REGULARIZATION * normal.diagonal())))


@dataclass(frozen=True)
class Cost:
    """Seconds, and the relative residual of one solution."""

    analysis: float
    factorization: float
    solution: float
    residual: float


def cost_of(library: str, pattern: SymmetricPattern, values: FloatArray) -> Cost:
    """Time a library; the right-hand side belongs to a random solution."""
    matrix = pattern.matrix(values)
    rhs = matrix @ np.random.default_rng(4).standard_normal(pattern.n)
    size = np.sqrt(matrix.diagonal())
    start = time.perf_counter()
    factors = factorization(pattern, library)
    assert factors.factorize(values)
    first = time.perf_counter() - start
    again = best_time(lambda: factors.factorize(values))[0]
    residual = np.linalg.norm((matrix @ factors.solve(rhs) - rhs) / size) / np.linalg.norm(rhs / size)
    return Cost(max(first - again, 0.0), again, best_time(lambda: factors.solve(rhs))[0], float(residual))


def measure(library: str) -> None:
    """Measure all cases with a library."""
    factorization(lower_triangle(sp.eye_array(3, format="csc"))[0], library)  # what loading takes is no analysis
    for name, case in CASES.items():
        pattern, values = condensed(program_of(*case))
        cost = cost_of(library, pattern, values)
        row = {"case": name, "unknowns": pattern.n, "entries": len(values), "library": library}
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        record("factorization", row | vars(cost) | {"memory_gb": memory})


def main(libraries: list[str]) -> None:
    """Each library in a process of its own, so that memory is told apart."""
    if len(libraries) == 1:
        measure(libraries[0])
        return
    for library in libraries or installed():
        subprocess.run([sys.executable, "-m", "tests.performance.bench_factorization", library], check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
