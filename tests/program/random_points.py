"""Programs of contact points with joint laws of every kind and random statics, and cone programs read row by row."""

from __future__ import annotations

import itertools

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.facts import ModelFacts
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program, Scaling
from mbla.program.yield_conditions import YieldLimits

N_ROWS = 12


def mixed_program(components: int, seed: int) -> Program:
    """A point for each kind of law: with or without friction, cohesion, tension, strength in compression."""
    kinds = [
        (friction, cohesion, tension, compression)
        for friction, cohesion, tension, compression in itertools.product(
            (0.0, 0.5), (0.0, 0.75), (0.0, 0.5), (np.inf, 2.0)
        )
        if friction * tension <= cohesion
    ]
    friction, cohesion, tension, compression = np.array(kinds).T
    n, draw = len(kinds), np.random.default_rng(seed)
    return Program(
        equilibrium_matrix=sp.csr_array(draw.normal(size=(N_ROWS, components * n))),
        dead_load=draw.normal(size=N_ROWS),
        live_load=draw.normal(size=N_ROWS),
        limits=YieldLimits(friction, np.zeros(n), cohesion, tension, compression),
        scaling=Scaling(1.0, 1.0, np.ones(N_ROWS)),
        facts=ModelFacts(free=np.arange(2), n_blocks=2, areas=np.ones(n)),
        components=components,
    )


def random_forces(program: Program, draw: np.random.Generator) -> FloatArray:
    """Forces of which about half are within all limits of their point, (n_points, components)."""
    forces = draw.normal(scale=0.5, size=(program.n_points, program.components))
    forces[:, 0] = draw.uniform(-0.75, 2.5, program.n_points)
    return forces


def slack(form: ConeProgram, x: FloatArray) -> FloatArray:
    """What is left of each row."""
    return np.asarray(form.rhs - form.matrix @ x)


def least_room(form: ConeProgram, x: FloatArray) -> float:
    """Of all half-lines and cones; below zero where one is left."""
    left = slack(form, x)[form.n_equations :]
    assert len(left) == form.n_half_lines + 3 * form.n_cones
    cones = left[form.n_half_lines :].reshape(-1, 3)
    room = np.concatenate([left[: form.n_half_lines], cones[:, 0] - np.hypot(cones[:, 1], cones[:, 2])])
    return float(room.min(initial=np.inf))


def balance(program: Program, forces: FloatArray, factor: float) -> FloatArray:
    """What the equations leave of forces and loads, with the sign of a slack."""
    carried = program.equilibrium_matrix @ forces.ravel()
    return np.asarray(-program.dead_load - carried - factor * program.live_load)
