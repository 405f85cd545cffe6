"""Marks of a view: loads, supports, hinge lines, thrust and the arrow of the load, as points and triangles.

Every mark is a set of line segments between points that the two bodies of an interface carry along: the point moves as
the mean of both. So the browser can move marks together with the blocks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model, Settlement
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine
from mbla.results.collapse.thrust import OUTSIDE, Thrust, points_to_draw, thrust_lines, thrust_of
from mbla.results.listing.text import counted, number
from mbla.results.pictures.geometry import hinge_axes, interface_sides, live_load_arrow
from mbla.solution.solution import ContactMode, Mechanics

HINGE, SLIDE, OPEN = "#D55E00", "#009E73", "#CC79A7"
"""after Okabe and Ito, as in the pictures"""
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


@dataclass(frozen=True)
class Mark:
    """Line segments of one kind.

    points  : (n, 3) m
    bodies  : (n, 2) bodies whose mean motion each point follows
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


def mechanism_marks(
    model: Model, contacts: Contacts, mechanics: Mechanics, collapse: Collapse, lines: Sequence[HingeLine]
) -> list[Mark]:
    """Hinge lines, hinges of single interfaces, outlines of those that slide or twist, and corners that part.

    Those there are. Corners that part are joined by lines.
    """
    modes = collapse.interfaces.modes
    owners = contacts.interface_of_point
    opened = mechanics.modes == ContactMode.OPEN
    hinge = (modes == InterfaceMode.HINGE)[owners] & ~opened
    axes = hinge_axes(contacts, hinge)
    alone = np.setdiff1d(np.flatnonzero(hinge), axes)
    sliding = interface_sides(contacts, (modes == InterfaceMode.SLIDE) | (modes == InterfaceMode.TWIST))
    names = interface_names(model, contacts)
    return [
        mark
        for mark in (
            _hinge_lines(model, contacts, lines),
            _on_contacts("hinges", HINGE, 6, contacts, np.vstack([axes, np.column_stack([alone, alone])]), names, True),
            _on_contacts("sliding", SLIDE, 6, contacts, sliding, names, False),
            _openings(contacts, opened, names),
        )
        if len(mark.pairs)
    ]


def _hinge_lines(model: Model, contacts: Contacts, lines: Sequence[HingeLine]) -> Mark:
    """Each from end to end; it moves with the two bodies of its first interface, as its clusters are rigid."""
    points = np.array([end for line in lines for end in (line.start, line.end)]).reshape(-1, 3)
    texts = tuple(text for line in lines for text in 2 * (_hinge_words(model, line),))
    first = np.repeat(np.array([line.interfaces[0] for line in lines], dtype=np.int64), 2)
    pairs = np.arange(len(points)).reshape(-1, 2)
    return Mark("hinge lines", HINGE, 14, points, contacts.bodies[first], pairs, texts, dots=True)


def _hinge_words(model: Model, line: HingeLine) -> str:
    """``hinge line of part 1 on what rests: 8 interfaces, 3.2 m``."""
    one, other = line.clusters
    beside = f"part {other}" if other else "the stationary blocks"
    count = counted(len(line.interfaces), "interface")
    return f"hinge line of part {one} on {beside}: {count}, {number(line.length)} {model.units.length}"


def interface_names(model: Model, contacts: Contacts) -> list[str]:
    """``arch[3] | arch[4]`` for every interface."""
    return [f"{model.body_name(a)} | {model.body_name(b)}" for a, b in contacts.bodies.tolist()]


def _on_contacts(
    name: str, colour: str, width: int, contacts: Contacts, pairs: IntArray, names: list[str], dots: bool
) -> Mark:
    """Segments between contact points, given by their rows."""
    used, row = np.unique(pairs, return_inverse=True)
    owners = contacts.interface_of_point[used]
    texts = tuple(f"{name}: {names[i]}" for i in owners.tolist())
    bodies = contacts.bodies[owners]
    return Mark(name, colour, width, contacts.points[used], bodies, row.reshape(pairs.shape), texts, dots=dots)


