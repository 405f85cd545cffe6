"""Vectors inside cones by a distance that is given; cone programs, random, small and of walls, and what holds them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.line import WALL, line_of


def vector_of(rng: np.random.Generator, product: ConeProduct) -> FloatArray:
    """Any vector."""
    return np.asarray(rng.normal(size=product.size))


def inside(rng: np.random.Generator, product: ConeProduct, distance: float) -> FloatArray:
    """A vector whose half-lines, and whose heads over their tails, are ``distance`` to three times that inside."""
    v = vector_of(rng, product)
    room = distance * rng.uniform(1.0, 3.0, product.degree)
    v[: product.n_lines] = room[: product.n_lines]
    cones = product.cones(v)
    cones[0] = np.hypot(cones[1], cones[2]) + room[product.n_lines :]
    return v


@dataclass(frozen=True)
class Known:
    """A cone program made around a solution, x and z, which is thereby known."""

    program: ConeProgram
    x: FloatArray
    z: FloatArray

    @property
    def optimum(self) -> float:
        """c·x + ½ Σ q x²."""
        quadratic = np.zeros_like(self.x) if self.program.quadratic is None else self.program.quadratic
        return float(self.program.cost @ self.x + 0.5 * quadratic @ self.x**2)


def complementary(rng: np.random.Generator, product: ConeProduct) -> tuple[FloatArray, FloatArray]:
    """Two vectors s, z with s ∘ z = 0 and s + z inside: of each half-line and cone, both or one on the border."""
    s, z = np.zeros(product.size), np.zeros(product.size)
    size = rng.uniform(0.5, 2.0, (2, product.n_lines))
    first = rng.random(product.n_lines) < 0.5
    s[: product.n_lines], z[: product.n_lines] = np.where(first, size[0], 0.0), np.where(first, 0.0, size[1])
    angle, kind = rng.uniform(0.0, 2.0 * np.pi, product.n_cones), rng.integers(0, 3, product.n_cones)
    ray = np.stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    deep = np.stack([np.full_like(angle, 1.5), np.cos(angle), np.sin(angle)])
    opposite = ray * np.array([1.0, -1.0, -1.0])[:, None]
    product.cones(s)[:] = np.where(kind == 0, ray, np.where(kind == 1, deep, 0.0)) * rng.uniform(0.5, 2.0, len(angle))
    product.cones(z)[:] = np.where(kind == 0, opposite, np.where(kind == 2, deep, 0.0))
    return s, z


def program_order(product: ConeProduct) -> np.ndarray:
    """Component of a vector of ``product`` at each row of a cone program, where cones stand one after the other."""
    heads = product.n_lines + np.arange(product.n_cones)
    places = np.column_stack([heads + j * product.n_cones for j in range(3)]).ravel()
    return np.concatenate([np.arange(product.n_lines), places]).astype(np.int64)


def known_program(rng: np.random.Generator, n: int, n_equations: int, product: ConeProduct, quadratic: bool) -> Known:
    """A random program with few equations and a solution that is known; half of the entries of its matrix are zero."""
    s, z = complementary(rng, product)
    x, y = rng.normal(size=n), rng.normal(size=n_equations)
    g = rng.normal(size=(product.size, n)) * (rng.random((product.size, n)) < 0.5)
    g[rng.integers(0, product.size, n), np.arange(n)] += 1.0
    e = rng.normal(size=(n_equations, n))
    q = rng.uniform(0.0, 2.0, n) * (rng.random(n) < 0.7) if quadratic else None
    bent = np.zeros(n) if q is None else q * x
    order = program_order(product)
    program = ConeProgram(
        cost=-bent - e.T @ y - g.T @ z,
        matrix=sp.csc_array(np.vstack([e, g[order]])),
        rhs=np.concatenate([e @ x, (g @ x + s)[order]]),
        n_half_lines=product.n_lines,
        n_cones=product.n_cones,
        n_equations=n_equations,
        quadratic=q,
    )
    return Known(program, x, np.concatenate([y, z[order]]))


def held(program: ConeProgram, log: list[IterationRecord] | None = None, **changed: object) -> CondensedProgram:
    records: list[IterationRecord] = [] if log is None else log
    asked = replace(SolverSettings(1e-9, solver="mbla", cholesky="qdldl"), **changed)  # type: ignore[arg-type]
    return CondensedProgram(program, asked, records.append)


def wall(*overrides: str) -> ConeProgram:
    line = line_of(WALL, *overrides)
    return kinematic_form(line.program, line.program.limits).cone_program


def small(cost: list[float], rows: list[list[float]], rhs: list[float], lines: int, cones: int = 0) -> ConeProgram:
    """One equation, then half-lines, then cones."""
    return ConeProgram(np.array(cost), sp.csc_array(np.array(rows)), np.array(rhs), lines, cones)


def least_in_cones(program: ConeProgram, v: np.ndarray) -> float:
    """Least of v on half-lines and of heads over tails."""
    cones = ConeVectors.of(program)
    return float((v[cones.head] - cones.tails(v)).min())
