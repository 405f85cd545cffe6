"""Ties for ParaView: their stretches as lines, strips and fill as vertices where they act."""

from __future__ import annotations

import numpy as np

from mbla.model.ties.ties import OUTSIDE
from mbla.results.collapse.motion import moved_points
from mbla.results.collapse.ties import TieState, tie_rows
from mbla.results.record.scene import FIGURES, Scene
from mbla.results.vtu.meshes import Mesh

STATES = (TieState.HOLDS, TieState.YIELDS, TieState.SLACK, TieState.PASSIVE, TieState.ACTIVE)
"""in the order of their numbers in files"""


def ties_mesh(scene: Scene) -> Mesh | None:
    """All ties of a model; None without any."""
    ties = scene.model.ties
    if not len(ties):
        return None
    rows = tie_rows(scene.model, scene.mechanics)
    stretches, on = ties.stretches, ties.bodies != OUTSIDE
    owner = ties.tie_of_point[stretches[:, 0]]
    moved = ties.places.copy()
    moved[on] = moved_points(scene.model.blocks, scene.motion, ties.bodies[on], ties.places[on])
    crosses = (ties.places[stretches[:, 0]] == ties.places[stretches[:, 1]]).all(axis=1)
    lines, dots = np.flatnonzero(~crosses), np.flatnonzero(crosses)
    data = {
        "tie": owner,
        "least": ties.least[owner],
        "greatest": ties.greatest[owner],
        "prestress": ties.prestress[owner],
    }
    if scene.mechanics is not None and scene.mechanics.tie_forces is not None:
        states = np.array([STATES.index(row.state) for row in rows])
        data |= {
            "tie_forces": np.array([row.force for row in rows])[owner],
            "tie_rates": np.array([row.rate for row in rows])[owner],
            "use": np.array([row.use for row in rows])[owner],
            "state": states[owner],
            "figures": np.full(len(owner), FIGURES.index(scene.figures)),
        }
    cells = [("line", stretches[lines], lines), ("vertex", stretches[dots, :1], dots)]
    return Mesh(ties.places, cells, {"displacement": moved - ties.places}, data)