def _openings(contacts: Contacts, opened: BoolArray, names: list[str]) -> Mark:
    """Segments from an open contact point as part of body a to the same point as part of body b."""
    rows = np.repeat(np.flatnonzero(opened), 2)
    owners = contacts.interface_of_point[rows]
    side = np.arange(len(rows)) % 2
    body = contacts.bodies[owners, side]
    texts = tuple(f"opening: {names[i]}" for i in owners.tolist())
    pairs = np.arange(len(rows)).reshape(-1, 2)
    return Mark("opening", OPEN, 4, contacts.points[rows], np.column_stack([body, body]), pairs, texts)


def force_marks(model: Model, contacts: Contacts, forces: FloatArray, size: float) -> list[Mark]:
    """Lines of thrust where blocks form rows, and the resultant of every interface as an arrow through its point.

    forces : (n_points, 3) contact forces
    size   : of the model, m
    """
    thrust = thrust_of(model, contacts, forces)
    texts = _force_texts(model, contacts, thrust)
    chains = thrust_lines(model, contacts, thrust)
    none = np.zeros((0, 2), dtype=np.int64)
    pairs = np.concatenate([none, *(np.column_stack([chain[:-1], chain[1:]]) for chain in chains)])
    used, row = np.unique(pairs, return_inverse=True)
    line = Mark(
        "line of thrust",
        THRUST,
        8,
        points_to_draw(contacts, thrust)[used],
        contacts.bodies[used],
        row.reshape(pairs.shape),
        tuple(texts[i] for i in used.tolist()),
        inside=True,
    )
    return [mark for mark in (line, _resultants(model, contacts, thrust, texts, size)) if len(mark.pairs)]


def _resultants(model: Model, contacts: Contacts, thrust: Thrust, texts: list[str], size: float) -> Mark:
    """Arrows with their middle at the point of application or the edge next to it: the force on the lower of both."""
    strengths = np.linalg.norm(thrust.forces, axis=1)
    largest = strengths[thrust.carried].max(initial=0.0)
    rows = np.flatnonzero(thrust.carried & (strengths > SMALLEST * largest))
    lower = lower_side(model, contacts)[rows]
    steps = LONGEST * size / (largest or 1.0) * np.where(lower == 1, 1.0, -1.0)[:, None] * thrust.forces[rows]
    points = arrows(points_to_draw(contacts, thrust)[rows] - steps / 2, steps)
    count = points.shape[1]
    bodies = contacts.bodies[rows, lower].tolist()
    told = [f"{texts[row]}; force on {model.body_name(body)}" for row, body in zip(rows, bodies, strict=True)]
    return Mark(
        "resultants",
        RESULTANT,
        5,
        points.reshape(-1, 3),
        np.repeat(contacts.bodies[rows], count, axis=0),
        (count * np.arange(len(rows))[:, None, None] + np.array(BARBS)).reshape(-1, 2),
        tuple(text for text in told for _ in range(count)),
        inside=True,
    )


def lower_side(model: Model, contacts: Contacts) -> IntArray:
    """Which body of each interface lies lower, 0 or 1, by the heights of centroids; a ground lies under everything."""
    heights = np.append(model.blocks.centroids[:, 2], np.full(len(model.grounds), -np.inf))[contacts.bodies]
    return np.asarray(np.where(heights[:, 0] < heights[:, 1], 0, 1))


def arrows(starts: FloatArray, steps: FloatArray) -> FloatArray:
    """Start, tip and the ends of four barbs of each arrow, (n, 6, 3), from (n, 3) each; pairs are ``BARBS``."""
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    along = steps / lengths
    side = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    other = np.cross(along, side)
    tips = starts + steps
    barbs = [tips + lengths * (-HEAD * along + BREADTH * across) for across in (side, -side, other, -other)]
    return np.stack([starts, tips, *barbs], axis=1)


