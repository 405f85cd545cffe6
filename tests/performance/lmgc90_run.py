"""One run of LMGC90, by an interpreter that has compas_lmgc90 (0.1.11) and needs nothing of mbla.

::

    python lmgc90_run.py ANSWER < QUESTION

QUESTION and ANSWER are JSON; LMGC90 writes on standard output. The question:

blocks   : [{vertices, faces}] as ``Solver.geometry_from_v_f`` takes them, m
density  : kg/m³, all or one a block
held     : blocks of the base, whose velocities are given
times    : s, and ``velocities``, of the base, m/s, along x, y, z in turn; linear between them
law      : name in LMGC90, and ``coefficients``: of IQS_CLB the friction, of ELASTIC_REPELL_CLB stiffness of a contact
           point, N/m, and friction
step     : s, and ``steps``, their number
points   : [[block, [x, y, z] as built]]

The answer: ``displacements`` (steps, points, 3), m, relative to the base, ``contacts`` (steps,), how many points,
``seconds`` of the processor for the steps, and ``versions``.

What the package fixes: integration with θ = 1/2, Gauss–Seidel with relaxation 0.1, tolerance 1.666e-4 on the quadratic
norm over 16 (``QM/16``), at most 500 × 50 sweeps; contact points at corners of the common face (detection ``STO``),
searched in each step within 1e-3 m.
"""

from __future__ import annotations

import json
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from compas_lmgc90.solver import Solver

COMPONENTS, ROTATIONS = ("Vx", "Vy", "Vz"), ("Rx", "Ry", "Rz")
THETA = 0.5


def prepared(question: dict[str, Any]) -> Solver:
    """Blocks, law and motion of the base, ready for steps."""
    solver = Solver(dt=question["step"], theta=THETA)
    solver.geometry_from_v_f(question["blocks"], density=question["density"])
    for block in question["held"]:
        for component, velocities in zip(COMPONENTS, question["velocities"], strict=True):
            solver.apply_velocity(block, component, np.array([question["times"], velocities]))
        for component in ROTATIONS:
            solver.apply_velocity(block, component, 0.0)
    solver.contact_law(question["law"], question["coefficients"])
    solver.preprocess()
    return solver


def answered(question: dict[str, Any]) -> dict[str, Any]:
    """All steps."""
    solver = prepared(question)
    centres, frames = np.array(solver.init_coor), np.array(solver.init_frame)
    blocks = np.array([block for block, _ in question["points"]])
    places = np.array([place for _, place in question["points"]])
    base, displacements, contacts, started = question["held"][0], [], [], time.process_time()
    for _ in range(question["steps"]):
        state = solver.lmgc90.compute_one_step()
        moved = np.array(state.bodies)
        turned = np.array(state.body_frames).reshape(-1, 3, 3)  # rows are the axes of a block
        rotations = np.swapaxes(turned[blocks], 1, 2) @ frames[blocks]
        now = moved[blocks] + np.einsum("nij,nj->ni", rotations, places - centres[blocks])
        displacements.append(now - places - (moved[base] - centres[base]))
        contacts.append(len(state.interaction_gap))
    seconds = time.process_time() - started
    versions = " ".join(f"{name} {version(name)}" for name in ("compas_lmgc90", "compas", "numpy"))
    found = np.array(displacements).tolist()
    return {"displacements": found, "contacts": contacts, "seconds": seconds, "versions": versions}


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(json.dumps(answered(json.load(sys.stdin))), encoding="utf-8")
