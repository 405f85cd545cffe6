"""Planar scenes of soil with known limit loads: rectangles and steps of triangles, and rigid bodies on them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.sparse as sp
from scipy.spatial import Delaunay

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import areas_of
from mbla.soil_mesh.planar_scene import NOTHING, PlanarScene

NEAR = 1e-9
FREE = -2
"""other side of an edge of the outline that nothing touches"""


@dataclass(frozen=True)
class Law:
    """Friction coefficient, cohesion, tensile strength."""

    friction: float
    cohesion: float = 0.0
    tension: float = 0.0


@dataclass(frozen=True)
class Side:
    """What is beyond an edge of the outline: a body by number from 0, NOTHING or FREE, and the law of the joint."""

    body: int
    law: Law


@dataclass(frozen=True)
class SoilCase:
    """A scene, its points, what they may do, the exact load factor, and the same of other points and triangles."""

    scene: PlanarScene
    points: FloatArray
    motions: sp.csr_array
    exact: float
    remade: Callable[[FloatArray, IntArray], SoilCase]


Beyond = Callable[[FloatArray], Side]
"""other side of the edge of the outline with this middle"""


def grid(xs: FloatArray, ys: FloatArray, crossed: bool) -> tuple[FloatArray, IntArray]:
    """Points and triangles of a rectangle: its fields with both diagonals, or about equilateral ones.

    Equilateral ones stand in rows; every other row is that of the middles of the one before and the two ends. The
    first and the last row have all corners of the grid: the number of fields in y is even.
    """
    nx, ny = len(xs), len(ys)
    rows = [np.column_stack([xs, np.full(nx, y)]) for y in ys]
    middles = (xs[1:] + xs[:-1]) / 2
    if crossed:
        corner = np.arange(nx * ny).reshape(ny, nx)
        a, b, c, d = (each.ravel() for each in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]))
        middle = nx * ny + np.arange(len(a))
        centres = [np.column_stack([middles, np.full(nx - 1, y)]) for y in (ys[1:] + ys[:-1]) / 2]
        fans = [np.column_stack(pair) for pair in ((a, b, middle), (b, c, middle), (c, d, middle), (d, a, middle))]
        return np.vstack(rows + centres), np.concatenate(fans)
    assert ny % 2
    between = np.concatenate([xs[:1], middles, xs[-1:]])
    rows[1::2] = [np.column_stack([between, np.full(nx + 1, y)]) for y in ys[1::2]]
    points = np.vstack(rows)
    return points, oriented(points, Delaunay(points).simplices.astype(np.int64))


def oriented(points: FloatArray, triangles: IntArray) -> IntArray:
    """Triangles counter-clockwise, without flat ones."""
    areas = areas_of(triangles, points)
    turned = np.where((areas > 0.0)[:, None], triangles, triangles[:, ::-1])
    return np.asarray(turned[np.abs(areas) > NEAR * np.abs(areas).max()])


def soil_scene(
    points: FloatArray,
    triangles: IntArray,
    law: Law,
    beyond: Beyond,
    dead: tuple[float, float] = (0.0, 0.0),
    live: tuple[float, float] = (0.0, 0.0),
    bodies: Sequence[tuple[float, float, float]] = (),
    held: Sequence[int] = (),
    exact: float = np.nan,
) -> SoilCase:
    """A scene of soil and rigid bodies beside it.

    dead, live : forces per area of the soil
    bodies     : live forces and moments about the origin
    held       : of the three motions of all these bodies, those that they are kept from
    """
    n_cells, n = len(triangles), len(triangles) + len(bodies)
    edges, sides, laws, outline = edges_of(points, triangles, law, beyond)
    friction, cohesion, tension = laws.T
    keeps = np.ones(3 * n, dtype=bool)
    for way in held:
        keeps[3 * n_cells + way :: 3] = False
    loads = np.zeros((n, 3))
    loads[n_cells:] = np.reshape(bodies, (-1, 3))
    centres = np.vstack([points[triangles].mean(axis=1), np.zeros((len(bodies), 2))])
    unit = sp.csr_array(sp.csc_array(sp.eye_array(3 * n))[:, np.flatnonzero(keeps)])
    scene = PlanarScene(
        triangles=triangles,
        edges=edges,
        sides=sides,
        friction=friction,
        cohesion=cohesion,
        tensile_strength=tension,
        compressive_strength=np.full(len(edges), np.inf),
        centres=centres,
        ways=unit,
        dead=np.zeros((n, 3)),
        live=loads,
        dead_density=np.tile(dead, (n_cells, 1)),
        live_density=np.tile(live, (n_cells, 1)),
    )
    remade = partial(soil_scene, law=law, beyond=beyond, dead=dead, live=live, bodies=bodies, held=held, exact=exact)
    return SoilCase(scene, points, slides(points, outline), exact, remade)


def edges_of(
    points: FloatArray, triangles: IntArray, law: Law, beyond: Beyond
) -> tuple[IntArray, IntArray, FloatArray, list[tuple[int, int, int]]]:
    """Edges (n, 2), their sides (n, 2) and laws (n, 3); edges of the outline with the body beyond each."""
    n_cells = len(triangles)
    pairs = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    owner = np.tile(np.arange(n_cells), 3)
    row = {pair: number for number, pair in enumerate(map(tuple, pairs.tolist()))}
    edges, sides, laws, outline = [], [], [], []
    for (a, b), number in row.items():
        other = row.get((b, a))
        if other is None:
            side = beyond((points[a] + points[b]) / 2)
            outline.append((a, b, side.body))
            if side.body == FREE:
                continue
            body, own = side.body if side.body == NOTHING else n_cells + side.body, side.law
        elif a > b:
            continue
        else:
            body, own = int(owner[other]), law
        edges.append((a, b))
        sides.append((int(owner[number]), body))
        laws.append((own.friction, own.cohesion, own.tension))
    return np.array(edges), np.array(sides), np.array(laws), outline


def slides(points: FloatArray, outline: list[tuple[int, int, int]]) -> sp.csr_array:
    """Displacements that leave the outline and what touches it as they are, (2 n_points, n)."""
    along: dict[int, list[tuple[FloatArray, int]]] = {}
    for a, b, body in outline:
        direction = (points[b] - points[a]) / np.linalg.norm(points[b] - points[a])
        for corner in (a, b):
            along.setdefault(corner, []).append((direction, body))
    columns = []
    for point in range(len(points)):
        if point not in along:
            columns += [{2 * point: 1.0}, {2 * point + 1: 1.0}]
            continue
        (first, body), (second, other) = along[point]
        if body == other and abs(first[0] * second[1] - first[1] * second[0]) < NEAR:
            columns.append({2 * point: float(first[0]), 2 * point + 1: float(first[1])})
    entries = [(row, column, value) for column, each in enumerate(columns) for row, value in each.items()]
    rows, numbers, values = zip(*entries, strict=True)
    return sp.csr_array((values, (rows, numbers)), shape=(2 * len(points), len(columns)))


def strip(angle: float, size: float, width: float, depth: float, crossed: bool = True, full: bool = True) -> SoilCase:
    """A rough rigid strip of width 1 on weightless soil with cohesion 1 (Prandtl): the load factor is N_c.

    full : the soil has the tensile strength of the cone of friction, or none
    """
    friction = float(np.tan(np.radians(angle)))
    law = Law(friction, 1.0, (1.0 / friction if friction else 100.0) if full else 0.0)
    fields = 2 * max(1, round(0.5 / size))
    step = 1.0 / fields
    half = max(1, round((width - 0.5) / step))
    xs = -0.5 + step * np.arange(-half, fields + half + 1, dtype=np.float64)
    points, triangles = grid(xs, np.linspace(0.0, depth, _rows(depth, step, crossed) + 1), crossed)

    def beyond(middle: FloatArray) -> Side:
        if middle[1] > depth - NEAR:
            return Side(0, law) if abs(middle[0]) < 0.5 else Side(FREE, law)
        return Side(NOTHING, law)

    n_q = np.tan(np.radians(45 + angle / 2)) ** 2 * np.exp(np.pi * friction)
    exact = (n_q - 1) / friction if friction else 2 + np.pi
    return soil_scene(points, triangles, law, beyond, bodies=[(0.0, -1.0, 0.0)], exact=float(exact))


def slope(
    angle: float, size: float, crossed: bool = True, face: float = 90.0, width: float = 1.5, exact: float = np.nan
) -> SoilCase:
    """A slope of height 1 in soil with cohesion 1, a vertical cut unless its face is inclined less: the load factor is
    the stability number γ H / c.
    """
    friction = float(np.tan(np.radians(angle)))
    law = Law(friction, 1.0, 1.0 / friction if friction else 100.0)
    n = _rows(1.0, size, crossed)
    step = 1.0 / n
    below = _rows(0.5, size, crossed)
    xs = step * np.arange(-round(width / step), max(1, n // 2) + 1, dtype=np.float64)
    points, triangles = grid(xs, np.append(np.linspace(-0.5, 0.0, below + 1)[:-1], step * np.arange(n + 1)), crossed)
    if not crossed:  # the face of the cut is one of edges
        points = points[(points[:, 0] < -0.6 * step) | (points[:, 1] < NEAR) | (np.abs(points[:, 0]) < NEAR)]
        upright = np.column_stack([np.zeros(n + 1), step * np.arange(n + 1)])
        points = np.unique(np.round(np.vstack([points, upright]), 12), axis=0)
        triangles = oriented(points, Delaunay(points).simplices.astype(np.int64))
    middle = points[triangles].mean(axis=1)
    triangles = triangles[~((middle[:, 0] > 0.0) & (middle[:, 1] > 0.0))]
    used, renamed = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], renamed.reshape(-1, 3).astype(np.int64)
    back, foot = xs[0], 1.0 / np.tan(np.radians(face)) if face < 90.0 else 0.0
    points[:, 0] += foot * np.clip(1.0 - points[:, 1], 0.0, 1.0) * np.clip(1.0 - points[:, 0] / back, 0.0, 1.0)
    right = float(points[:, 0].max())

    def beyond(middle: FloatArray) -> Side:
        held = middle[1] < -0.5 + NEAR or middle[0] < back + NEAR or middle[0] > right - NEAR
        return Side(NOTHING if held else FREE, law)

    return soil_scene(points, triangles, law, beyond, live=(0.0, -1.0), exact=exact)


def wall(
    angle: float, wall_angle: float, size: float, passive: bool, crossed: bool = True, exact: float = np.nan
) -> SoilCase:
    """Soil of weight 1 without cohesion behind a vertical wall of height 1 that moves horizontally without turning.

    The load factor is the horizontal force on it, K cos δ / 2; active: its negative.
    """
    law = Law(float(np.tan(np.radians(angle))))
    rough = Law(float(np.tan(np.radians(wall_angle))))
    n, length = _rows(1.0, size, crossed), (7.0 if angle > 30.0 else 4.0) if passive else 1.0
    xs = np.linspace(0.0, length, round(length * n) + 1)
    points, triangles = grid(xs, np.linspace(0.0, 1.0, n + 1), crossed)

    def beyond(middle: FloatArray) -> Side:
        if middle[0] < NEAR:
            return Side(0, rough)
        return Side(FREE if middle[1] > 1.0 - NEAR else NOTHING, law)

    force = (1.0 if passive else -1.0, 0.0, 0.0)
    return soil_scene(points, triangles, law, beyond, (0.0, -1.0), bodies=[force], held=(1, 2), exact=exact)


def _rows(height: float, size: float, crossed: bool) -> int:
    """Rows of fields of about a size, an even number where triangles are equilateral."""
    return max(1, round(height / size)) if crossed else 2 * max(1, round(height / (np.sqrt(3) * size)))
