"""What joints remember where contacts are found anew: points go on, and two bodies press on each other as before.

New points of two bodies take over from the nearest of those that are gone. What is missing then of force and moment
between the two comes from a small motion of one against the other, by the stiffness of the points that are there, as
far as these can press.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.carried import Placed, Touching
from mbla.solution.law.elastic_joints import StepState, smoothed_margin, within
from mbla.solution.pushover.place import PushedPlace
from mbla.solution.pushover.pose.moved_joints import History, JointsAt, MovedJoints

SAME_PAIR = 5.0
"""Distance, with pairs of bodies 10 apart and the structure 1 long, within which points are of one pair."""

ALIKE = 0.005
"""Gap of a point, or overlap, over the size of the smaller block, beyond what its slip has opened, up to which it may
press: a new normal, that of a face or the mean of two, measures gaps in another way."""


def inherited(place: PushedPlace, joints: MovedJoints, at: JointsAt) -> tuple[History, StepState | None]:
    """What the joints of contacts found there remember, from those of a place, and the state they go on from."""
    old, touching = place.joints, joints.touching
    n_before, n_now, new = len(old.areas), len(joints.areas), touching.before < 0
    kept, stays = np.flatnonzero(~new), touching.before[~new]
    source = sources(old.touching, place.at.placed, touching, at.placed)
    known, gone = source >= 0, np.ones(n_before, dtype=bool)
    gone[stays] = False
    share = np.where(new & known, joints.areas / old.areas[source], 1.0)
    before, free = _forces_of(place), old.forces(place.history.values)
    usual = np.where(known & (~new | place.at.joints.dilates), free[source, 0] * share, 0.0)
    stiffness, gaps = joints.structure.stiffness * joints.areas, at.placed.offsets[:, 0]
    carries = ~new | (np.abs(gaps - usual / stiffness) < ALIKE * touching.sizes)
    takes = ~new | (known & carries & gone[source])
    begun = np.zeros((len(joints.contacts.points), 3))
    begun[:n_now][takes] = turned(place.at.placed, at.placed, before, takes, source) * share[takes, None]
    begun[:n_now] = _balanced(place, joints, at, before[:n_before], begun[:n_now], carries)
    presses = new & (begun[:n_now, 0] > 0.0)
    at_zero = begun.copy()
    at_zero[:n_now, 0] = np.where(presses, begun[:n_now, 0] + stiffness * gaps, np.minimum(usual, stiffness * gaps))
    at_zero[kept, 0] = free[stays, 0] + begun[kept, 0] - before[stays, 0]
    row = {tie: number for number, tie in enumerate(old.ties.tolist())}
    ties = n_before + np.array([row[tie] for tie in joints.ties.tolist()], dtype=np.int64)
    at_zero[n_now:], begun[n_now:] = free[ties], before[ties]
    was_there = np.concatenate([~new, np.ones(len(ties), dtype=bool)])
    smooth = before if place.state is None else old.forces(np.vstack([place.state.normal[None], place.state.shear]))
    begun[was_there, 1:] += (smooth - before)[np.concatenate([stays, ties]), 1:]
    stands, starts = (_reduced(joints, each) for each in (was_there, np.append(presses, np.zeros(len(ties), bool))))
    values, forces = joints.values(at_zero), joints.values(begun)
    soft = _product(place) * at.joints.normal * joints.length
    values[0] -= np.where(starts, soft / np.where(starts, forces[0], 1.0), 0.0)
    history = History(values, at.offsets[1:])
    return history, None if place.state is None else _state(place, joints, at, history, forces, soft, stands, starts)


def _reduced(joints: MovedJoints, which: BoolArray) -> BoolArray:
    """Which points of the program stand for some of all points, (n_points,)."""
    flags = np.repeat(which[:, None].astype(np.float64), 3, axis=1)
    return np.asarray(joints.values(flags)[0] > 0.0)


def _state(
    place: PushedPlace,
    joints: MovedJoints,
    at: JointsAt,
    history: History,
    forces: FloatArray,
    soft: FloatArray,
    stands: BoolArray,
    starts: BoolArray,
) -> StepState:
    """The smoothed state on new contacts: forces of points that were there or press, of the others by the law.

    forces : (components, n_points); soft : (n_points,) products times stiffness
    stands, starts : (n_points,) which points were there, and which press from here on
    """
    tension = at.joints.program.limits.tension
    above = history.values[0] - at.joints.normal * joints.length * at.offsets[0] + tension
    by_law = smoothed_margin(above, soft) - tension
    normal = np.where((stands | starts) & (forces[0] > 0.0), forces[0], by_law)
    shear = within(forces[1:], at.joints.limit(normal), np.where(stands, STAYS, WITHIN))
    none = np.zeros_like(normal)
    return StepState(
        u=np.zeros(len(joints.reduced.dead_load)),
        factor=place.factor / joints.full.scaling.live,
        normal=normal,
        opening=none,
        shear=shear,
        slip=np.zeros_like(shear),
        speed=none,
        crushing=np.zeros(len(at.joints.crushable)),
    )


STAYS, WITHIN = 1.0 - 1e-12, 0.999
"""Shares of its limit that shear of points that stay, and of new ones, has at most: a share of 1 slides without end."""


def _product(place: PushedPlace) -> float:
    """Mean product of normal force and opening in the smoothed state of a place; nothing without one."""
    state = place.state
    return 0.0 if state is None else float((place.at.joints.margin(state.normal) * state.opening).mean())


def _forces_of(place: PushedPlace) -> FloatArray:
    """Of all points there, (n_points, 3) N: smoothed normal forces, where there are any."""
    old, limits = place.joints, place.at.joints.program.limits
    if place.state is not None:
        normal = place.state.normal
    else:
        free = place.history.values[0] - place.at.joints.normal * old.length * place.at.offsets[0]
        normal = np.clip(free, -limits.tension, limits.compression)
    return old.forces(np.vstack([normal[None], place.history.values[1:]]))


def _balanced(
    place: PushedPlace, joints: MovedJoints, at: JointsAt, before: FloatArray, begun: FloatArray, carries: BoolArray
) -> FloatArray:
    """Forces, (n_points, 3) N, that have the force and moment between two bodies that those before have.

    before  : (n_points, 3) N, of the points before
    begun   : of the points there
    carries : (n_points,) which points may press
    """
    was, now = place.joints.touching, joints.touching
    bodies = np.vstack([was.points.bodies, now.points.bodies])
    pair = np.unique(bodies, axis=0, return_inverse=True)[1].ravel()
    n, count = len(before), int(pair.max(initial=-1)) + 1
    gone, new = np.ones(n, dtype=bool), now.before < 0
    gone[now.before[~new]] = False
    changed = np.zeros(count, dtype=bool)
    changed[pair[:n][gone]] = True
    changed[pair[n:][new]] = True
    of_pair = [_rows_of(own, count) for own in (pair[:n], pair[n:])]
    limits, force = joints.full.limits, joints.full.scaling.force
    tension, cohesion, strength = (own * force for own in (limits.tension, limits.cohesion, limits.compression))
    stiffness = joints.structure.stiffness * joints.areas[:, None] * np.ones(3)
    stiffness[:, 1:] *= joints.ratio * joints.structure.along(joints.touching)[:, None]
    stiffness[~carries] = 0.0
    found = begun.copy()
    for one in np.flatnonzero(changed):
        old, own = of_pair[0][one], of_pair[1][one]
        if not len(old) or not len(own):
            continue
        centre, size = at.placed.points[own].mean(axis=0), float(now.sizes[own].min())
        ways = _wrenches(place.at.placed.points[old], place.at.placed.frames[old], centre, size)
        wanted = np.einsum("nik,ni->k", ways, before[old])
        ways = _wrenches(at.placed.points[own], at.placed.frames[own], centre, size)
        bounds = np.column_stack([-tension[own], limits.friction[own], cohesion[own], strength[own]])
        found[own] = _pressed(ways, begun[own], wanted, stiffness[own], bounds)
    return found


def _rows_of(numbers: IntArray, count: int) -> list[IntArray]:
    """Where each of the numbers up to a count stands."""
    return np.split(np.argsort(numbers, kind="stable"), np.cumsum(np.bincount(numbers, minlength=count))[:-1])


PASSES, ENOUGH = 10, 1e-9
"""Motions of two bodies at most, and share of a force that may be missing."""


def _pressed(
    ways: FloatArray, begun: FloatArray, wanted: FloatArray, stiffness: FloatArray, bounds: FloatArray
) -> FloatArray:
    """Forces of points, (n, 3), from those they begin with, by motions of two bodies until what is wanted is there.

    ways   : (n, 3, 6) force and moment of unit forces; wanted : (6,) of all; stiffness : (n, 3)
    bounds : (n, 4) least normal force, friction, cohesion and greatest normal force
    """
    forces, k = begun.copy(), stiffness.copy()
    for _ in range(PASSES):
        missing = wanted - np.einsum("nik,ni->k", ways, forces)
        if float(np.abs(missing).max()) <= ENOUGH * float(np.abs(wanted).max()):
            break
        matrix = np.einsum("nik,ni,nil->kl", ways, k, ways)
        forces = forces + k * (ways @ (np.linalg.pinv(matrix, 1e-9, hermitian=True) @ missing))
        opens = forces[:, 0] < bounds[:, 0]
        forces[opens, 0], k[opens] = bounds[opens, 0], 0.0
        crushes = forces[:, 0] > bounds[:, 3]
        forces[crushes, 0], k[crushes, 0] = bounds[crushes, 3], 0.0
        limit = bounds[:, 2] + bounds[:, 1] * np.maximum(forces[:, 0], 0.0)
        size = np.linalg.norm(forces[:, 1:], axis=1)
        slides = size > limit
        forces[slides, 1:] *= (limit[slides] / size[slides])[:, None]
        k[slides, 1:] = 0.0
    return forces


def _wrenches(places: FloatArray, frames: FloatArray, centre: FloatArray, size: float) -> FloatArray:
    """Force, and moment about a centre over a size, of unit forces along the axes of points, (n, 3, 6)."""
    return np.concatenate([frames, np.cross((places - centre)[:, None, :], frames) / size], axis=2)


def turned(was: Placed, there: Placed, forces: FloatArray, takes: BoolArray, source: IntArray) -> FloatArray:
    """Forces of points before in the frames of those that take them over, (n, 3): shear keeps its way in space."""
    before, now = was.frames[source[takes]], there.frames[takes]
    own = forces[source[takes]]
    along = np.einsum("nk,nkj->nj", own[:, 1:], before[:, 1:])
    return np.column_stack([own[:, 0], np.einsum("nkj,nj->nk", now[:, 1:], along)])


def sources(before: Touching, was: Placed, now: Touching, there: Placed) -> IntArray:
    """The point before of each point, the nearest of its pair for a new one, (n_points,); −1 without any.

    was, there : the points before, and those now, at the pose
    """
    source, new = now.before.copy(), np.flatnonzero(now.before < 0)
    if not len(new) or not len(before.before):
        return source
    bodies = np.vstack([before.points.bodies, now.points.bodies[new]])
    pair = 2.0 * SAME_PAIR * np.unique(bodies, axis=0, return_inverse=True)[1].ravel()
    size, n = float(np.ptp(there.points, axis=0).max()) or 1.0, len(before.before)
    tree = cKDTree(np.column_stack([was.points / size, pair[:n]]))
    places = np.column_stack([there.points[new] / size, pair[n:]])
    distance, nearest = (np.asarray(each) for each in tree.query(places))
    near = distance < SAME_PAIR
    source[new[near]] = nearest[near]
    return source
