"""Parts that are the same program: solved once, and the answer lifted into each.

Two parts have the same answer in their own unknowns where their programs are the same: equilibrium matrix, loads and
limits, in the unit of force and the lengths of each. That is so of columns of one make, wherever they stand, and of
columns of another density or size whose loads are in proportion. What reductions of a part and least forces look at
besides has to be the same too: which points belong to one interface, how its area is shared, what guides allow.

Each part keeps its own way back to the whole model, by the maps of the part that it is like.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program, Reduction
from mbla.program.reductions.scene import Scene

SAME = 1e-12
"""Relative difference of programs that is rounding, near the origin."""

COORDINATES = 32.0 * np.finfo(float).eps
"""Rounding of lever arms, times the distance from the origin over the size of a block."""

COARSEST = 1e-9
"""Relative difference beyond which parts are not the same, however far away: load factors are asked for to 1e-7."""

Planes = Sequence[tuple[float, float, float, float]]


def like_which(scenes: Sequence[Scene], planes: Planes = ()) -> IntArray:
    """Number of the first scene with the same program, its own where there is none before it, (n_scenes,).

    planes : unit normal and offset of planes of symmetry that the deck gives, from which both must be as far away
    """
    first = np.arange(len(scenes))
    known: dict[tuple[int, ...], list[int]] = {}
    marks = np.array([_mark(scene, planes) for scene in scenes])
    for number, scene in enumerate(scenes):
        others = known.setdefault(_counts(scene), [])
        margin = _margin(scene)
        near = np.abs(marks[others] - marks[number]).max(axis=1, initial=0.0) <= 1e3 * margin
        alike = (other for other, close in zip(others, near, strict=True) if close)
        found = next((other for other in alike if _same(scenes[other], scene, planes)), None)
        if found is None:
            others.append(number)
        else:
            first[number] = found
    return first


def as_reduced(scene: Scene, smaller: Program, like: Program) -> Program:
    """The reduced program of a part that has the program ``like``, reduced to ``smaller``, as one of this part."""
    if smaller is like:
        return scene.program
    assert smaller.reduction is not None
    full = as_reduced(scene, smaller.reduction.full, like)
    return replace(smaller, reduction=Reduction(full, smaller.reduction.velocities, smaller.reduction.forces))


def _counts(scene: Scene) -> tuple[int, ...]:
    return len(scene.centroids), scene.program.n_points, scene.program.equilibrium_matrix.nnz


def _mark(scene: Scene, planes: Planes) -> FloatArray:
    """A few figures that are the same of parts that are the same, of size about 1."""
    dead, live = scene.loads()
    n = max(len(scene.centroids), 1)
    weights = 1.0 + np.arange(len(dead)) / n
    live_size = max(float(np.abs(live).max(initial=0.0)), 1e-300)
    figures = [*(weights @ dead / n), *(weights @ live / (n * live_size)), *_distances(scene, planes)]
    figures.append(float(np.abs(scene.program.equilibrium_matrix.data).sum()) / (n + scene.program.n_points))
    return np.array(figures)


def _distances(scene: Scene, planes: Planes) -> list[float]:
    """From the middle of a part to the planes, in sizes of a block."""
    middle = scene.centroids.mean(axis=0)
    return [float(np.array(normal) @ middle - offset) / scene.length for *normal, offset in planes]


def _margin(scene: Scene) -> float:
    """Relative difference that is rounding in a part where it stands."""
    away = float(np.abs(scene.centroids).max(initial=0.0)) / scene.length
    return min(max(SAME, COORDINATES * away), COARSEST)


def _same(one: Scene, other: Scene, planes: Planes) -> bool:
    """Whether both have the same program, and what is looked at besides."""
    margin = max(_margin(one), _margin(other))
    a, b = one.program, other.program
    pairs = [
        (a.dead_load, b.dead_load),
        (a.live_load, b.live_load),
        (one.areas / _mean(one), other.areas / _mean(other)),
    ]
    pairs += list(zip(vars(a.limits).values(), vars(b.limits).values(), strict=True))
    pairs.append((np.array(_distances(one, planes)), np.array(_distances(other, planes))))
    return (
        np.array_equal(one.bodies, other.bodies)
        and np.array_equal(_numbered(one), _numbered(other))
        and np.array_equal(one.refined_points, other.refined_points)
        and all(_close(x, y, margin) for x, y in pairs)
        and _close_matrices(a.equilibrium_matrix, b.equilibrium_matrix, margin)
        and _same_guides(one.allowed, other.allowed, margin)
    )


def _numbered(scene: Scene) -> IntArray:
    """Interfaces of the points, numbered from 0 within the part."""
    return np.unique(scene.interfaces, return_inverse=True)[1]


def _mean(scene: Scene) -> float:
    return float(scene.areas.mean()) if len(scene.areas) else 1.0


def _close(x: FloatArray, y: FloatArray, margin: float) -> bool:
    """Equal to within rounding of the largest figure; infinite ones in the same places."""
    finite = np.isfinite(x)
    if not np.array_equal(finite, np.isfinite(y)):
        return False
    return bool(np.abs(x[finite] - y[finite]).max(initial=0.0) <= margin * np.abs(x[finite]).max(initial=0.0))


def _close_matrices(x: sp.csr_array, y: sp.csr_array, margin: float) -> bool:
    if np.array_equal(x.indptr, y.indptr) and np.array_equal(x.indices, y.indices):
        return _close(x.data, y.data, margin)
    return bool(abs(x - y).max() <= margin * np.abs(x.data).max(initial=0.0))


def _same_guides(x: sp.csr_array | None, y: sp.csr_array | None, margin: float) -> bool:
    if x is None or y is None:
        return x is y
    return _close_matrices(x, y, margin)
