"""Programs, states and answers small enough that everything about them is known without a solver."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.facts import ModelFacts
from mbla.program.program import Program, Scaling
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.solution import Checks, Mechanics, Solution, Status
from mbla.solution.verification.residuals import Residuals
from tests.line import BLOCK, Line, line_of

EXACT = Residuals(
    equilibrium=0.0,
    yielding=0.0,
    tension=0.0,
    penetration=0.0,
    complementarity=0.0,
    slip=0.0,
    live_power=1.0,
    power_balance=0.0,
)
"""What a right answer leaves."""

NO_LOAD = np.zeros((1, 6))


def limits_of(
    n_points: int,
    friction: float = 0.0,
    cohesion: float | Sequence[float] = 0.0,
    tension: float | Sequence[float] = 0.0,
    compression: float | Sequence[float] = np.inf,
    dilatancy: float = 0.0,
) -> YieldLimits:
    """The same at all points but where a sequence is given."""
    values = (friction, dilatancy, cohesion, tension, compression)
    return YieldLimits(*(np.broadcast_to(np.asarray(value, dtype=float), n_points).copy() for value in values))


def own_points(dead: Sequence[float], live: Sequence[float], components: Any = 2, **limits: Any) -> Program:
    """Bodies that rest each on one contact point of their own: velocities of rows are those of the points."""
    n_rows = len(dead)
    n = n_rows // components
    return Program(
        equilibrium_matrix=sp.csr_array(sp.eye_array(n_rows, format="csr")),
        dead_load=np.array(dead, dtype=float),
        live_load=np.array(live, dtype=float),
        limits=limits_of(n, **limits),
        scaling=Scaling(1.0, 1.0, np.ones(n_rows)),
        facts=ModelFacts(free=np.arange(n), n_blocks=n, areas=np.ones(n)),
        components=components,
    )


def cube(joint: str = "friction: 0.5", supports: str = "{ground: {z: 0}}") -> Line:
    """A block 1 x 1 x 0.5 on the ground."""
    text = BLOCK.replace('friction: "=mu", cohesion: "=c", tensile_strength: "=ft"', joint)
    return line_of(text.replace("{ground: {z: 0}}", supports), "parameters.h=0.5")


def loaded(case: LoadCase, dead: Sequence[float], live: Sequence[float]) -> LoadCase:
    """The case with these loads on its one block."""
    return replace(case, dead_load=np.array([dead], dtype=float), live_load=np.array([live], dtype=float))


DEAD, LIVE, RISES = (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, -2, 0), (0.125, 0, 0.0625, 0, 0, 0)


def pushed_block(joint: str = "friction: 0.5") -> Line:
    """The block with a weight of 32 and a push of 8 λ at its base: it slides and rises by μ."""
    line = cube(joint)
    return replace(line, load_case=loaded(line.load_case, DEAD, LIVE))


def on_ground(model: Model, contacts: Contacts, pressed: Sequence[float]) -> FloatArray:
    """Forces at the corners below a block, N and the force on the block along x and y, the same at each corner."""
    sign = np.where(contacts.bodies[contacts.interface_of_point][:, 1] < len(model.blocks), 1.0, -1.0)
    on_block = sign[:, None] * np.array([pressed[1], pressed[2], 0.0])
    forces: FloatArray = np.einsum("pjx,px->pj", contacts.frames, on_block)
    forces[:, 0] = pressed[0]
    return forces


def state(forces: FloatArray, mechanism: FloatArray, load_factor: float) -> Mechanics:
    """Forces and velocities; what follows from them is left out."""
    return Mechanics(load_factor, forces, np.zeros_like(forces), mechanism, np.zeros(len(forces), dtype=np.int64))


def claim(mechanics: Mechanics | None, status: Status = Status.SOLVED, **changes: Any) -> Solution:
    """A solution that claims this state, by associative flow unless said otherwise."""
    given: dict[str, Any] = {"flow_rule": "associative", "associative": mechanics, "certificate": None, "reason": ""}
    given |= {"programs": (), "iterations": (), "seconds": 0.0} | changes
    return Solution(status=status, mechanics=mechanics, **given)


def found(**changes: Any) -> Checks:
    """What verification finds of a right answer of load factor 1, but for the changes."""
    given: dict[str, Any] = {
        "equilibrium_residual": 0.0,
        "yield_violation": 0.0,
        "penetration": 0.0,
        "complementarity_residual": 0.0,
        "live_power": 1.0,
        "power_balance": 0.0,
        "static_bound": 1.0,
        "kinematic_bound": 1.0,
        "gap": 0.0,
        "verified": True,
        "failures": (),
    }
    return Checks(**(given | changes))
