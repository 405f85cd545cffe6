"""Modes of vibration, written a second time on purpose: K φ = ω² M φ at rest, with no matrix of the solver.

Stiffness is the sum over points of quadrature, three in each triangle of the surfaces that press, masses are the sums
over four points in each tetrahedron of the blocks: both rules are exact for squares. Modes of one structure are
orthogonal by its masses.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_bodies, parting
from mbla.model.model import LoadCase
from mbla.model.solids.blocks import Blocks
from mbla.solution.modes.modes import Modes
from mbla.solution.verification.rest import UNBALANCED, AtRest, same, stiffness_of_deck
from mbla.solution.verification.statics import contact_resultants, contact_velocities, left_to_balance, lever_arms

APART = 1e-9
"""Motion of glued blocks against each other, over the largest motion: rounding."""

RESIDUAL = 1e-6
"""‖K φ − ω² M φ‖ over ‖ω² M φ‖ of a mode that is solved, and what is left of orthogonality and of shares of mass."""

OPEN = 1e-5
"""Force over the load of the lighter of two bodies with which a contact point is clearly pressed, or clearly open."""

FAR = 1e3
"""Size of a half plane over that of what it cuts."""


def checked_modes(assembly: Assembly, load_case: LoadCase, modes: Modes) -> tuple[Modes, tuple[str, ...]]:
    """The modes with their residual and whether they are verified, and what is wrong with them, in words."""
    if not len(modes):
        return replace(modes, residual=np.nan, verified=False), ()
    rest = AtRest.of(assembly, load_case, modes)
    vectors, wrong = _vectors(rest, modes), list(_wrong_at_rest(assembly, load_case, rest, modes))
    pushes, momenta = _pushes(rest, modes, vectors), _momenta(assembly, rest, vectors)
    arms = np.repeat([np.ones(len(rest.model.blocks)), lever_arms(rest.model, rest.contacts)], 3, axis=0).T
    squares = (2.0 * np.pi / modes.periods) ** 2
    residual = 0.0
    for push, momentum, square in zip(pushes, momenta, squares, strict=True):
        left = left_to_balance(rest.model, push - square * momentum, arms[:, 3])[~rest.model.fixed]
        size = float(np.linalg.norm((square * momentum / arms)[~rest.model.fixed]))
        residual = max(residual, float(np.linalg.norm(left / arms[~rest.model.fixed])) / size)
    if not residual <= RESIDUAL:
        wrong.append(f"a mode leaves {residual:.2g} of its forces without balance")
    wrong += _wrong_masses(rest, modes, vectors, momenta)
    return replace(modes, residual=residual, verified=not wrong), tuple(wrong)


def _vectors(rest: AtRest, modes: Modes) -> FloatArray:
    """Motions of the bodies, (n, n_bodies, 6)."""
    return np.stack([motions_of_bodies(rest.bodies, shape) for shape in modes.shapes])


def _wrong_at_rest(assembly: Assembly, load_case: LoadCase, rest: AtRest, modes: Modes) -> Iterator[str]:
    """What is wrong with the state that vibrates, and with motions of blocks that are bodies together."""
    default, stiffness = stiffness_of_deck(assembly, load_case)
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
    if np.any(whole & (least[:n] < -OPEN)) or np.any(none & (most[:n] > OPEN)):
        yield "interfaces are said to press that are open, or to be open where they press"


def same_share(shares: FloatArray, share: float) -> np.ndarray:
    """Which shares are one but for rounding."""
    return np.abs(shares - share) <= 1e-9


# --- Stiffness ------------------------------------------------------------------------------------------------------


def _pushes(rest: AtRest, modes: Modes, vectors: FloatArray) -> list[FloatArray]:
    """K φ of each mode: forces and moments that push bodies back, (n_bodies, 6) each."""
    contacts, model = rest.contacts, rest.model
    interface, places, weights = _quadrature(rest, modes)
    frames = contacts.frames[contacts.point_start[interface]]
    laws = [model.joints[name] for name in contacts.joint_names]
    smooth = np.array([law.friction <= 0.0 and law.cohesion <= 0.0 for law in laws], dtype=bool)
    springs = weights[:, None] * rest.stiffness[interface][:, [0, 1, 1]]
    springs[smooth[contacts.joints[interface]], 1:] = 0.0
    centres = np.vstack([model.blocks.centroids, np.zeros((len(model.grounds), 3))])
    n, bodies = len(model.blocks), contacts.bodies[interface]
    found = []
    for vector in vectors:
        every = np.vstack([vector, np.zeros((len(model.grounds), 6))])
        ends = [every[own, :3] + np.cross(every[own, 3:], places - centres[own]) for own in bodies.T]
        force = np.einsum("pj,pjx->px", springs * np.einsum("pjx,px->pj", frames, ends[1] - ends[0]), frames)
        total = np.zeros((len(every), 6))
        for own, sign in zip(bodies.T, (-1.0, 1.0), strict=True):
            arm = places - centres[own]
            np.add.at(total, own, sign * np.hstack([force, np.cross(arm, force)]))
        found.append(total[:n] + _of_ties(rest, vector))
    return found


def _of_ties(rest: AtRest, vector: FloatArray) -> FloatArray:
    """What ties that are not slack add to it."""
    ties = rest.contacts.tie_points
    if not ties.any():
        return np.zeros_like(vector)
    mean = rest.loads[~rest.model.fixed].mean()
    holds = ties & (rest.pressed > OPEN * 0.1 * mean)
    force = np.zeros((len(ties), 3))
    closing = contact_velocities(rest.model, rest.contacts, vector)[:, 0]
    force[:, 0] = np.where(holds, rest.points[:, 0] * closing, 0.0)
    return contact_resultants(rest.model, rest.contacts, force)


def _quadrature(rest: AtRest, modes: Modes) -> tuple[IntArray, FloatArray, FloatArray]:
    """Interface, place and area of the points of quadrature on what presses."""
    contacts = rest.contacts
    interface, places, weights = [], [], []
    for row in np.flatnonzero(modes.pressed > 0.0).tolist():
        own = slice(int(contacts.point_start[row]), int(contacts.point_start[row + 1]))
        corners = contacts.points[own][: contacts.outline[row]]
        frame, centre = contacts.frames[own.start], contacts.centroids[row]
        outline = (corners - centre) @ frame[1:].T
        hollow = abs(shapely.Polygon(outline).area - contacts.areas[row]) > 1e-6 * contacts.areas[row]
        if hollow:
            holds = rest.pressed[own] > 0.0
            spots, shares = contacts.points[own][holds], contacts.point_areas[own][holds]
        else:
            outline = outline if same_share(modes.pressed[row], 1.0) else _cut(rest, row, outline)
            here, there = outline, np.roll(outline, -1, axis=0)
            area = (here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]) / 2.0
            middles = np.concatenate([here / 2.0, (here + there) / 2.0, there / 2.0])
            spots, shares = centre + middles @ frame[1:], np.tile(area / 3.0, 3)
        interface.append(np.full(len(spots), row))
        places.append(spots)
        weights.append(shares)
    return np.concatenate(interface), np.concatenate(places), np.concatenate(weights)


def _cut(rest: AtRest, row: int, outline: FloatArray) -> FloatArray:
    """The part of an outline that presses: where the plane through the forces of its corners lies above nothing."""
    contacts = rest.contacts
    own = slice(int(contacts.point_start[row]), int(contacts.point_start[row]) + int(contacts.outline[row]))
    moved = contact_velocities(rest.model, contacts, rest.settlement)[own, 0]
    law = rest.model.joints[contacts.joint_names[contacts.joints[row]]]
    height = law.tensile_strength / rest.stiffness[row, 0] - moved
    plane, *_ = np.linalg.lstsq(np.column_stack([outline, np.ones(len(outline))]), height, rcond=None)
    normal = plane[:2] / np.hypot(*plane[:2])
    foot, size = -plane[2] / np.hypot(*plane[:2]) * normal, FAR * np.abs(outline).max()
    along = np.array([-normal[1], normal[0]])
    half = [foot - size * along, foot + size * along, foot + size * (along + normal), foot + size * (normal - along)]
    part = shapely.Polygon(outline).intersection(shapely.Polygon(half))
    pieces = [piece for piece in shapely.get_parts(part) if piece.geom_type == "Polygon"]
    corners = [np.array(shapely.geometry.polygon.orient(piece).exterior.coords)[:-1] for piece in pieces]
    return corners[0] if len(corners) == 1 else np.concatenate(corners) if corners else np.zeros((0, 2))


# --- Masses ---------------------------------------------------------------------------------------------------------


def _momenta(assembly: Assembly, rest: AtRest, vectors: FloatArray) -> list[FloatArray]:
    """M φ of each mode about the centroids of the bodies, (n_bodies, 6) each, force per acceleration."""
    blocks, label = assembly.model.blocks, rest.bodies.label
    owner, places, masses = _mass_points(blocks)
    body = label[owner]
    arms = places - rest.model.blocks.centroids[body]
    unit, found = rest.model.units.force_per_mass_acceleration, []
    for vector in vectors:
        moved = masses[:, None] * (vector[body, :3] + np.cross(vector[body, 3:], arms))
        total = np.zeros_like(vector)
        np.add.at(total, body, np.hstack([moved, np.cross(arms, moved)]))
        found.append(unit * total)
    return found


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


def _wrong_masses(rest: AtRest, modes: Modes, vectors: FloatArray, momenta: list[FloatArray]) -> Iterator[str]:
    """Modes that are not orthogonal, or whose masses are not those that take part."""
    gram = np.array([[float(np.vdot(one, other)) for other in momenta] for one in vectors])
    size = np.sqrt(np.diag(gram))
    off = np.abs(gram / np.outer(size, size) - np.eye(len(size))).max()
    if not off <= RESIDUAL:
        yield f"modes are not orthogonal, by {off:.2g}"
    feels = np.array([momentum[~rest.model.fixed, :3].sum(axis=0) for momentum in momenta])
    unit = rest.model.units.force_per_mass_acceleration
    shares = (feels / size[:, None]) ** 2 / np.where(modes.moving > 0.0, modes.moving * unit, 1.0)
    if not np.abs(shares - modes.masses).max() <= RESIDUAL:
        yield "masses that take part are not those of the modes"
