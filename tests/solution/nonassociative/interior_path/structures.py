"""Small structures for the interior scheme, as decks, and hand-made programs with every kind of contact."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from tests.line import BLOCK, line_of

DOME_HEAD = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry, tolerance: 1.e-3}
blocks:
"""
DOME_TAIL = """\
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""

FACES = (
    [[0, 1, 2, 3], [8, 11, 10, 9]]
    + [[s + q, s + 4 + q, s + 4 + (q + 1) % 4, s + (q + 1) % 4] for s in (0, 4) for q in range(4)]
)  # fmt: skip


def dome(rings: int, segments: int, top: float, *, radius: float = 2.0, thickness: float = 0.3) -> str:
    """Hemispherical dome with an oculus, rings in running bond, from the ground up to latitude ``top`` in degrees.

    Every voussoir spans three meridians, so that the faces are planar and the rings above fit half a voussoir on.
    """
    blocks = []
    for ring in range(rings):
        low, high = (math.radians(top) * (ring + i) / rings for i in (0, 1))
        for segment in range(segments):
            corners = []
            for meridian in range(3):
                around = math.pi * (2 * segment + ring % 2 + meridian) / segments
                for side, latitude in ((-1, low), (1, low), (1, high), (-1, high)):
                    r = radius + side * thickness / 2
                    level = r * math.cos(latitude)
                    corners.append([level * math.cos(around), level * math.sin(around), r * math.sin(latitude)])
            blocks.append(f"  - polyhedron: {{material: stone, vertices: {corners}, faces: {FACES}}}\n")
    return DOME_HEAD + "".join(blocks) + DOME_TAIL


def mixed_program(components: int = 3) -> Program:
    """A block on the ground whose four corners obey four laws: dry, cohesive and brittle, crushable, without friction.

    With two components the same in the plane of the push: three rows of equilibrium and one component of shear.
    """
    program = line_of(BLOCK).program
    limits = YieldLimits(
        friction=np.array([0.6, 0.5, 0.7, 0.0]),
        dilatancy=np.zeros(4),
        cohesion=np.array([0.0, 0.3, 0.1, 0.0]),
        tension=np.array([0.0, 0.2, 0.05, 0.0]),
        compression=np.array([np.inf, np.inf, 3.0, np.inf]),
    )
    program = replace(program, limits=limits)
    if components == 3:
        return program
    matrix, rows = program.equilibrium_matrix, np.array([0, 2, 4])  # force along x and z, moment about y
    along = 1 if abs(matrix[0, 1]) > 0.5 else 2
    kept = np.sort(np.concatenate([3 * np.arange(4), 3 * np.arange(4) + along]))
    return replace(
        program,
        equilibrium_matrix=sp.csr_array(sp.csr_array(matrix[rows])[:, kept]),
        dead_load=program.dead_load[rows],
        live_load=program.live_load[rows],
        components=2,
    )
