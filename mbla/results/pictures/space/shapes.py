"""Shapes of a picture in space, drawings made of them, and the structure as such."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.pictures import page
from mbla.results.pictures.geometry import SLAB_FACES, block_edges, edges_of_blocks
from mbla.results.pictures.page import GHOST, INK
from mbla.results.pictures.scene import Scene

SIDES = 12
"""of the prism that stands for a round rod"""


@dataclass(frozen=True)
class Faces:
    """Plane polygons.

    points  : (n, 3) m
    start   : (n_faces + 1,) corners of face f are loops[start[f]:start[f + 1]]
    loops   : (n_corners,) rows of ``points``
    colours : (n_faces, 3) red, green and blue from 0 to 1
    opacity : 1 hides what is behind
    lit     : shaded by the light, as solids are; marks that mean something by their colour are not
    ground  : left out where the eye is below it, as it would hide the rest
    """

    points: FloatArray
    start: IntArray
    loops: IntArray
    colours: FloatArray
    opacity: float = 1.0
    lit: bool = True
    ground: bool = False


@dataclass(frozen=True)
class Lines:
    """Straight lines.

    points : (n, 3) m
    pairs  : (m, 2) rows of ``points``
    colour : ``#rrggbb``
    width  : in pixels of a picture 1000 pixels high
    """

    points: FloatArray
    pairs: IntArray
    colour: str
    width: float
    opacity: float = 1.0


Shape = Faces | Lines
Entries = list[tuple[str, str]]
"""names of a legend with their colours"""


def rgb(colour: str) -> FloatArray:
    """Red, green and blue from 0 to 1 of ``#rrggbb``, (3,)."""
    return np.array(page.rgb(colour))


def painted(points: FloatArray, start: IntArray, loops: IntArray, colour: str, lit: bool = True) -> Faces:
    """Faces of one colour; points (n, 3) m, start (n_faces + 1,) and loops (n_corners,) as ``Faces`` has them."""
    return Faces(points, start, loops, np.tile(rgb(colour), (len(start) - 1, 1)), lit=lit)


def rods(starts: FloatArray, ends: FloatArray, radii: FloatArray, colours: FloatArray, lit: bool = True) -> Faces:
    """Round rods between points, (n, 3) m each, with radii (n,) m and colours (n, 3)."""
    return _turned(starts, ends, np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]), radii, colours, lit)


