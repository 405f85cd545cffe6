"""Contact points as stiff as their shares of the area, where an interface has more of them than corners.

Forces that limit analysis leaves open are found by joints on springs (the state under the dead load, standing, steps of
the law), one at every point. Points of a refined interface stand for unlike shares: on a grid one at a corner for a
quarter of one inside. With forces in the unknowns y, x = √s y, equally stiff springs for y are springs of stiffness s
for x, and ½ ‖y‖² is ½ Σ ‖x‖²/s: the sum that goes to the integral over the interface with the square of the distance
of points. s is the share over the mean of the interface, so that its stiffness as a whole stays. The joint law is that
of x; strengths come divided by √s, velocities of the points multiplied.

Where all points are corners of the interface all are equally stiff: a corner stands for a hinge, not for a share. A
refined interface has points along its edges, where its outline goes straight on.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import restricted
from mbla.program.reductions.scene import Scene

ALIKE = 1e-9
"""Relative difference of shares that is rounding."""


def program_by_shares(part: Scene, program: Program) -> Program:
    """A program of the part, reduced or not, in such unknowns; the same one where all its points are alike."""
    share = _shares(part, program)
    if np.all(np.abs(share - 1.0) <= ALIKE):
        return program
    root = np.sqrt(share)
    limits = replace(
        program.limits,
        cohesion=program.limits.cohesion / root,
        tension=program.limits.tension / root,
        compression=program.limits.compression / root,
    )
    rows = sp.eye_array(len(program.dead_load), format="csr")
    forces = sp.diags_array(np.repeat(root, program.components), format="csr")
    by_shares = restricted(program, rows, sp.csr_array(forces), limits, components=program.components)
    return replace(by_shares, guided=program.guided, halved=program.halved)


def _shares(part: Scene, program: Program) -> FloatArray:
    """Stiffness s of every point of the program, mean 1 in each interface, (n_points,).

    With x = P y between the part and its reduction Σ ‖x‖²/a is Σ ‖y‖²/b: b from the normal components is the area that
    a point of the reduction stands for.
    """
    if not part.refined_points.any():
        return np.ones(program.n_points)
    to_part = sp.eye_array(3 * part.program.n_points, format="csr")
    maps, reduced = [], program
    while reduced is not part.program and reduced.reduction is not None:
        maps.append(reduced.reduction.forces)
        reduced = reduced.reduction.full
    for forces in reversed(maps):
        to_part = to_part @ forces
    normals = sp.csc_array(to_part.power(2)[::3, :: program.components])
    area = 1.0 / np.asarray(normals.T @ (1.0 / part.areas))
    interface = part.interfaces[normals.indices[normals.indptr[:-1]]]
    count, total = np.bincount(interface), np.bincount(interface, area)
    share = area * count[interface] / total[interface]
    refined = part.interfaces[part.refined_points]
    return np.asarray(np.where(np.isin(interface, refined), share, 1.0))
