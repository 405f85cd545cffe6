"""Size of the program with conditions on interfaces, as reductions count those of contact points."""

from __future__ import annotations

import numpy as np

from mbla.program.convex.assemble import ConvexProgram
from mbla.program.reductions.steps import ProgramSize


def size_of_convex(convex: ConvexProgram) -> ProgramSize:
    """Unknowns of the conditions are velocities too, and their cones count beside the friction cones of the points."""
    program = convex.program
    unknowns = len(program.dead_load)
    conditions = sum(int(np.count_nonzero(rows.cone_sizes > 1)) for rows in convex.conditions)
    return ProgramSize(
        unknowns=unknowns,
        cones=program.n_points + conditions,
        entries=int(program.equilibrium_matrix.nnz),
        largest=unknowns,
    )
