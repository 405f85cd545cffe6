"""A second formulation for planar structures: the static theorem as a linear program, solved by HiGHS.

It shares nothing with mbla: rectangles and radial joints are written down here, each joint carries two normal forces at
its ends and one shear force along it, and ``scipy.optimize.linprog`` maximises the load factor.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.optimize import linprog

Array = NDArray[np.float64]
GROUND = -1


@dataclass(frozen=True)
class PlanarJoint:
    """A straight joint from p to q; the normal points from body a to body b (GROUND or a block); friction mu."""

    a: int
    b: int
    p: Array
    q: Array
    normal: Array
    mu: float


@dataclass(frozen=True)
class PlanarTie:
    """A line through points on bodies (GROUND or a block) with one force within limits, tension positive."""

    bodies: tuple[int, ...]
    points: tuple[tuple[float, float], ...]
    least: float
    greatest: float


@dataclass(frozen=True)
class Rectangle:
    """left, right, bottom, top."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def area(self) -> float:
        return (self.right - self.left) * (self.top - self.bottom)

    @property
    def centroid(self) -> Array:
        return np.array([(self.left + self.right) / 2, (self.bottom + self.top) / 2])


def load_factor(
    joints: Sequence[PlanarJoint], centroids: Array, dead: Array, live: Array, ties: Sequence[PlanarTie] = ()
) -> float | None:
    """Greatest factor on ``live`` in equilibrium with ``dead``; None where there is none, inf where there is no limit.

    centroids : (n, 2); dead, live : (n, 2) forces at the centroids, or (n, 3) with moments x Fz - z Fx about them
    """
    m, k = len(joints), len(ties)
    unit = np.abs(dead).max()
    equilibrium, friction = _equilibrium(joints, centroids), _friction(joints)
    answer = linprog(  # type: ignore[call-overload]  # its stubs do not know sparse matrices
        np.append(np.zeros(3 * m + k), -1.0),
        A_ub=sp.hstack([friction, sp.csr_array((2 * m, k + 1))]).tocsr(),
        b_ub=np.zeros(2 * m),
        A_eq=sp.hstack(
            [equilibrium, _pulls(ties, centroids), sp.csr_array(_with_moments(live).reshape(-1, 1) / unit)]
        ).tocsr(),
        b_eq=-_with_moments(dead).ravel() / unit,
        bounds=[(0, None), (0, None), (None, None)] * m
        + [(tie.least / unit, tie.greatest / unit) for tie in ties]
        + [(0, None)],
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    if answer.status == 2:
        return None
    if answer.status == 3:
        return float("inf")
    assert answer.status == 0, answer.message
    return float(-answer.fun)


def _with_moments(loads: Array) -> Array:
    """Loads, (n, 3), without moments where none are given."""
    full = np.zeros((len(loads), 3))
    full[:, : loads.shape[1]] = loads
    return full


def _equilibrium(joints: Sequence[PlanarJoint], centroids: Array) -> sp.csr_array:
    """Forces and moments on the blocks, (3 n,), by N at p, N at q and T of each joint, (3 m,)."""
    rows, columns, values = [], [], []
    for j, joint in enumerate(joints):
        tangent = np.array([-joint.normal[1], joint.normal[0]])
        for k, (point, direction) in enumerate(((joint.p, joint.normal), (joint.q, joint.normal), (joint.p, tangent))):
            for body, sign in ((joint.a, -1.0), (joint.b, 1.0)):
                if body == GROUND:
                    continue
                arm = point - centroids[body]
                wrench = [direction[0], direction[1], arm[0] * direction[1] - arm[1] * direction[0]]
                rows += [3 * body, 3 * body + 1, 3 * body + 2]
                columns += [3 * j + k] * 3
                values += [sign * value for value in wrench]
    return sp.csr_array((values, (rows, columns)), shape=(3 * len(centroids), 3 * len(joints)))


def _pulls(ties: Sequence[PlanarTie], centroids: Array) -> sp.csr_array:
    """Forces and moments on the blocks, (3 n,), by the tension of each tie: along both stretches at each point."""
    columns = np.zeros((3 * len(centroids), len(ties)))
    for k, tie in enumerate(ties):
        points = np.array(tie.points)
        for i, body in enumerate(tie.bodies):
            if body == GROUND:
                continue
            for other in (i - 1, i + 1):
                if 0 <= other < len(points):
                    way = (points[other] - points[i]) / np.linalg.norm(points[other] - points[i])
                    arm = points[i] - centroids[body]
                    columns[3 * body : 3 * body + 3, k] += [*way, arm[0] * way[1] - arm[1] * way[0]]
    return sp.csr_array(columns)


def _friction(joints: Sequence[PlanarJoint]) -> sp.csr_array:
    """±T − μ (N at p + N at q) of each joint, (2 m,), by its forces, (3 m,)."""
    rows, columns, values = [], [], []
    for j, joint in enumerate(joints):
        for row, sign in ((2 * j, 1.0), (2 * j + 1, -1.0)):
            rows += [row] * 3
            columns += [3 * j, 3 * j + 1, 3 * j + 2]
            values += [-joint.mu, -joint.mu, sign]
    return sp.csr_array((values, (rows, columns)), shape=(2 * len(joints), 3 * len(joints)))


def rectangles_in_contact(bricks: Sequence[Rectangle], mu: float, ground: float | None = 0.0) -> list[PlanarJoint]:
    """Bed and head joints of rectangles, and their bed joints with the ground at a height."""
    close = 1e-9
    joints = []
    for i, one in enumerate(bricks):
        if ground is not None and abs(one.bottom - ground) < close:
            ends = np.array([[one.left, one.bottom], [one.right, one.bottom]])
            joints.append(PlanarJoint(GROUND, i, ends[0], ends[1], np.array([0.0, 1.0]), mu))
        for j, other in enumerate(bricks):
            if abs(one.top - other.bottom) < close:
                left, right = max(one.left, other.left), min(one.right, other.right)
                if right - left > close:
                    ends = np.array([[left, one.top], [right, one.top]])
                    joints.append(PlanarJoint(i, j, ends[0], ends[1], np.array([0.0, 1.0]), mu))
            if abs(one.right - other.left) < close:
                bottom, top = max(one.bottom, other.bottom), min(one.top, other.top)
                if top - bottom > close:
                    ends = np.array([[one.right, bottom], [one.right, top]])
                    joints.append(PlanarJoint(i, j, ends[0], ends[1], np.array([1.0, 0.0]), mu))
    return joints


def wall(rows: Sequence[Sequence[float]], unit: float = 0.4, height: float = 0.175) -> Iterator[Rectangle]:
    """Rectangles of a wall from its rows, bottom to top, in unit lengths; a negative length is a gap."""
    for level, row in enumerate(rows):
        left = 0.0
        for length in row:
            right = left + abs(length) * unit
            if length > 0:
                yield Rectangle(left, right, level * height, (level + 1) * height)
            left = right


def wall_load_factor(rows: Sequence[Sequence[float]], mu: float) -> float | None:
    """Associative load factor of a wall on the ground pushed along +x."""
    bricks = list(wall(rows))
    areas = np.array([brick.area for brick in bricks])
    dead = np.outer(areas, [0.0, -1.0])
    live = np.outer(areas, [1.0, 0.0])
    centroids = np.array([brick.centroid for brick in bricks])
    return load_factor(rectangles_in_contact(bricks, mu), centroids, dead, live)


@dataclass(frozen=True)
class Arch:
    """Circular arch about the origin, angles from the crown, clockwise positive as seen with x to the right.

    Between the joints at ``angles`` lie the voussoirs; ``weights`` act at ``points``.
    """

    inner: float
    outer: float
    angles: Array
    weights: Array
    points: Array


def arch_load_factor(arch: Arch, mu: float, live: Array | None = None) -> float | None:
    """Associative load factor of an arch between springings on ground; its weight pushes along +x unless ``live``."""
    joints = []
    n = len(arch.weights)
    for i, angle in enumerate(arch.angles):
        ray = np.array([np.sin(angle), np.cos(angle)])
        normal = np.array([np.cos(angle), -np.sin(angle)])  # direction of travel along the arch
        a, b = i - 1, (i if i < n else GROUND)
        joints.append(PlanarJoint(a, b, arch.inner * ray, arch.outer * ray, normal, mu))
    dead = np.outer(arch.weights, [0.0, -1.0])
    return load_factor(joints, arch.points, dead, np.outer(arch.weights, [1.0, 0.0]) if live is None else live)


def centre_line_arch(thickness: float, voussoirs: int, radius: float = 1.0) -> Arch:
    """Semicircle whose weight acts along the centre line: each voussoir's share at the centroid of its arc."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, voussoirs + 1)
    middle, half = (angles[:-1] + angles[1:]) / 2, np.pi / 2 / voussoirs
    points = radius * np.sin(half) / half * np.column_stack([np.sin(middle), np.cos(middle)])
    return Arch(radius - thickness / 2, radius + thickness / 2, angles, np.full(voussoirs, 1.0), points)


def sector_arch(inner: float, outer: float, embrace: float, voussoirs: int) -> Arch:
    """Voussoirs that are sectors of an annulus, curved edges included: their true weights and centroids."""
    angles = np.linspace(-embrace / 2, embrace / 2, voussoirs + 1)
    middle, half = (angles[:-1] + angles[1:]) / 2, embrace / 2 / voussoirs
    area = half * (outer**2 - inner**2)
    radius = 2 / 3 * np.sin(half) / half * (outer**3 - inner**3) / (outer**2 - inner**2)
    points = radius * np.column_stack([np.sin(middle), np.cos(middle)])
    return Arch(inner, outer, angles, np.full(voussoirs, area), points)


def polygon_arch(inner: float, outer: float, embrace: float, voussoirs: int) -> Arch:
    """Voussoirs with straight edges between the ends of their joints."""
    angles = np.linspace(-embrace / 2, embrace / 2, voussoirs + 1)
    middle, half = (angles[:-1] + angles[1:]) / 2, embrace / 2 / voussoirs
    area = (outer**2 - inner**2) * np.sin(half) * np.cos(half)
    # trapezium between the chords: parallel sides 2 r sin(half) at the distance r cos(half) from the centre
    radius = 2 / 3 * np.cos(half) * (outer**3 - inner**3) / (outer**2 - inner**2)
    points = radius * np.column_stack([np.sin(middle), np.cos(middle)])
    return Arch(inner, outer, angles, np.full(voussoirs, area), points)
