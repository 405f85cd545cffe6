"""Ties among the contacts that the solver sees, and the way back.

A tie is a contact point without friction. Its normal leads from body a to body b and N is its tension where it pulls (a
strut's is its compression), between two limits; it gets longer where that point closes. So a tie is a joint that
crushes at its capacity and has no tensile strength, in every flow rule, contact model and reduction.

The contact point lies amid the points of the tie, its normal along the line from the first to the last point. The
forces of the tie at the points that it passes in between are added (``TieContacts``). Prestress is a dead load, and N
is the change from it: a load factor does not depend on prestress.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts, summed
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts, TieContacts
from mbla.contacts.outlines.overlay import frames_from_normals
from mbla.model.model import Ground, Joint, Model
from mbla.model.solids.ragged import row_means
from mbla.model.ties.ties import OUTSIDE, Ties

IN_LINE = 1e-12
"""Moment and force, over the size of a tie, that is rounding of one in line between two bodies."""

LAW = Joint("ties", 0.0)
"""Joint law of ties, which have their own limits."""


def with_ties(bodies: RigidBodies) -> RigidBodies:
    """Rigid bodies with the ties of their model among their contacts; the same where no tie can do anything."""
    model, contacts = bodies.model, bodies.contacts
    if not len(model.ties):
        return bodies
    body = np.where(model.fixed, OUTSIDE, np.arange(len(model.blocks)))[bodies.label]
    body = np.concatenate([body, [OUTSIDE] if bodies.load_cell is None else [len(model.blocks) - 1, OUTSIDE]])
    ties = model.ties.with_bodies(body[model.ties.bodies])
    rows = _in_use(ties)
    if not len(rows):
        return bodies
    model = _with_outside(model)
    ties = ties.take(rows)
    outside = len(model.blocks) + len(model.grounds) - 1
    held = np.where(ties.bodies == OUTSIDE, outside, ties.bodies)
    pairs, points, normals = _lines(ties, held, len(model.blocks))
    own = _tie_contacts(ties, rows, held, pairs, points, normals, len(contacts.points))
    n, area = len(rows), float(contacts.areas.mean()) if len(contacts) else 1.0
    law = len(contacts.joint_names)
    frames = frames_from_normals(normals)
    extended = replace(
        contacts,
        bodies=np.vstack([contacts.bodies, pairs]),
        normals=np.vstack([contacts.normals, normals]),
        areas=np.append(contacts.areas, np.full(n, area)),
        centroids=np.vstack([contacts.centroids, points]),
        gaps=np.append(contacts.gaps, np.zeros(n)),
        joints=np.append(contacts.joints, np.full(n, law)),
        joint_names=(*contacts.joint_names, LAW.name),
        point_start=starts(np.append(np.diff(contacts.point_start), np.ones(n, dtype=np.int64))),
        outline=np.append(contacts.outline, np.ones(n, dtype=np.int64)),
        points=np.vstack([contacts.points, points]),
        frames=np.concatenate([contacts.frames, frames]),
        point_areas=np.append(contacts.point_areas, np.full(n, area)),
        cut=None if contacts.cut is None else np.append(contacts.cut, np.zeros(n, dtype=np.int64)),
        ties=own,
    )
    model = replace(model, joints={**model.joints, LAW.name: LAW})
    load = _prestress_load(model, extended)
    return replace(bodies, model=model, contacts=extended, tie_prestress_load=load)


def _with_outside(model: Model) -> Model:
    """The model with one more ground, behind all others, for what is held outside of it; nothing touches it."""
    away = Ground(np.zeros(3), np.array([0.0, 0.0, 1.0]), LAW.name, np.zeros(0, dtype=np.int64), "ground")
    return replace(model, grounds=(*model.grounds, away))


def _in_use(ties: Ties) -> IntArray:
    """Ties on two bodies or more, one of which can move, (k,)."""
    low, high = (each.reduceat(ties.bodies, ties.start[:-1]) for each in (np.minimum, np.maximum))
    return np.flatnonzero(low < high)


def _lines(ties: Ties, bodies: IntArray, n_blocks: int) -> tuple[IntArray, FloatArray, FloatArray]:
    """Bodies a and b of each tie, (k, 2), ground first, else the lower one; its point and its normal, (k, 3).

    The two bodies are the first one and the last of another number; the line leads from one to the other, or in a strip
    along it.
    """
    first = ties.start[:-1]
    last = np.array([
        end - 1 - int(np.argmax(bodies[start:end][::-1] != bodies[start]))
        for start, end in zip(ties.start[:-1].tolist(), ties.start[1:].tolist(), strict=True)
    ])  # fmt: skip
    chord = ties.places[last] - ties.places[first]
    length = np.linalg.norm(chord, axis=1)
    along = np.where((length > 0.0)[:, None], chord, ties.pulls[first])
    along = along / np.linalg.norm(along, axis=1)[:, None]
    one, other = bodies[first], bodies[last]
    turned = (other >= n_blocks) | ((one < n_blocks) & (other < one))
    pairs = np.where(turned[:, None], np.column_stack([other, one]), np.column_stack([one, other]))
    points = row_means(ties.places, ties.start)
    towards = np.where(turned, -1.0, 1.0) * _senses(ties)
    return pairs, points, -towards[:, None] * along


def _senses(ties: Ties) -> FloatArray:
    """1 where N of a tie is its tension, −1 where it can only push, (k,)."""
    return np.where(ties.greatest > 0.0, 1.0, -1.0)


def _tie_contacts(
    ties: Ties,
    rows: IntArray,
    bodies: IntArray,
    pairs: IntArray,
    points: FloatArray,
    normals: FloatArray,
    n_points: int,
) -> TieContacts:
    senses = _senses(ties)
    ends = np.sort(senses[:, None] * np.column_stack([ties.least, ties.greatest]), axis=1)
    offsets = np.clip(senses * ties.prestress, ends[:, 0], ends[:, 1])
    tie = ties.tie_of_point
    # what the tie does, less what a contact point does to its two bodies
    of_tie = np.concatenate([tie, np.arange(len(rows)), np.arange(len(rows))])
    on = np.concatenate([bodies, pairs[:, 0], pairs[:, 1]])
    places = np.vstack([ties.places, points, points])
    forces = np.vstack([senses[tie, None] * ties.pulls, normals, -normals])
    left = _out_of_line(of_tie, on, places - points[of_tie], forces)[of_tie]
    return TieContacts(
        rows=rows,
        senses=senses,
        offsets=offsets,
        tension=offsets - ends[:, 0],
        compression=ends[:, 1] - offsets,
        brittle=(ties.breaks_at == 0.0)[:, None] & np.column_stack([ends[:, 1] > 0.0, ends[:, 0] < 0.0]),
        points=n_points + of_tie[left],
        bodies=on[left],
        places=places[left],
        forces=forces[left],
    )


def _out_of_line(of_tie: IntArray, bodies: IntArray, arms: FloatArray, forces: FloatArray) -> BoolArray:
    """Ties whose further forces do not cancel on each of their bodies, (k,)."""
    pair, owner = np.unique(np.column_stack([of_tie, bodies]), axis=0, return_inverse=True)
    size = np.zeros(int(of_tie.max()) + 1)
    np.maximum.at(size, of_tie, np.linalg.norm(arms, axis=1))
    net = np.abs(summed(owner.ravel(), forces, len(pair))).max(axis=1)
    moment = np.abs(summed(owner.ravel(), np.cross(arms, forces), len(pair))).max(axis=1)
    off = (net > IN_LINE) | (moment > IN_LINE * np.maximum(size[pair[:, 0]], 1e-300))
    return np.asarray(np.bincount(pair[off, 0], minlength=len(size)) > 0)


def _prestress_load(model: Model, contacts: Contacts) -> FloatArray | None:
    """Forces and moments about centroids of ties that act as dead loads, (n_bodies, 6); None where there are none."""
    own = contacts.ties
    assert own is not None  # who calls has made them
    if not own.offsets.any():
        return None
    n_blocks, first = len(model.blocks), len(contacts.points) - len(own.rows)
    total = np.zeros((n_blocks, 6))
    share = own.offsets[own.points - first]
    parts = [(own.bodies, own.places, share[:, None] * own.forces)]
    for side, sign in ((0, -1.0), (1, 1.0)):
        on = contacts.bodies[-len(own.rows) :, side]
        parts.append((on, contacts.points[first:], sign * own.offsets[:, None] * contacts.frames[first:, 0]))
    for on, places, forces in parts:
        here = on < n_blocks
        arms = places[here] - model.blocks.centroids[on[here]]
        np.add.at(total, on[here], np.hstack([forces[here], np.cross(arms, forces[here])]))
    return total


def without_ties(contacts: Contacts) -> Contacts:
    """Contacts that the solver sees without the ties among them."""
    if contacts.ties is None:
        return contacts
    n, points = contacts.n_surfaces, int(contacts.point_start[contacts.n_surfaces])
    return replace(
        contacts,
        bodies=contacts.bodies[:n],
        normals=contacts.normals[:n],
        areas=contacts.areas[:n],
        centroids=contacts.centroids[:n],
        gaps=contacts.gaps[:n],
        joints=contacts.joints[:n],
        joint_names=contacts.joint_names[:-1],
        point_start=contacts.point_start[: n + 1],
        outline=contacts.outline[:n],
        points=contacts.points[:points],
        frames=contacts.frames[:points],
        point_areas=contacts.point_areas[:points],
        cut=None if contacts.cut is None else contacts.cut[:n],
        ties=None,
    )
