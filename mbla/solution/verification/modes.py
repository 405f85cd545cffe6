"""Modes of vibration, written a second time on purpose: K φ = ω² M φ at rest, with no matrix of the solver.

Stiffness is the sum over points of quadrature, three in each triangle of the surfaces that press, masses are the sums
over four points in each tetrahedron of the blocks: both rules are exact for squares. Modes of one structure are
orthogonal by its masses.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_bodies, parting
from mbla.assembly.structure_at import StructureAt
from mbla.model.solids.blocks import Blocks
from mbla.solution.linear_algebra.superlu import negative_pivots
from mbla.solution.modes.modes import Modes
from mbla.solution.verification.leaning import left_out_share
from mbla.solution.verification.pressed_parts import quadrature, same_share, within_kern
from mbla.solution.verification.rest import UNBALANCED, AtRest, same, stiffness_of_deck
from mbla.solution.verification.statics import contact_resultants, left_to_balance, lever_arms

APART = 1e-9
"""Motion of glued blocks against each other, over the largest motion: rounding."""

RESIDUAL = 1e-6
"""‖K φ − ω² M φ‖ over ‖ω² M φ‖ of a mode that is solved, and what is left of orthogonality and of shares of mass."""

OPEN = 1e-5
"""Force over the load of the lighter of two bodies with which a contact point is clearly pressed, or clearly open."""

PRESSED = 1e-6
"""The same with which a tie holds."""

NOTHING = 1e-13
"""ω² over the greatest K/M of an unknown that is none but for rounding."""

CLOSE = 1e-6
"""By how much below the highest ω² modes are counted, relative: of one frequency some may be left out."""


def checked_modes(there: StructureAt, modes: Modes) -> tuple[Modes, tuple[str, ...]]:
    """The modes with their residual and whether they are verified, and what is wrong with them, in words."""
    if not len(modes):
        return replace(modes, residual=np.nan, verified=False), ()
    if len(modes.pressed) != len(there.assembly.contacts):
        return replace(modes, residual=np.nan, verified=False), ("interfaces are others than those of the structure",)
    rest = AtRest.of(there, modes)
    vectors, wrong = _vectors(rest, modes), list(_wrong_at_rest(there, rest, modes))
    stiffness, masses = _stiffness(rest, modes), _masses(there.assembly, rest)
    flat = vectors.reshape(len(vectors), -1).T
    pushes, momenta = ((each @ flat).T.reshape(vectors.shape) for each in (stiffness, masses))
    arms = np.repeat([np.ones(len(rest.model.blocks)), lever_arms(rest.model, rest.contacts)], 3, axis=0).T
    squares, residual, moves = (2.0 * np.pi / modes.periods) ** 2, 0.0, ~rest.model.fixed
    for push, momentum, square in zip(pushes, momenta, squares, strict=True):
        left = left_to_balance(rest.model, push - square * momentum, arms[:, 3])[moves]
        size = float(np.linalg.norm((square * momentum / arms)[moves]))
        residual = max(residual, float(np.linalg.norm(left / arms[moves])) / size)
    if not residual <= RESIDUAL:
        wrong.append(f"a mode leaves {residual:.2g} of its forces without balance")
    model = there.assembly.model.of_case(there.load_case)
    if (share := left_out_share(model, there.load_case, modes)) >= 1.0:
        wrong.append(
            f"it does not stand on joints that soft: its weight takes about {share:.2g} of its stiffness as it leans"
        )
    wrong += [*_wrong_masses(rest, modes, vectors, momenta), *_left_out(rest, stiffness, masses, squares)]
    return replace(modes, residual=residual, verified=not wrong), tuple(wrong)


def _vectors(rest: AtRest, modes: Modes) -> FloatArray:
    """Motions of the bodies, (n, n_bodies, 6)."""
    return np.stack([motions_of_bodies(rest.bodies, shape) for shape in modes.shapes])


def _wrong_at_rest(there: StructureAt, rest: AtRest, modes: Modes) -> Iterator[str]:
    """What is wrong with the state that vibrates, and with motions of blocks that are bodies together."""
    default, stiffness = stiffness_of_deck(there)
    if not (same(modes.default, default) and same(modes.stiffness, stiffness)):
        yield "joints are not as stiff as the deck says"
    if not rest.unbalanced <= UNBALANCED:
        yield f"at rest {rest.unbalanced:.2g} of the dead load of a block is not balanced"
    if max(parting(rest.bodies, motions) for motions in (modes.settlement, *modes.shapes)) > APART:
        yield "blocks that are glued to each other move apart"
    if any(np.any(motions[rest.model.fixed] != 0.0) for motions in (rest.settlement, *_vectors(rest, modes))):
        yield "fixed blocks move"
    contacts = rest.contacts
    force, owner = rest.pressed / rest.lighter, contacts.interface_of_point
    least, most = (np.full(len(contacts), start) for start in (np.inf, -np.inf))
    np.minimum.at(least, owner, force)
    np.maximum.at(most, owner, force)
    n = contacts.n_surfaces
    whole, none = same_share(modes.pressed, 1.0), modes.pressed == 0.0
    wrong = np.any(whole & (least[:n] < -OPEN)) or np.any(none & (most[:n] > OPEN))
    if wrong or not all(within_kern(rest, row) for row in np.flatnonzero(whole & ~rest.turned).tolist()):
        yield "interfaces are said to press that are open, or to be open where they press"
    if modes.slack != int(contacts.tie_points.sum()) - len(_that_hold(rest)):
        yield "ties are said to hold that are slack, or to be slack where they hold"


# --- Stiffness ------------------------------------------------------------------------------------------------------


def _stiffness(rest: AtRest, modes: Modes) -> sp.csr_array:
    """K of all bodies, (6 n_bodies, 6 n_bodies)."""
    contacts, model = rest.contacts, rest.model
    interface, places, weights = quadrature(rest, modes.pressed)
    laws = [model.joints[name] for name in contacts.joint_names]
    smooth = np.array([law.friction <= 0.0 and law.cohesion <= 0.0 for law in laws], dtype=bool)
    springs = weights[:, None] * rest.stiffness[interface][:, [0, 1, 1]]
    springs[smooth[contacts.joints[interface]], 1:] = 0.0
    frames = contacts.frames[contacts.point_start[interface]]
    n, bodies = len(model.blocks), contacts.bodies[interface]
    ways = sp.csr_array((3 * len(places), 6 * n))
    for side, sign in ((0, -1.0), (1, 1.0)):
        on = np.flatnonzero(bodies[:, side] < n)
        own = bodies[on, side]
        of_point = _motions(places[on] - model.blocks.centroids[own])
        values = sign * frames[on] @ of_point
        rows = np.broadcast_to((3 * on[:, None] + np.arange(3))[:, :, None], values.shape)
        columns = np.broadcast_to((6 * own[:, None] + np.arange(6))[:, None, :], values.shape)
        entries = (values.ravel(), (rows.ravel(), columns.ravel()))
        ways = ways + sp.csr_array(sp.coo_array(entries, shape=ways.shape))
    return sp.csr_array(ways.T @ sp.diags_array(springs.ravel()) @ ways + _of_ties(rest))


def _motions(arms: FloatArray) -> FloatArray:
    """Velocity of points at distances (n, 3) from a motion (v, ω), (n, 3, 6): v − r × ω."""
    found = np.zeros((len(arms), 3, 6))
    found[:, :, :3] = np.eye(3)
    found[:, :, 3:] = -np.cross(arms[:, None, :], np.eye(3)).transpose(0, 2, 1)
    return found


def _that_hold(rest: AtRest) -> IntArray:
    """Points of ties that are not slack."""
    mean = rest.loads[~rest.model.fixed].mean()
    return np.flatnonzero(rest.contacts.tie_points & (rest.pressed > PRESSED * mean))


def _of_ties(rest: AtRest) -> sp.csr_array:
    """What ties that are not slack add to it."""
    contacts, n, holds = rest.contacts, len(rest.model.blocks), _that_hold(rest)
    pulls = np.zeros((6 * n, len(holds)))
    for column, point in enumerate(holds.tolist()):
        force = np.zeros((len(contacts.points), 3))
        force[point, 0] = 1.0
        pulls[:, column] = contact_resultants(rest.model, contacts, force).ravel()
    ways = sp.csr_array(pulls)
    return sp.csr_array(ways @ sp.diags_array(rest.points[holds, 0]) @ ways.T)


# --- Masses ---------------------------------------------------------------------------------------------------------


def _masses(assembly: Assembly, rest: AtRest) -> sp.csr_array:
    """M of all bodies about their centroids, (6 n_bodies, 6 n_bodies) force per acceleration."""
    owner, places, masses = _mass_points(assembly.model.blocks)
    body = rest.bodies.label[owner]
    ways = _motions(places - rest.model.blocks.centroids[body])
    total = np.zeros((len(rest.model.blocks), 6, 6))
    np.add.at(total, body, masses[:, None, None] * ways.transpose(0, 2, 1) @ ways)
    return sp.csr_array(sp.block_diag(total)) * rest.model.units.force_per_mass_acceleration


def _mass_points(blocks: Blocks) -> tuple[IntArray, FloatArray, FloatArray]:
    """Block, place and mass of points that have the mass of the blocks and its second moments."""
    face, here, there = blocks.face_of_corner, blocks.vertices[blocks.loops], blocks.vertices[blocks.next_loops]
    count = np.bincount(face, minlength=len(blocks.block_of_face))
    middle = np.column_stack([np.bincount(face, along, len(count)) for along in here.T]) / count[:, None]
    owner = blocks.block_of_face[face]
    corners = np.stack([blocks.origins[owner], middle[face], here, there], axis=1)
    edges = corners[:, 1:] - corners[:, :1]
    volumes = np.einsum("ni,ni->n", edges[:, 0], np.cross(edges[:, 1], edges[:, 2])) / 6.0
    low = (5.0 - np.sqrt(5.0)) / 20.0
    spots = low * corners.sum(axis=1)[:, None] + (1.0 - 4.0 * low) * corners
    masses = np.repeat(blocks.densities[owner] * volumes / 4.0, 4)
    return (
        np.concatenate([np.repeat(owner, 4), np.arange(len(blocks))]),
        np.concatenate([spots.reshape(-1, 3), blocks.added_mass_points]),
        np.concatenate([masses, blocks.added_masses]),
    )


def _wrong_masses(rest: AtRest, modes: Modes, vectors: FloatArray, momenta: FloatArray) -> Iterator[str]:
    """Modes that are not orthogonal, or whose masses are not those that take part."""
    gram = np.array([[float(np.vdot(one, other)) for other in momenta] for one in vectors])
    size = np.sqrt(np.diag(gram))
    off = np.abs(gram / np.outer(size, size) - np.eye(len(size))).max()
    if not off <= RESIDUAL:
        yield f"modes are not orthogonal, by {off:.2g}"
    feels = momenta[:, ~rest.model.fixed, :3].sum(axis=1)
    unit = rest.model.units.force_per_mass_acceleration
    shares = (feels / size[:, None]) ** 2 / np.where(modes.moving > 0.0, modes.moving * unit, 1.0)
    if not np.abs(shares - modes.masses).max() <= RESIDUAL:
        yield "masses that take part are not those of the modes"


# --- Numbers of modes -----------------------------------------------------------------------------------------------


def _left_out(rest: AtRest, stiffness: sp.csr_array, masses: sp.csr_array, squares: FloatArray) -> Iterator[str]:
    """That modes are left out: between nothing and the highest ω² lie more than are given.

    By the law of inertia (Sylvester) K − σ M has as many negative pivots as there are modes below σ.
    """
    free = np.flatnonzero(np.repeat(~rest.model.fixed, 6))
    ways = _ways(rest)[free]
    unit = sp.diags_array(1.0 / np.sqrt((ways.T @ masses[free][:, free] @ ways).diagonal()))
    k, m = (sp.csr_array(unit @ ways.T @ each[free][:, free] @ ways @ unit) for each in (stiffness, masses))
    highest = squares[-1] * (1.0 - CLOSE)
    below = [negative_pivots(k - shift * m) for shift in (NOTHING * float(k.diagonal().max()), highest)]
    if below[0] is None or below[1] is None:
        return
    if (missed := below[1] - below[0] - int((squares < highest).sum())) > 0:
        words = "mode of a longer period than the shortest is" if missed == 1 else "modes of longer periods are"
        yield f"{missed} {words} left out"


def _ways(rest: AtRest) -> sp.csr_array:
    """Motions of all bodies that guides allow, by columns."""
    guides, n = rest.model.guides, len(rest.model.blocks)
    alone = np.setdiff1d(np.flatnonzero(~rest.model.fixed), guides.blocks)
    own = (6 * alone[:, None] + np.arange(6)).ravel()
    parts = [sp.coo_array((np.ones(len(own)), (own, np.arange(len(own)))), shape=(6 * n, len(own)))]
    for body in range(guides.n_bodies):
        whole = np.zeros((n, 6, guides.motions.shape[2]))
        mine = guides.bodies == body
        whole[guides.blocks[mine]] = guides.motions[mine]
        used = np.abs(whole).max(axis=(0, 1)) > 0.0
        parts.append(sp.coo_array(whole[:, :, used].reshape(6 * n, -1)))
    return sp.csr_array(sp.hstack(parts))
