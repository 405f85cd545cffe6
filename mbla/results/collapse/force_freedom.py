"""How far equilibrium determines the forces, and whether there are hinges and slides enough for a mechanism.

The mechanism says what a contact point may carry at its load factor: nothing where it opens, a force of one direction
(n − μ t, with t the direction of sliding) where it slides, any force where it rests. What one interface carries counts
by its resultant, as the points of one face are redundant among themselves: the space of its resultants has dimension
r_i ≤ 6 (3 in a plane). Equilibrium of the free blocks, A x = 0 for a change x of the resultants, leaves::

    degree = Σ r_i − rank A

ways to vary. Strength limits may forbid some of them, so that it is an upper limit; 0 means unique. By associative
flow that covers all forces at the load factor, whichever mechanism they are taken with (complementary slackness); else
those that fit this mechanism. A resultant that no null vector of A touches is determined; one random null vector shows
all of them, but for a set of measure zero.

The rank is counted by Sylvester's law of inertia in the factors of A Aᵀ − εI, with ε on both sides of a gap: where the
two disagree it is not determined.

Fix every block that is at rest in the mechanism. Forces that balance the structure balance the moving blocks too, so
that the load factor of the smaller model is no less; and the mechanism, in which nothing else moves, is one of the
smaller model with the same power, so that by the kinematic theorem it is no more. By associative flow both models have
one and the same load factor. A resting block that touches no moving one then takes no part at all and can be left out.

Without normality there are no bounds, but forces and mechanism together fit the law at every interface that is left:
the state found is one of the smaller model, whose load factors may reach further, lower ones among them, because fewer
conditions are left.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.results.collapse.collapse import kept
from mbla.results.collapse.interface_modes import interface_radii
from mbla.solution.linear_algebra.pattern import lower_triangle
from mbla.solution.linear_algebra.qdldl_factors import QdldlFactors
from mbla.solution.solution import ContactMode, Mechanics

MOST_EQUATIONS = 12_000
"""of equilibrium: 2,000 blocks in space, a few seconds"""
BELOW, ABOVE = 1e-11, 1e-7
"""eigenvalues of A Aᵀ with the rows of each block of unit length in the mean: zero up to the first, not zero from the
second on"""
FLAT = 1e-4
"""share of the largest extent of directions up to which they do not leave a plane"""
NO_RESULTANT = 1e-9
"""share of the largest eigenvalue of an interface up to which its points have no such resultant"""
UNTOUCHED = 1e-6
"""share of a random null vector up to which an interface has no part in it"""


@dataclass(frozen=True)
class ForceFreedom:
    """degree : of static indeterminacy at the load factor, at most; 0 where forces are unique
    determined : (n_interfaces,) whose resultant is unique
    """

    degree: int
    determined: BoolArray


@kept
def force_freedom(bodies: RigidBodies, mechanics: Mechanics, dimension: int) -> ForceFreedom | str:
    """How far the forces may vary; where that is not determined, why, in words that follow ``as``.

    dimension : in which the case was solved, 2 or 3
    """
    model, contacts = bodies.model, bodies.contacts
    if reason := _not_of_these(model):
        return reason
    if not len(contacts):
        return "there are no contacts"
    rows = _plane_rows(contacts, mechanics.mechanism) if dimension == 2 else np.eye(6)
    if rows is None:
        return "the plane of the structure is not clear"
    equations = len(rows) * len(model.free)
    if equations > MOST_EQUATIONS:
        return f"it takes more than {MOST_EQUATIONS} equations of equilibrium, {equations}"
    bases, owner = _resultants(model, contacts, mechanics, rows)
    matrix = _equilibrium(model, contacts, bases, owner, rows)
    return _freedom(matrix, owner, len(contacts)) or "the rank of the equations of equilibrium is not clear"


def _not_of_these(model: Model) -> str:
    """What holds blocks by other than contacts, whose forces are not among those counted."""
    if len(model.guides.blocks):
        return "blocks are guided, as those of a support that gives way are"
    if len(model.ties):
        return "ties hold blocks"
    return "planes of symmetry hold blocks" if model.mirrors else ""


def _plane_rows(contacts: Contacts, mechanism: FloatArray) -> FloatArray | None:
    """Both forces in the plane and the moment about its normal, as rows (3, 6); None where the plane is not clear.

    It holds the normals of the interfaces and the velocities of the blocks.
    """
    speeds = np.linalg.norm(mechanism[:, :3], axis=1)
    velocities = mechanism[:, :3] / (float(speeds.max(initial=0.0)) or 1.0)
    _, sizes, axes = np.linalg.svd(np.vstack([contacts.normals, velocities, np.zeros((3, 3))]), full_matrices=False)
    if sizes[2] > FLAT * sizes[0] or sizes[1] <= FLAT * sizes[0]:
        return None
    rows = np.zeros((3, 6))
    rows[:2, :3], rows[2, 3:] = axes[:2], axes[2]
    return rows


def _resultants(model: Model, contacts: Contacts, mechanics: Mechanics, rows: FloatArray) -> tuple[FloatArray, Any]:
    """Orthonormal resultants that each interface may carry, (n, 6) with moments over its radius, and whose they are."""
    arms = contacts.points - contacts.centroids[contacts.interface_of_point]
    size = np.where(interface_radii(contacts) > 0, interface_radii(contacts), 1.0)
    of_point = contacts.interface_of_point
    spread = np.zeros((len(contacts), len(rows), len(rows)))
    for directions, chosen in _directions(model, contacts, mechanics):
        force = np.einsum("pi,pij->pj", directions, contacts.frames[chosen])
        moment = np.cross(arms[chosen], force) / size[of_point[chosen], None]
        wrench = np.hstack([force, moment]) @ rows.T
        np.add.at(spread, of_point[chosen], wrench[:, :, None] * wrench[:, None, :])
    values, vectors = np.linalg.eigh(spread)
    owner, column = np.nonzero(values > NO_RESULTANT * np.maximum(values[:, -1:], 1e-300))
    return vectors[owner, :, column] @ rows, owner


def _directions(model: Model, contacts: Contacts, mechanics: Mechanics) -> list[tuple[FloatArray, Any]]:
    """Directions of force in the frames of points, (n, 3), and the points that may carry them."""
    rests = np.flatnonzero(mechanics.modes == ContactMode.STICK)
    slides = np.flatnonzero(mechanics.modes == ContactMode.SLIDE)
    limit = yield_limits(model, contacts).friction[slides]
    velocity = mechanics.contact_velocities[slides]
    speed = np.hypot(velocity[:, 1], velocity[:, 2])
    along = np.hstack(
        [np.ones((len(slides), 1)), -limit[:, None] * velocity[:, 1:] / np.where(speed > 0, speed, 1.0)[:, None]]
    )
    return [*((np.tile(axis, (len(rests), 1)), rests) for axis in np.eye(3)), (along, slides)]


def _equilibrium(model: Model, contacts: Contacts, bases: FloatArray, owner: Any, rows: FloatArray) -> sp.csr_array:
    """Forces and moments of the resultants on the free blocks, rows of each block of unit length in the mean."""
    row_of_block = np.full(len(model.blocks) + len(model.grounds), -1)
    row_of_block[model.free] = np.arange(len(model.free))
    size = np.where(interface_radii(contacts) > 0, interface_radii(contacts), 1.0)
    per_block, parts = len(rows), []
    for side, sign in ((0, -1.0), (1, 1.0)):
        body = contacts.bodies[owner, side]
        here = np.flatnonzero(row_of_block[body] >= 0)
        block, force = body[here], bases[here, :3]
        arm = contacts.centroids[owner[here]] - model.blocks.centroids[block]
        moment = bases[here, 3:] * size[owner[here], None] + np.cross(arm, force)
        wrench = sign * np.hstack([force, moment / model.blocks.sizes[block, None]]) @ rows.T
        at = per_block * row_of_block[block][:, None] + np.arange(per_block)
        column = np.repeat(here, per_block)
        parts.append(sp.coo_array((wrench.ravel(), (at.ravel(), column)), (per_block * len(model.free), len(owner))))
    matrix = sp.csr_array(parts[0] + parts[1])
    # one factor for all rows of a block: a single row may be nothing but rounding, by the directions of the axes
    squares = np.asarray(matrix.power(2).sum(axis=1)).reshape(-1, per_block).sum(axis=1)
    length = np.repeat(np.sqrt(squares / per_block), per_block)
    return sp.csr_array(sp.diags_array(1.0 / np.where(length > 0, length, 1.0)) @ matrix)


def _freedom(matrix: sp.csr_array, owner: Any, n_interfaces: int) -> ForceFreedom | None:
    shifted = _Shifted(sp.csc_array(matrix @ matrix.T))
    above, below = shifted.eigenvalues_below(ABOVE), shifted.eigenvalues_below(BELOW)
    if below is None or below != above:
        return None
    degree = matrix.shape[1] - (matrix.shape[0] - below)
    determined = np.ones(n_interfaces, dtype=bool)
    if degree > 0:
        null = np.random.default_rng(0).standard_normal(matrix.shape[1])
        scale = float(np.abs(null).max())
        for _ in range(3):  # each takes the remaining range of Aᵀ down by the shift over the gap
            null = null - matrix.T @ shifted.solve(matrix @ null)
        determined[owner[np.abs(null) > UNTOUCHED * scale]] = False
    return ForceFreedom(degree, determined)


class _Shifted:
    """Factors of a symmetric matrix less multiples of the unit matrix: one pattern, analysed once."""

    def __init__(self, normal: sp.csc_array) -> None:
        self._diagonal = normal.diagonal()
        pattern, self._values = lower_triangle(sp.csc_array(normal + sp.eye_array(normal.shape[0])))
        self._on_diagonal = pattern.pointers[:-1]
        self._factors = QdldlFactors(pattern)

    def eigenvalues_below(self, shift: float) -> int | None:
        """How many, by the signs of the pivots; None where one of them is zero."""
        self._values[self._on_diagonal] = self._diagonal - shift
        pivots = self._factors.pivots(self._values)
        return None if pivots is None else int(np.sum(pivots < 0))

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution, (n,) from (n,), of the shifted system, with the factors at the last shift."""
        return self._factors.solve(rhs)


