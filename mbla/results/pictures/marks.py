"""Marks of a load case on the structure as built: joints that move, forces, loads; the same for every renderer.

Every point of a mark is one that two bodies carry along: it moves as the mean of both, in a picture (:func:`moved`) and
in the browser. Arrows keep their direction, as loads do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.plane import plane_axes
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.motion import moved_points
from mbla.results.collapse.thrust import OUTSIDE
from mbla.results.listing.text import number
from mbla.results.pictures.page import CRUSH, HINGE, INK, OPEN, ORANGE, OTHER_END, PURPLE, RESULTANT, SLIDE, THRUST
from mbla.results.pictures.scene import Scene

THIN, DOT = 0.3, 0.6
"""thickness of hinges that the listing does not name and of outlines, and of dots, over that of other hinges"""
SAME_PLACE = 1e-6
"""of the size of the structure, up to which two corners are one"""
LEAST_SHARE, MOST_PLANES = 0.1, 20
"""share of the largest slip from which a sliding plane has an arrow, and how many have one"""
LEAST_SLIP = 0.02
"""half length of the arrow of a small joint that slides, over the size of the structure"""
SIDE = 0.7
"""length of a resultant over the size of the smaller block at its joint"""
THICKEST = 2.2
"""of the largest resultant, over other marks"""
LONGEST = 0.2
"""length of the largest over the size of the structure, where lengths show sizes"""
LEAST, MOST = 0.01, 400
"""share of the largest resultant from which others are drawn, and how many of the largest"""
MIDDLE_THIRD, EDGE = 1 / 3, 0.99
"""eccentricity beyond which a joint without tension is not pressed all over, and from which the force is at its edge"""
USED = 0.999
"""share of the friction from which all of it counts as used: forces are known to about a thousandth of it"""
TURN = 24
"""segments of the ring of a moment"""


@dataclass(frozen=True)
class Mark:
    """Segments, arrows or dots of one kind.

    points : (n, 3) m, as built
    bodies : (n, 2) bodies whose mean motion each point follows, -1 for none
    pairs  : (k, 2) rows of points from which to which segments lead; both the same for a dot
    widths : (k,) thickness over that of a hinge
    texts  : (n) what the browser shows for each point
    faces  : (m, 4) rows of points, areas between bodies that part
    inside : it lies within the blocks and is seen only through them
    covered : blocks in front of it hide it, where other marks shine through
    pale    : its areas are seen through, and lie behind the blocks of a plane figure
    """

    name: str
    colour: str
    points: FloatArray
    bodies: IntArray
    pairs: IntArray
    widths: FloatArray
    texts: tuple[str, ...]
    faces: IntArray = field(default_factory=lambda: np.zeros((0, 4), dtype=np.int64))
    arrows: bool = False
    inside: bool = False
    covered: bool = False
    pale: bool = False


def moved(mark: Mark, model: Model, motion: FloatArray) -> FloatArray:
    """Points of a mark after a motion of the blocks, (n_blocks, 6): (n, 3) m."""
    total = np.zeros_like(mark.points)
    for side in (0, 1):
        owners = mark.bodies[:, side]
        own = (owners >= 0) & (owners < len(model.blocks))
        points = mark.points.copy()
        points[own] = moved_points(model.blocks, motion, owners[own], points[own])
        total += points / 2
    if mark.arrows:
        first, last = mark.pairs.T
        total[first] = total[last] - (mark.points[last] - mark.points[first])
    return total


def segments(
    name: str, colour: str, ends: FloatArray, bodies: IntArray, texts: Sequence[str], widths: FloatArray | None = None
) -> Mark:
    """A mark of segments of their own points.

    ends : (k, 2, 3) m; bodies : (k, 2) of each segment; widths : (k,), 1 unless given
    """
    count = len(ends)
    return Mark(
        name,
        colour,
        ends.reshape(-1, 3),
        np.repeat(bodies, 2, axis=0),
        np.arange(2 * count).reshape(-1, 2),
        np.ones(count) if widths is None else widths,
        tuple(text for text in texts for _ in range(2)),
    )


def arrows(name: str, colour: str, tips: FloatArray, steps: FloatArray, bodies: IntArray, texts: Sequence[str]) -> Mark:
    """Arrows that end at tips, having come by steps, (k, 3) m each; bodies (k, 2)."""
    mark = segments(name, colour, np.stack([tips - steps, tips], axis=1), bodies, texts)
    return replace(mark, arrows=True)


def dots(name: str, colour: str, points: FloatArray, bodies: IntArray, texts: Sequence[str]) -> Mark:
    """Dots within blocks, at points, (k, 3) m."""
    pairs = np.repeat(np.arange(len(points))[:, None], 2, axis=1)
    return Mark(name, colour, points, bodies, pairs, np.full(len(points), DOT), tuple(texts), inside=True)


def rings(
    name: str, colour: str, centres: FloatArray, turns: FloatArray, reach: FloatArray, bodies: IntArray, words: str
) -> list[Mark]:
    """Three quarters of a ring about each axis by the right hand, and an arrow at its end.

    centres : (n, 3) m; turns : (n, 3) along the axes; reach : (n,) m, radii; bodies : (n, 2)
    """
    first, second = plane_axes(turns / np.linalg.norm(turns, axis=1, keepdims=True)).transpose(1, 0, 2)
    angle = np.linspace(0.0, 1.5 * np.pi, TURN + 1)[:, None]
    arms = np.cos(angle) * first[:, None] + np.sin(angle) * second[:, None]
    points = centres[:, None] + reach[:, None, None] * arms
    pieces = np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 3)
    texts = [words] * len(pieces)
    tips, steps = points[:, -1], 0.5 * reach[:, None] * first
    return [
        segments(name, colour, pieces, np.repeat(bodies, TURN, axis=0), texts, np.full(len(pieces), 0.5)),
        arrows(name, colour, tips + steps / 2, steps, bodies, [words] * len(tips)),
    ]


def interface_names(model: Model, contacts: Contacts) -> list[str]:
    """``arch[3] | arch[4]`` for every interface."""
    return [f"{model.body_name(a)} | {model.body_name(b)}" for a, b in contacts.bodies.tolist()]


# --- Joints that move -----------------------------------------------------------------------------------------------


def joint_marks(scene: Scene, *, flat: bool = True) -> list[Mark]:
    """What opens, slides, crushes and turns in the motion as drawn; nothing of a structure at rest.

    flat : in a plane every joint that moves; else, where they would be drawn one behind another, the cracks between the
           parts of the listing, with their hinge lines and sliding planes
    """
    joints, contacts = scene.joint_motion, scene.contacts
    if joints is None or not len(contacts) or not scene.motion.any():
        return []
    names = interface_names(scene.model, contacts)
    slides = np.isin(joints.modes, (InterfaceMode.SLIDE, InterfaceMode.TWIST))
    opens = np.isin(joints.modes, (InterfaceMode.OPEN, InterfaceMode.HINGE))
    if not flat:
        slips = _slips(scene, joints, np.flatnonzero(slides & scene.apart), names)
        crushing = _outlines("crushing", CRUSH, contacts, joints.crushes & scene.apart, names)
        opening = replace(_opening(contacts, opens & scene.apart, names), covered=True)
        found = [opening, cracks(scene, names), *slips, crushing, _hinges(scene, joints, names, scene.apart)]
        return [mark for mark in found if len(mark.pairs)]
    found = [
        _opening(contacts, opens, names),
        _outlines("sliding", SLIDE, contacts, slides, names),
        *_slips(scene, joints, np.flatnonzero(slides), names),
        _outlines("crushing", CRUSH, contacts, joints.crushes, names),
        _hinges(scene, joints, names),
    ]
    return [mark for mark in found if len(mark.pairs)]


def interface_sides(contacts: Contacts, chosen: BoolArray) -> IntArray:
    """Sides of the outer boundaries of chosen interfaces, as pairs of contact points, (n, 2)."""
    first, corners = contacts.point_start[contacts.interface_of_point], contacts.outline[contacts.interface_of_point]
    rows = np.arange(len(contacts.points))
    following = np.where(rows - first + 1 < corners, rows + 1, first)
    on_outline = chosen[contacts.interface_of_point] & (rows - first < corners)
    return np.column_stack([rows, following])[on_outline]


def outer_rows(sides: FloatArray, size: float, of: IntArray | None = None) -> BoolArray:
    """Which sides, (n, 2, 3) m, no other has too, of the same (n, k) where that is given; ``size`` of the model, m."""
    ends = np.rint(sides / (SAME_PLACE * size)).astype(np.int64)
    later = np.array([one > other for one, other in ends.tolist()], dtype=bool)
    ends[later] = ends[later, ::-1]
    keys = ends.reshape(len(ends), 6)
    keys = keys if of is None else np.hstack([keys, of])
    _, row, times = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(times[row.ravel()] == 1)


def cracks(scene: Scene, names: Sequence[str]) -> Mark:
    """Outlines of the surfaces in which parts of the listing come apart, as part of the blocks of both sides.

    A side that two interfaces of one surface share lies within it.
    """
    contacts = scene.contacts
    sides = interface_sides(contacts, scene.apart)
    of_body = np.append(scene.clusters, np.zeros(len(scene.model.grounds), dtype=np.int64))
    owners = contacts.interface_of_point[sides[:, 0]]
    parts = np.sort(of_body[contacts.bodies[owners]], axis=1)
    outer = outer_rows(contacts.points[sides], scene.size, parts)
    sides, owners = np.tile(sides[outer], (2, 1)), np.tile(owners[outer], 2)
    bodies = contacts.bodies[owners[: len(owners) // 2]].T.ravel()
    texts = [f"crack: {names[owner]}" for owner in owners.tolist()]
    both = np.column_stack([bodies, bodies])
    mark = segments("crack", INK, contacts.points[sides], both, texts, np.full(len(sides), THIN))
    return replace(mark, covered=True)


def _outlines(name: str, colour: str, contacts: Contacts, chosen: BoolArray, names: list[str]) -> Mark:
    sides = interface_sides(contacts, chosen)
    owners = contacts.interface_of_point[sides[:, 0]]
    texts = [f"{name}: {names[row]}" for row in owners.tolist()]
    return segments(name, colour, contacts.points[sides], contacts.bodies[owners], texts, np.full(len(sides), THIN))


def _opening(contacts: Contacts, chosen: BoolArray, names: list[str]) -> Mark:
    """Segments from corners of interfaces as part of body a to the same as part of body b, and the areas between."""
    sides = interface_sides(contacts, chosen)
    corners, row = np.unique(sides, return_inverse=True)
    row = row.reshape(sides.shape)
    owners = np.tile(contacts.interface_of_point[corners], 2)
    of_a, of_b = contacts.bodies[contacts.interface_of_point[corners]].T
    body, count = np.concatenate([of_a, of_b]), len(corners)
    return Mark(
        "opening",
        OPEN,
        np.tile(contacts.points[corners], (2, 1)),
        np.column_stack([body, body]),
        np.column_stack([np.arange(count), count + np.arange(count)]),
        np.full(count, THIN),
        tuple(f"opening: {names[owner]}" for owner in owners.tolist()),
        np.column_stack([row[:, 0], row[:, 1], count + row[:, 1], count + row[:, 0]]),
    )


def _hinges(scene: Scene, joints: InterfaceMotion, names: list[str], chosen: BoolArray | None = None) -> Mark:
    """Axes of the interfaces, or of chosen ones, that open about one; those on hinge lines of the listing are thick."""
    rows = np.flatnonzero((joints.modes == InterfaceMode.HINGE) & (True if chosen is None else chosen))
    widths = np.ones(len(rows))
    if scene.failure is not None:
        listed = [row for line in scene.failure.hinge_lines for row in line.interfaces.tolist()]
        widths = np.where(np.isin(rows, listed), 1.0, THIN)
    texts = [f"hinge: {names[row]}" for row in rows.tolist()]
    return segments("hinge", HINGE, joints.hinge_ends[rows], scene.contacts.bodies[rows], texts, widths)


def _slips(scene: Scene, joints: InterfaceMotion, sliding: IntArray, names: list[str]) -> list[Mark]:
    """How one part goes over the other, in the middle of each sliding plane of the listing: an arrow or a ring.

    It is that of the part which moves, of two that do the lighter one, as in the listing.
    """
    contacts = scene.contacts
    rows = sliding
    if scene.failure is not None:
        least = LEAST_SHARE * max((plane.share for plane in scene.failure.sliding_planes), default=0.0)
        found_planes = [plane for plane in scene.failure.sliding_planes if plane.share >= least][:MOST_PLANES]
        planes = [(plane.interfaces, plane.centroid) for plane in found_planes]
        away = [np.linalg.norm(contacts.centroids[each] - centre, axis=1) / scene.size for each, centre in planes]
        nearest = [each[np.argmin(np.round(far, 9))] for (each, _), far in zip(planes, away, strict=True)]
        rows = np.array(nearest, dtype=np.int64)
    a, b = np.append(scene.clusters, np.zeros(len(scene.model.grounds), dtype=np.int64))[contacts.bodies[rows]].T
    sign = np.where(b >= a, 1.0, -1.0)[:, None]  # motions of joints are those of body b over body a
    normals, texts = contacts.normals[rows], [f"sliding: {names[row]}" for row in rows.tolist()]
    travel = sign * joints.translation[rows]
    travel = travel - np.einsum("ij,ij->i", travel, normals)[:, None] * normals
    spin = np.einsum("ij,ij->i", sign * joints.rotation[rows], normals)
    length = np.linalg.norm(travel, axis=1)
    reach = np.sqrt(contacts.areas[rows])
    twists = (joints.modes[rows] == InterfaceMode.TWIST) & (spin != 0)
    goes = ~twists & (length > 0)
    half = travel[goes] / length[goes, None] * np.maximum(0.4 * reach[goes], LEAST_SLIP * scene.size)[:, None]
    bodies, centres = contacts.bodies[rows], contacts.centroids[rows]
    labels = [text for text, chosen in zip(texts, goes, strict=True) if chosen]
    found = [arrows("sliding", SLIDE, centres[goes] + half, 2 * half, bodies[goes], labels)]
    if twists.any():
        axes = np.sign(spin[twists])[:, None] * normals[twists]
        found += rings("sliding", SLIDE, centres[twists], axes, 0.35 * reach[twists], bodies[twists], "twisting")
    return found


# --- Forces ---------------------------------------------------------------------------------------------------------


def force_marks(scene: Scene, *, proportional: bool = False) -> list[Mark]:
    """Resultants of interfaces, the thicker, or the longer, the larger; lines of thrust; joints that are used up."""
    thrust, use = scene.thrust, scene.torsion_use
    if thrust is None or use is None or not thrust.carried.any():
        return []
    contacts, rows = scene.contacts, drawn_resultants(scene)
    texts = force_texts(scene)
    sizes = np.linalg.norm(thrust.forces, axis=1)
    blocks = np.append(scene.model.blocks.sizes, np.full(len(scene.model.grounds), np.inf))
    sides = np.minimum(blocks[contacts.bodies[rows]].min(axis=1), 0.2 * scene.size)
    half = SIDE / 2 * sides[:, None] * thrust.forces[rows] / sizes[rows, None]
    if proportional:
        half = LONGEST / 2 * scene.size * thrust.forces[rows] / sizes.max()
    ends = np.stack([scene.thrust_points[rows] - half, scene.thrust_points[rows] + half], axis=1)
    largest = f"resultant, section in proportion to the force, largest {number(float(sizes.max()))}"
    labels, widths = [texts[row] for row in rows.tolist()], THICKEST * np.sqrt(sizes[rows] / sizes[rows].max())
    name = f"{largest} {scene.model.units.force}"
    rods = segments(name, RESULTANT, ends, contacts.bodies[rows], labels, widths)
    found = [replace(rods, inside=True), *thrust_lines(scene, texts)]
    off = thrust.eccentricity
    for label, colour, chosen in (
        ("outside the middle third", ORANGE, (off > MIDDLE_THIRD) & (off < EDGE)),
        ("at the edge of the joint", HINGE, (off >= EDGE) & (off <= OUTSIDE)),
        ("outside the joint (tension), drawn at its edge", PURPLE, off > OUTSIDE),
        ("all friction used", SLIDE, use >= USED),
    ):
        at = np.flatnonzero(chosen & thrust.carried)
        found.append(dots(label, colour, scene.thrust_points[at], contacts.bodies[at], [texts[row] for row in at]))
    return [mark for mark in found if len(mark.pairs)]


def drawn_resultants(scene: Scene) -> IntArray:
    """Interfaces whose resultants are drawn, (n,), in their order: the largest ones above the least share."""
    assert scene.thrust is not None  # asked for where there are forces
    sizes = np.where(scene.thrust.carried, np.linalg.norm(scene.thrust.forces, axis=1), 0.0)
    order = np.argsort(-sizes, kind="stable")[:MOST]
    return np.sort(order[sizes[order] > LEAST * sizes.max(initial=0.0)])


def thrust_lines(scene: Scene, texts: Sequence[str]) -> list[Mark]:
    """Lines of thrust; of a force that is sought those of its other end as well, between which all others lie."""
    question, other = scene.case.load_case.question, scene.other_end
    if question.collapses:
        return [thrust_line(scene, texts, "line of thrust", THRUST)]
    found = [thrust_line(scene, texts, f"line of thrust, {question.what}", THRUST)]
    if other is not None and other.thrust is not None:
        name = f"line of thrust, {other.case.load_case.question.what}"
        found.append(thrust_line(other, force_texts(other), name, OTHER_END, OTHER_LINE))
    return found


LINE, OTHER_LINE = 0.4, 1.0
"""thickness of lines of thrust that run inside resultants, and of those beside them"""


def thrust_line(scene: Scene, texts: Sequence[str], name: str, colour: str, width: float = LINE) -> Mark:
    """Lines of thrust along chains of blocks."""
    none = np.zeros((0, 2), dtype=np.int64)
    steps = np.concatenate([none, *(np.column_stack([line[:-1], line[1:]]) for line in scene.lines)])
    used, row = np.unique(steps, return_inverse=True)
    pairs = row.reshape(steps.shape)
    labels = tuple(texts[i] for i in used.tolist())
    points, bodies = scene.thrust_points[used], scene.contacts.bodies[used]
    return Mark(name, colour, points, bodies, pairs, np.full(len(pairs), width), labels, inside=True)


def force_texts(scene: Scene) -> list[str]:
    """Of every interface its forces in words."""
    thrust, unit = scene.thrust, scene.model.units.force
    assert thrust is not None  # asked for where there are forces
    columns = (thrust.normal_forces.tolist(), thrust.shear_forces.tolist(), thrust.eccentricity.tolist())
    return [
        f"{name}: normal force {number(normal)} {unit}, shear {number(shear)} {unit}, eccentricity {number(off)}"
        for name, normal, shear, off in zip(interface_names(scene.model, scene.contacts), *columns, strict=True)
    ]
