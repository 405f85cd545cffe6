"""The modes of a structure at rest under its dead load."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_blocks
from mbla.assembly.structure_at import StructureAt
from mbla.model.solids.blocks import Blocks
from mbla.process.stopwatch import stage
from mbla.solution.linear_algebra.superlu import factorize
from mbla.solution.modes.eigenpairs import Eigenpairs, apart, least_eigenpairs
from mbla.solution.modes.modes import Modes
from mbla.solution.modes.rest import Rest, at_rest
from mbla.solution.modes.vibrating import Vibrating, vibrating

FREE = "joints hold nothing that moves: there is nothing that vibrates"

ROUNDING = 1e-12
"""Share of the mass that is none: 1e-26 and less is left by rounding."""

MOVES = 1e-6
"""Motion of a block over the greatest, in a motion without stiffness, from which joints do not hold it."""


@stage("modes")
def modes_of(there: StructureAt, count: int) -> Modes:
    """So many modes by falling period, or fewer where there are no more; none, and why, where it does not stand."""
    rest = at_rest(there)
    return Modes(reason=rest) if isinstance(rest, str) else modes_at(there.assembly, rest, count)


def modes_at(assembly: Assembly, rest: Rest, count: int) -> Modes:
    """Of a structure at rest."""
    parts = vibrating(assembly, rest)
    ways, free = parts.ways, rest.bodies.model.free
    stiffness, masses = (sp.csr_array(ways.T @ each @ ways) for each in (parts.stiffness, parts.masses))
    pairs = least_eigenpairs(stiffness, masses, count)
    rigid = np.tile(np.eye(6)[:, :3], (len(free), 1))
    feels = np.asarray(ways.T @ (parts.masses @ rigid))
    whole = _whole(masses, feels)
    vectors = _turned(pairs, feels)[:, :count]
    shapes = _on_blocks(rest, parts, vectors)
    n = rest.bodies.contacts.n_surfaces
    return Modes(
        periods=2.0 * np.pi / np.sqrt(pairs.squares[:count]),
        shapes=_scaled(assembly.model.blocks, shapes),
        masses=_shares((vectors.T @ feels) ** 2, whole),
        moving=whole / rest.bodies.model.units.force_per_mass_acceleration,
        default=rest.default,
        stiffness=rest.stiffness[:n],
        pressed=parts.pressed,
        settlement=motions_of_blocks(rest.bodies, rest.settlement),
        loose=_moves(assembly.model.blocks, _on_blocks(rest, parts, pairs.loose)),
        slack=parts.slack,
        reason="" if len(shapes) else FREE,
    )


def _whole(masses: sp.csr_array, feels: FloatArray) -> FloatArray:
    """Mass that takes part in all modes together, (3,): all that moves, less what guides keep from moving that way."""
    solve = factorize(masses)
    assert solve is not None  # every block has a mass
    return np.asarray((feels * np.column_stack([solve(each) for each in feels.T])).sum(axis=0))


def _shares(masses: FloatArray, whole: FloatArray) -> FloatArray:
    """Masses that take part, (n, 3), over the whole, (3,); nothing where they are that but for rounding."""
    shares = masses / np.where(whole > 0.0, whole, 1.0)
    return np.where(shares > ROUNDING, shares, 0.0)


def _turned(pairs: Eigenpairs, feels: FloatArray) -> FloatArray:
    """Vectors, those of one frequency turned: the first has all mass along x, the second what is left along y, ...

    The mass that takes part most is on the positive side.
    """
    vectors = pairs.vectors.copy()
    for own in apart(pairs.squares):
        if own.stop - own.start > 1:
            turn, _ = np.linalg.qr(vectors[:, own].T @ feels, mode="complete")
            vectors[:, own] = vectors[:, own] @ turn
    along = vectors.T @ feels
    most = np.take_along_axis(along, np.abs(along).argmax(axis=1)[:, None], axis=1)[:, 0]
    return np.asarray(vectors * np.where(most < 0.0, -1.0, 1.0))


def _on_blocks(rest: Rest, parts: Vibrating, vectors: FloatArray) -> FloatArray:
    """Motions of the blocks, (n, n_blocks, 6), from those of what vibrates, (n_unknowns, n)."""
    bodies = rest.bodies
    found = []
    for vector in vectors.T:
        motions = np.zeros((len(bodies.model.blocks), 6))
        motions[bodies.model.free] = (parts.ways @ vector).reshape(-1, 6)
        found.append(motions_of_blocks(bodies, motions))
    return np.array(found).reshape(-1, len(bodies.label), 6)


def _reach(blocks: Blocks, motions: FloatArray) -> FloatArray:
    """Greatest displacement of a corner of each block, (n_blocks,), by motions (n_blocks, 6)."""
    owner = blocks.block_of_vertex
    own = motions[owner]
    moved = own[:, :3] + np.cross(own[:, 3:], blocks.vertices - blocks.centroids[owner])
    return np.asarray(np.maximum.reduceat(np.linalg.norm(moved, axis=1), blocks.vertex_start[:-1]))


def _scaled(blocks: Blocks, shapes: FloatArray) -> FloatArray:
    """Shapes in which the corner that goes furthest goes 1."""
    if not len(shapes):
        return shapes
    return np.asarray(shapes / np.array([_reach(blocks, shape).max() for shape in shapes])[:, None, None])


def _moves(blocks: Blocks, motions: FloatArray) -> BoolArray:
    """Which blocks move in any of some motions, (n_blocks,)."""
    found = np.zeros(len(blocks), dtype=bool)
    for motion in motions:
        reach = _reach(blocks, motion)
        found |= reach > MOVES * reach.max()
    return found