# --- What of a structure is enough for its load factor: the blocks that move and the interfaces on them -------------


@dataclass(frozen=True)
class Enough:
    """The smaller model.

    moving     : (n,) blocks that move
    interfaces : (m,) on them
    bearing    : free blocks at rest that these touch; they stand for supports
    left_out   : free blocks at rest that touch nothing that moves
    """

    moving: IntArray
    interfaces: IntArray
    bearing: IntArray
    left_out: IntArray


def enough_of(model: Model, contacts: Contacts, parts: IntArray) -> Enough:
    """From the rigid part of each block, (n_blocks,), 0 at rest."""
    n_blocks = len(model.blocks)
    moves = np.append(parts > 0, np.zeros(len(model.grounds), dtype=bool))
    on_moving = moves[contacts.bodies].any(axis=1)
    touched = np.zeros(len(moves), dtype=bool)
    touched[contacts.bodies[on_moving]] = True
    if len(model.ties):
        links = model.ties.links(n_blocks + len(model.grounds))
        links = links[(links < n_blocks).all(axis=1)]
        touched[links[moves[links].any(axis=1)]] = True
    rests = ~model.fixed & (parts == 0)
    return Enough(
        moving=np.flatnonzero(parts > 0),
        interfaces=np.flatnonzero(on_moving),
        bearing=np.flatnonzero(rests & touched[:n_blocks]),
        left_out=np.flatnonzero(rests & ~touched[:n_blocks]),
    )