def _force_texts(model: Model, contacts: Contacts, thrust: Thrust) -> list[str]:
    unit = model.units.force
    names = interface_names(model, contacts)
    columns = (thrust.normal_forces.tolist(), thrust.shear_forces.tolist(), thrust.eccentricity.tolist())
    return [
        f"{name}: normal force {number(normal)} {unit}, shear {number(shear)} {unit}, eccentricity {number(off)}"
        + (": outside the joint, drawn at its edge" if off > OUTSIDE else "")
        for name, normal, shear, off in zip(names, *columns, strict=True)
    ]


def block_eccentricity(model: Model, contacts: Contacts, forces: FloatArray) -> FloatArray:
    """Greatest eccentricity among the interfaces of each block, (n_blocks,); nan where none carries a force."""
    eccentricity = thrust_of(model, contacts, forces).eccentricity
    greatest = np.full(len(model.blocks) + len(model.grounds), np.nan)
    np.fmax.at(greatest, contacts.bodies.ravel(), np.repeat(eccentricity, 2))
    return greatest[: len(model.blocks)]


# --- The arrow of a live load ---------------------------------------------------------------------------------------


BESIDE = 0.35
"""distance of the arrow of a settlement from its support over the length of the arrow"""
CENTRAL = 0.05
"""distance from the middle of the structure over its extent up to which a support has no outer side"""
FRONT = np.array([0.0, -1.0, 0.0])
"""side on which the arrow of a central support stands, or of one that turns about its middle"""


@dataclass(frozen=True)
class LoadArrow:
    """Segments of an arrow; none where the load has no direction.

    points : (n, 3) m
    pairs  : (k, 2) segments as rows of ``points``
    block  : that it moves with, -1 for none
    """

    name: str
    points: FloatArray
    pairs: IntArray
    block: int


def load_arrow(model: Model, load_case: LoadCase, low: FloatArray, high: FloatArray, length: float) -> LoadArrow:
    """The arrow of a load case; the box from ``low`` to ``high``, (3,) m, is around what is drawn."""
    settlement = load_case.settlement
    if settlement is None:
        start, tip = live_load_arrow(model, load_case, low, high, length)
        return _arrow("live load", start, tip - start, -1)
    start, step = _beside(model, settlement, length)
    return _arrow("settlement", start, step, int(settlement.blocks[0]))


def _beside(model: Model, settlement: Settlement, length: float) -> tuple[FloatArray, FloatArray]:
    """Start and step at the outer side of the support, so that its blocks do not hide it; no step where it spins."""
    blocks = model.blocks
    way = settlement.motions[:, :3].mean(axis=0)
    size = float(np.linalg.norm(way))
    if size == 0.0:
        return blocks.centroids[settlement.blocks].mean(axis=0), np.zeros(3)
    corners = blocks.vertices[np.isin(blocks.block_of_vertex, settlement.blocks)]
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    away = middle - (blocks.vertices.min(axis=0) + blocks.vertices.max(axis=0)) / 2
    away[2] = 0.0
    axis = int(np.argmax(np.abs(away)))
    outwards = np.sign(away[axis]) * np.eye(3)[axis]
    if abs(away[axis]) <= CENTRAL * float(np.ptp(blocks.vertices[:, :2], axis=0).max()):
        outwards = FRONT
    reach = float(((corners - middle) @ outwards).max())
    step = length * way / size
    return middle + (reach + BESIDE * length) * outwards - step / 2 + max(step @ -outwards, 0.0) * outwards, step


def _arrow(name: str, start: FloatArray, step: FloatArray, block: int) -> LoadArrow:
    if not step.any():
        return LoadArrow(name, np.array([start, start]), np.zeros((0, 2), dtype=np.int64), -1)
    return LoadArrow(
        name, arrows(start[None], step[None])[0], np.array([*BARBS, (2, 4), (4, 3), (3, 5), (5, 2)]), block
    )
