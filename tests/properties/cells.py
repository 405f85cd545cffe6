"""Convex polyhedral cells: cut by planes, those that fill a box at random, as vertices and faces."""

from __future__ import annotations

from random import Random
from typing import TypeAlias

import numpy as np
from scipy.spatial import Voronoi

from mbla.arrays import FloatArray

Faces: TypeAlias = list[FloatArray]
"""a convex cell: the corners of each face in order, (n, 3)"""

SAME = 1e-9
"""distance, over the size of the box, below which two corners are one"""
THIN = 0.12
"""least width of a cell across a cut, over the cube root of its volume: splinters are no blocks"""


def cells_of_planes(rng: Random, size: tuple[float, float, float], count: int) -> list[Faces]:
    """The box [0, size] cut ``count`` - 1 times, each time the largest cell through its middle."""
    cells = [_box(size)]
    for _ in range(count - 1):
        largest = max(range(len(cells)), key=lambda number: volume(cells[number]))
        cell = cells.pop(largest)
        cells += next(halves for halves in _tries(rng, cell) if halves)
    return cells


def cells_of_voronoi(rng: Random, size: tuple[float, float, float], count: int) -> list[Faces]:
    """The cells of random seeds in the box [0, size]: their mirror images at its six sides make its faces."""
    scale = np.asarray(size)
    seeds = np.array([[rng.uniform(0.05, 0.95) for _ in range(3)] for _ in range(count)]) * scale
    mirrored = [seeds]
    for axis in range(3):
        for side in (0.0, scale[axis]):
            image = seeds.copy()
            image[:, axis] = 2.0 * side - image[:, axis]
            mirrored.append(image)
    diagram = Voronoi(np.vstack(mirrored))
    corners = np.clip(diagram.vertices, 0.0, None)
    corners[np.abs(corners) < SAME * scale.max()] = 0.0  # the ground is at zero
    cells: list[Faces] = [[] for _ in range(count)]
    for pair, loop in zip(diagram.ridge_points.tolist(), diagram.ridge_vertices, strict=True):
        for seed in pair:
            if seed < count:
                cells[seed].append(corners[loop])
    return cells


def volume(cell: Faces) -> float:
    """Volume of a convex cell: pyramids over its faces from a point inside."""
    inside = np.vstack(cell).mean(axis=0)
    total = 0.0
    for face in cell:
        spokes = face - inside
        total += sum(abs(float(np.dot(spokes[0], np.cross(spokes[k], spokes[k + 1])))) for k in range(1, len(face) - 1))
    return total / 6.0


def indexed(cell: Faces, size: float) -> tuple[list[list[float]], list[list[int]]]:
    """Vertices and faces as a deck lists them; corners of neighbouring faces that are one are one vertex."""
    vertices: list[FloatArray] = []
    faces: list[list[int]] = []
    for face in cell:
        loop: list[int] = []
        for corner in face:
            near = [number for number, known in enumerate(vertices) if np.abs(known - corner).max() <= SAME * size]
            number = near[0] if near else len(vertices)
            if not near:
                vertices.append(corner)
            if number not in loop:
                loop.append(number)
        if len(loop) >= 3:
            faces.append(loop)
    return [vertex.tolist() for vertex in vertices], faces


def _box(size: tuple[float, float, float]) -> Faces:
    corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]) * np.asarray(size)
    loops = ([0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5])
    return [corners[loop] for loop in loops]


def _tries(rng: Random, cell: Faces) -> list[list[Faces]]:
    """The halves of a cell by one plane after the other, nothing for a plane that leaves a splinter."""
    found: list[list[Faces]] = []
    middle = np.vstack([face.mean(axis=0) for face in cell]).mean(axis=0)
    while not (found and found[-1]):
        steep = rng.random() < 0.45
        normal = np.array([rng.gauss(0, 1), rng.gauss(0, 1), rng.gauss(0, 0.3)] if steep else [0.0, 0.0, 1.0])
        if not steep:
            normal[:2] = rng.gauss(0, 0.2), rng.gauss(0, 0.2)
        normal /= np.linalg.norm(normal)
        found.append(_halves(cell, normal, float(normal @ middle)))
    return found


def _halves(cell: Faces, normal: FloatArray, offset: float) -> list[Faces]:
    least = THIN * volume(cell) ** (1 / 3)
    heights = np.vstack(cell) @ normal - offset
    if heights.max() < least or -heights.min() < least:
        return []
    return [below(cell, sign * normal, sign * offset) for sign in (1.0, -1.0)]


def below(cell: Faces, normal: FloatArray, offset: float) -> Faces:
    """The part of a convex cell in which normal · x ≤ offset."""
    kept: Faces = []
    cut: list[FloatArray] = []
    close = SAME * float(np.ptp(np.vstack(cell), axis=0).max())
    for face in cell:
        height = face @ normal - offset
        height[np.abs(height) <= close] = 0.0
        cut += list(face[height == 0.0])
        corners: list[FloatArray] = []
        for k, corner in enumerate(face):
            following = (k + 1) % len(face)
            if height[k] <= 0.0:
                corners.append(corner)
            if (height[k] < 0.0 < height[following]) or (height[following] < 0.0 < height[k]):
                crossing = corner + height[k] / (height[k] - height[following]) * (face[following] - corner)
                corners.append(crossing)
                cut.append(crossing)
        if len(corners) >= 3:
            kept.append(np.array(corners))
    return [*kept, _around(np.array(cut), normal)]


def _around(corners: FloatArray, normal: FloatArray) -> FloatArray:
    """The corners of a convex face in order around its normal."""
    across = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.5 else [0.0, 1.0, 0.0])
    spokes = corners - corners.mean(axis=0)
    return corners[np.argsort(np.arctan2(spokes @ np.cross(normal, across), spokes @ across))]
