"""A wall in the x-z plane as a planar program, made by hand from the spatial one: two components a point."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import scipy.sparse as sp

from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from tests.line import Line


def planar_program(line: Line) -> Program:
    """Forces x, z and moment y of every block; the points on the face y = least, for those behind them too."""
    program = line.program
    points = line.contacts.points
    front = np.flatnonzero(points[:, 1] < points[:, 1].mean())
    in_plane = np.abs(line.contacts.frames[front][:, 1:, 1]).argmin(axis=1)  # the tangent without a part along y
    columns = np.column_stack([3 * front, 3 * front + 1 + in_plane]).ravel()
    rows = (6 * np.arange(len(program.free))[:, None] + np.array([0, 2, 4])).ravel()
    limits = YieldLimits(**{f.name: getattr(program.limits, f.name)[front] for f in fields(YieldLimits)})
    pairs = program.n_points / len(front)
    strengths = replace(
        limits,
        cohesion=pairs * limits.cohesion,
        tension=pairs * limits.tension,
        compression=pairs * limits.compression,
    )
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(program.equilibrium_matrix[rows][:, columns]),
        dead_load=program.dead_load[rows],
        live_load=program.live_load[rows],
        limits=strengths,
        components=2,
    )