def arrows(starts: FloatArray, tips: FloatArray, radii: FloatArray, colours: FloatArray) -> Faces:
    """Arrows between points, (n, 3) m each; the radii, (n,) m, are those of the shafts."""
    lengths = np.linalg.norm(tips - starts, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        head = np.where(lengths > 0, np.minimum(7 * radii / lengths, 0.5), 0.0)
    profile = np.zeros((len(starts), 5, 2))
    profile[:, 1, 1] = profile[:, 2, 1] = 1.0
    profile[:, 2, 0] = profile[:, 3, 0] = 1 - head
    profile[:, 3, 1] = 2.8
    profile[:, 4, 0] = 1.0
    return _turned(starts, tips, profile, radii, colours, True)


def balls(centres: FloatArray, radii: FloatArray, colours: FloatArray) -> Faces:
    """Balls about centres, (n, 3) m, with radii (n,) m and colours (n, 3)."""
    angle = np.linspace(0, np.pi, SIDES // 2 + 1)
    profile = np.column_stack([(1 - np.cos(angle)) / 2, np.sin(angle)])
    reach = np.zeros_like(centres)
    reach[:, 2] = radii
    return _turned(centres - reach, centres + reach, profile, radii, colours, True)


def turning_arrows(
    centres: FloatArray, axes: FloatArray, reach: FloatArray, radius: float, colour: FloatArray
) -> Faces:
    """Arrows that run three quarters around axes by the right hand; centres and unit axes (n, 3), reach (n,) m."""
    across, other = _normals(axes)
    turn = np.linspace(0, 1.5 * np.pi, 25)
    points = centres[:, None] + reach[:, None, None] * (
        np.cos(turn)[:, None] * across[:, None] + np.sin(turn)[:, None] * other[:, None]
    )
    pieces = np.tile(colour, (len(centres) * 21, 1))
    thin = np.full(len(pieces), radius)
    ring = rods(points[:, :21].reshape(-1, 3), points[:, 1:22].reshape(-1, 3), thin, pieces)
    tips = arrows(points[:, 21], points[:, 24], np.full(len(centres), radius), np.tile(colour, (len(centres), 1)))
    return together([ring, tips])


def _turned(
    starts: FloatArray, ends: FloatArray, profile: FloatArray, radii: FloatArray, colours: FloatArray, lit: bool
) -> Faces:
    """Solids of revolution about lines.

    profile : (k, 2) or (n, k, 2) share of the way along the line, and share of the radius
    """
    n, k = len(starts), profile.shape[-2]
    profile = np.broadcast_to(profile, (n, k, 2))
    along = ends - starts
    across, other = _normals(along)
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    ring = np.cos(turn)[:, None] * across[:, None, :] + np.sin(turn)[:, None] * other[:, None, :]  # (n, SIDES, 3)
    centre = starts[:, None, :] + profile[:, :, :1] * along[:, None, :]  # (n, k, 3)
    reach = profile[:, :, 1] * radii[:, None]
    points = centre[:, :, None, :] + reach[:, :, None, None] * ring[:, None, :, :]  # (n, k, SIDES, 3)
    side = np.arange(SIDES)
    ahead = (side + 1) % SIDES
    quads = np.stack([side, ahead, ahead + SIDES, side + SIDES], axis=1)  # between one ring and the next
    quads = (quads[None] + SIDES * np.arange(k - 1)[:, None, None]).reshape(-1, 4)
    loops = (quads[None] + k * SIDES * np.arange(n)[:, None, None]).reshape(-1)
    return Faces(
        points.reshape(-1, 3),
        4 * np.arange(n * len(quads) + 1),
        loops,
        np.repeat(colours, len(quads), axis=0),
        lit=lit,
    )


def _normals(along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors across each line, (n, 3) each."""
    lengths = np.linalg.norm(along, axis=1, keepdims=True)
    unit = np.divide(along, lengths, out=np.tile([0.0, 0.0, 1.0], (len(along), 1)), where=lengths > 0)
    least = np.eye(3)[np.argmin(np.abs(unit), axis=1)] if len(unit) else np.zeros((0, 3))
    across = np.cross(unit, least)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return across, np.cross(unit, across)


def together(parts: Sequence[Faces]) -> Faces:
    """Faces of several shapes as one; opacity and light of the first."""
    offsets = np.cumsum([0, *(len(part.points) for part in parts)])
    corners = np.cumsum([0, *(len(part.loops) for part in parts)])
    return Faces(
        np.vstack([part.points for part in parts]),
        np.concatenate([[0], *(part.start[1:] + first for part, first in zip(parts, corners, strict=False))]),
        np.concatenate([part.loops + first for part, first in zip(parts, offsets, strict=False)]),
        np.vstack([part.colours for part in parts]),
        parts[0].opacity,
        parts[0].lit,
    )


# --- A spatial picture before it is rendered ------------------------------------------------------------------------


@dataclass(frozen=True)
class ColourScale:
    """A bar of colours with what it means, from ``low`` to ``high``; colours (n, 3) from the one to the other."""

    label: str
    low: float
    high: float
    colours: FloatArray


@dataclass(frozen=True)
class Drawing:
    """Shapes and how they are told.

    solid  : what hides things, the structure
    marks  : what shines through where the structure hides it
    loads  : marks of the whole, left out where a part of it is enlarged: their arrows are cut there
    shine  : strength of hidden marks, 0 to 1
    extent : (n, 3) m, what must fit into the picture
    legend : names and colours
    scale  : of colours, None without one
    notes  : further lines below the legend
    """

    solid: tuple[Shape, ...]
    marks: tuple[Shape, ...]
    shine: float
    extent: FloatArray
    legend: tuple[tuple[str, str], ...]
    scale: ColourScale | None = None
    notes: tuple[str, ...] = ()
    loads: tuple[Shape, ...] = ()

    def solid_from(self, elevation: float) -> tuple[Shape, ...]:
        """What hides things from an eye at an elevation in degrees: from below all but the ground."""
        if elevation >= 0:
            return self.solid
        return tuple(shape for shape in self.solid if not (isinstance(shape, Faces) and shape.ground))


# --- The structure in a spatial picture: blocks and their edges, ghost of what moves, ground ------------------------


MANY = 400
"""blocks from which edges are drawn thinner, and of the ghost only the outline"""
SLAB = "#C4C4C4"


def structure(scene: Scene, points: FloatArray, colours: Sequence[str], ink: str = INK) -> tuple[Shape, ...]:
    """Ground, blocks and their edges at given places of their vertices, (n_vertices, 3) m, a colour for each block."""
    width = 1.5 if len(scene.model.blocks) < MANY else 1.0
    edges = Lines(points, block_edges(scene.model.blocks), ink, width)
    return *grounds(scene), block_faces(scene, points, np.array([rgb(colour) for colour in colours])), edges


def block_faces(scene: Scene, points: FloatArray, colours: FloatArray, lit: bool = True) -> Faces:
    """Blocks at given places of their vertices, (n_vertices, 3) m, with the colour of each block, (n_blocks, 3)."""
    blocks = scene.model.blocks
    return Faces(points, blocks.loop_start, blocks.loops, colours[blocks.block_of_face], lit=lit)


def ghost_lines(scene: Scene, moving: BoolArray) -> Lines:
    """Edges of the blocks that move where they were; of many only those that bound them together.

    moving : (n_blocks,) True for them
    """
    blocks = scene.model.blocks
    edges = edges_of_blocks(blocks, block_edges(blocks), moving)
    if int(moving.sum()) > MANY:
        edges = _single(blocks.vertices, edges, 1e-6 * scene.size)
    return Lines(blocks.vertices, edges, GHOST, 1.1, 0.55)


def _single(points: FloatArray, edges: IntArray, size: float) -> IntArray:
    """Edges whose middle is that of no other edge: joints between blocks have at least two each."""
    middle = np.round((points[edges[:, 0]] + points[edges[:, 1]]) / 2 / size).astype(np.int64)
    _, row, count = np.unique(middle, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(edges[count[row.ravel()] == 1])


def grounds(scene: Scene) -> tuple[Faces | Lines, ...]:
    """Slabs of ground with their edges."""
    if not scene.slabs:
        return ()
    faces = [painted(corners, 4 * np.arange(7), SLAB_FACES.ravel(), SLAB) for corners in scene.slabs]
    pairs = np.unique(np.sort(np.stack([SLAB_FACES, np.roll(SLAB_FACES, -1, axis=1)], axis=2).reshape(-1, 2)), axis=0)
    every = np.vstack([pairs + 8 * row for row in range(len(scene.slabs))])
    return replace(together(faces), ground=True), Lines(np.vstack(scene.slabs), every, GHOST, 1.0)


def interface_faces(
    contacts: Contacts, points: FloatArray, chosen: IntArray, shift: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Outlines of interfaces as polygons: points (n, 3) m, start and loops as in ``Faces``.

    points : (n_points, 3) contact points as moved; shift : (n_chosen, 3) m, added to keep faces off those of blocks
    """
    counts = contacts.outline[chosen]
    start = np.concatenate([[0], np.cumsum(counts)])
    place = np.arange(start[-1]) - np.repeat(start[:-1], counts)
    rows = np.repeat(contacts.point_start[chosen], counts) + place
    return points[rows] + np.repeat(shift, counts, axis=0), start, np.arange(start[-1])
