"""Marks of a view: joints that move, forces, loads, as segments between points.

Every point is one that two bodies carry along: it moves as the mean of both. So the browser can move marks together
with the blocks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine
from mbla.results.collapse.thrust import OUTSIDE, Thrust
from mbla.results.listing.text import counted, number
from mbla.results.pictures.load_marks import LONGEST as LONGEST_LOAD
from mbla.results.pictures.load_marks import arrow_above, arrow_steps, settlement_arrow
from mbla.results.pictures.page import HINGE, LIVE_LOAD, OPEN, SLIDE
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.shown_loads import live_load
from mbla.solution.solution import ContactMode

THRUST, RESULTANT = "#0A2FD0", "#5B1A8B"
"""dark, to be seen through pale blocks"""
LONGEST = 0.2
"""length of the largest resultant over the size of the model"""
SMALLEST = 1e-3
"""share of the largest resultant below which none is drawn"""
HEAD, BREADTH = 0.22, 0.08
"""of an arrow: length and half breadth of its head over its length"""
BARBS = ((0, 1), (1, 2), (1, 3), (1, 4), (1, 5))
"""shaft and barbs of an arrow as rows of its start, its tip and the ends of its barbs"""
TURN = 24
"""segments of the ring of a moment"""


@dataclass(frozen=True)
class Mark:
    """Line segments of one kind.

    points  : (n, 3) m
    bodies  : (n, 2) bodies whose mean motion each point follows, -1 for none
    pairs   : (k, 2) segments as rows of ``points``; both the same for a dot
    texts   : (n) what the browser says of each point
    inside  : it lies within the blocks and is seen only through them
    """

    name: str
    colour: str
    width: int
    points: FloatArray
    bodies: IntArray
    pairs: IntArray
    texts: tuple[str, ...]
    inside: bool = False
    dots: bool = False


def marks_of(scene: Scene) -> list[Mark]:
    """Marks of the mechanism, of the forces and of the live load, those there are."""
    found = _loads(scene)
    if len(scene.contacts):
        names = interface_names(scene.model, scene.contacts)
        found = [*_joints(scene, names), *_forces(scene, names), *found]
    return [mark for mark in found if len(mark.pairs)]


def interface_names(model: Model, contacts: Contacts) -> list[str]:
    """``arch[3] | arch[4]`` for every interface."""
    return [f"{model.body_name(a)} | {model.body_name(b)}" for a, b in contacts.bodies.tolist()]


# --- Joints ---------------------------------------------------------------------------------------------------------


def _joints(scene: Scene, names: list[str]) -> list[Mark]:
    """Hinge lines, hinges of single interfaces, outlines of those that slide or twist, and corners that part."""
    mechanics, failure, contacts = scene.mechanics, scene.failure, scene.contacts
    if mechanics is None or failure is None or scene.interfaces is None or not scene.motion.any():
        return []
    modes = scene.interfaces.modes
    opened = mechanics.modes == ContactMode.OPEN
    hinge = (modes == InterfaceMode.HINGE)[contacts.interface_of_point] & ~opened
    axes = hinge_axes(contacts, hinge)
    alone = np.setdiff1d(np.flatnonzero(hinge), axes)
    hinges = np.vstack([axes, np.column_stack([alone, alone])])
    sliding = interface_sides(contacts, np.isin(modes, (InterfaceMode.SLIDE, InterfaceMode.TWIST)))
    return [
        _hinge_lines(scene, failure.hinge_lines),
        _on_contacts("hinges", HINGE, contacts, hinges, names, True),
        _on_contacts("sliding", SLIDE, contacts, sliding, names, False),
        _openings(contacts, opened, names),
    ]


def hinge_axes(contacts: Contacts, chosen: BoolArray) -> IntArray:
    """Chosen points that follow each other on one interface, as pairs of points, (n, 2)."""
    rows = np.flatnonzero(chosen)
    owners = contacts.interface_of_point[rows]
    chained = owners[1:] == owners[:-1]
    return np.column_stack([rows[:-1][chained], rows[1:][chained]])


def interface_sides(contacts: Contacts, chosen: BoolArray) -> IntArray:
    """Sides of the outer boundaries of chosen interfaces, as pairs of points, (n, 2)."""
    first, corners = contacts.point_start[contacts.interface_of_point], contacts.outline[contacts.interface_of_point]
    rows = np.arange(len(contacts.points))
    following = np.where(rows - first + 1 < corners, rows + 1, first)
    on_outline = chosen[contacts.interface_of_point] & (rows - first < corners)
    return np.column_stack([rows, following])[on_outline]


def _hinge_lines(scene: Scene, lines: Sequence[HingeLine]) -> Mark:
    """Each from end to end; it moves with the two bodies of its first interface, as its clusters are rigid."""
    points = np.array([end for line in lines for end in (line.start, line.end)]).reshape(-1, 3)
    texts = tuple(text for line in lines for text in 2 * (_hinge_words(scene.model, line),))
    first = np.repeat(np.array([line.interfaces[0] for line in lines], dtype=np.int64), 2)
    pairs = np.arange(len(points)).reshape(-1, 2)
    return Mark("hinge lines", HINGE, 14, points, scene.contacts.bodies[first], pairs, texts, dots=True)


def _hinge_words(model: Model, line: HingeLine) -> str:
    """``hinge line of part 1 on the stationary blocks: 8 interfaces, 3.2 m``."""
    one, other = line.clusters
    beside = f"part {other}" if other else "the stationary blocks"
    count = counted(len(line.interfaces), "interface")
    return f"hinge line of part {one} on {beside}: {count}, {number(line.length)} {model.units.length}"


def _on_contacts(name: str, colour: str, contacts: Contacts, pairs: IntArray, names: list[str], dots: bool) -> Mark:
    """Segments between contact points, given by their rows."""
    used, row = np.unique(pairs, return_inverse=True)
    owners = contacts.interface_of_point[used]
    texts = tuple(f"{name}: {names[i]}" for i in owners.tolist())
    bodies = contacts.bodies[owners]
    return Mark(name, colour, 6, contacts.points[used], bodies, row.reshape(pairs.shape), texts, dots=dots)


def _openings(contacts: Contacts, opened: BoolArray, names: list[str]) -> Mark:
    """Segments from an open contact point as part of body a to the same point as part of body b."""
    rows = np.repeat(np.flatnonzero(opened), 2)
    owners = contacts.interface_of_point[rows]
    body = contacts.bodies[owners, np.arange(len(rows)) % 2]
    texts = tuple(f"opening: {names[i]}" for i in owners.tolist())
    pairs = np.arange(len(rows)).reshape(-1, 2)
    return Mark("opening", OPEN, 4, contacts.points[rows], np.column_stack([body, body]), pairs, texts)


# --- Forces ---------------------------------------------------------------------------------------------------------


def _forces(scene: Scene, names: list[str]) -> list[Mark]:
    """Lines of thrust where blocks form rows, and the resultant of every interface as an arrow through its point."""
    thrust = scene.thrust
    if thrust is None:
        return []
    texts = _force_texts(scene, thrust, names)
    none = np.zeros((0, 2), dtype=np.int64)
    pairs = np.concatenate([none, *(np.column_stack([line[:-1], line[1:]]) for line in scene.lines)])
    used, row = np.unique(pairs, return_inverse=True)
    told = tuple(texts[i] for i in used.tolist())
    points, bodies = scene.thrust_points[used], scene.contacts.bodies[used]
    line = Mark("line of thrust", THRUST, 8, points, bodies, row.reshape(pairs.shape), told, inside=True)
    return [line, _resultants(scene, thrust, texts)]


def _resultants(scene: Scene, thrust: Thrust, texts: list[str]) -> Mark:
    """Arrows with their middle at the point of application or the edge next to it: the force on the lower of both."""
    contacts, strengths = scene.contacts, np.linalg.norm(thrust.forces, axis=1)
    largest = strengths[thrust.carried].max(initial=0.0)
    rows = np.flatnonzero(thrust.carried & (strengths > SMALLEST * largest))
    lower = _lower_side(scene)[rows]
    steps = LONGEST * scene.size / (largest or 1.0) * np.where(lower == 1, 1.0, -1.0)[:, None] * thrust.forces[rows]
    bodies = contacts.bodies[rows, lower].tolist()
    told = [f"{texts[row]}; force on {scene.model.body_name(body)}" for row, body in zip(rows, bodies, strict=True)]
    starts = scene.thrust_points[rows] - steps / 2
    return _arrows("resultants", RESULTANT, 5, starts, steps, contacts.bodies[rows], told, inside=True)


def _lower_side(scene: Scene) -> IntArray:
    """Which body of each interface lies lower, 0 or 1, by the heights of centroids; a ground lies under everything."""
    heights = np.append(scene.model.blocks.centroids[:, 2], np.full(len(scene.model.grounds), -np.inf))
    below = heights[scene.contacts.bodies]
    return np.asarray(np.where(below[:, 0] < below[:, 1], 0, 1))


def _force_texts(scene: Scene, thrust: Thrust, names: list[str]) -> list[str]:
    unit = scene.model.units.force
    columns = (thrust.normal_forces.tolist(), thrust.shear_forces.tolist(), thrust.eccentricity.tolist())
    return [
        f"{name}: normal force {number(normal)} {unit}, shear {number(shear)} {unit}, eccentricity {number(off)}"
        + (": outside the joint, drawn at its edge" if off > OUTSIDE else "")
        for name, normal, shear, off in zip(names, *columns, strict=True)
    ]


def _arrows(
    name: str, colour: str, width: int, starts: FloatArray, steps: FloatArray, bodies: IntArray, texts: Sequence[str],
    inside: bool = False,
) -> Mark:  # fmt: skip
    """Arrows of a shaft and four barbs; starts and steps (n, 3) m, bodies (n, 2)."""
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    along = steps / lengths
    side = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    other = np.cross(along, side)
    tips = starts + steps
    barbs = [tips + lengths * (-HEAD * along + BREADTH * across) for across in (side, -side, other, -other)]
    points = np.stack([starts, tips, *barbs], axis=1)
    count = points.shape[1]
    pairs = (count * np.arange(len(starts))[:, None, None] + np.array(BARBS)).reshape(-1, 2)
    told = tuple(text for text in texts for _ in range(count))
    return Mark(name, colour, width, points.reshape(-1, 3), np.repeat(bodies, count, axis=0), pairs, told, inside)


# --- Loads ----------------------------------------------------------------------------------------------------------


def _loads(scene: Scene) -> list[Mark]:
    """The live load where it acts, one arrow for an acceleration, or the way that a support gives."""
    case, blocks, size = scene.case.load_case, scene.model.blocks, scene.size
    if case.settlement is not None:
        way = case.settlement.motions[:, :3].mean(axis=0)
        if not way.any():
            return []
        vertices = blocks.vertices[np.isin(blocks.block_of_vertex, case.settlement.blocks)]
        start, step = settlement_arrow(vertices, way, size)
        bodies = np.full((1, 2), case.settlement.blocks[0])
        return [_arrows("settlement", LIVE_LOAD, 8, start[None], step[None], bodies, [case.settlement.words])]
    load = live_load(scene, case, "live load", LIVE_LOAD)
    marks, words = load.marks, load.text
    found = []
    if len(marks.blocks):
        steps = arrow_steps(marks.forces, marks.largest, size)
        bodies = np.column_stack([marks.blocks, marks.blocks])
        found.append(_arrows("live load", LIVE_LOAD, 6, marks.tips - steps, steps, bodies, [words] * len(steps)))
    if marks.uniform and marks.acceleration.any():
        top = float(max(scene.moved[:, 2].max(), blocks.vertices[:, 2].max())) + 0.05 * size
        start, step = arrow_above(blocks, marks, top, size)
        found.append(_arrows("live load", LIVE_LOAD, 8, start[None], step[None], np.full((1, 2), -1), [words]))
    if len(marks.moment_blocks):
        found.append(_rings(scene, marks.moment_blocks, marks.moments, words))
    return found


def _rings(scene: Scene, rows: IntArray, moments: FloatArray, words: str) -> Mark:
    """Three quarters of a ring about the centroid of each block, and a dot at its end."""
    axes = moments / np.linalg.norm(moments, axis=1, keepdims=True)
    across = np.cross(axes, np.eye(3)[np.argmin(np.abs(axes), axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    angle = np.linspace(0.0, 1.5 * np.pi, TURN + 1)[:, None]
    reach = np.minimum(0.6 * scene.model.blocks.sizes[rows], LONGEST_LOAD * scene.size)[:, None, None]
    arms = np.cos(angle) * across[:, None] + np.sin(angle) * np.cross(axes, across)[:, None]
    points = (scene.model.blocks.centroids[rows][:, None] + reach * arms).reshape(-1, 3)
    bodies = np.repeat(np.column_stack([rows, rows]), TURN + 1, axis=0)
    step = np.append(np.arange(TURN), TURN)
    pairs = np.column_stack([step, np.minimum(step + 1, TURN)])
    every = (pairs[None] + (TURN + 1) * np.arange(len(rows))[:, None, None]).reshape(-1, 2)
    return Mark("moment of the live load", LIVE_LOAD, 6, points, bodies, every, (words,) * len(points))
