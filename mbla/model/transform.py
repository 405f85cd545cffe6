"""Transforms of an item: steps of translation, rotation, scaling and mirroring, applied in order.

A chain of steps is one affine map x -> M x + c with M a multiple of an orthogonal matrix; rotation by Rodrigues,

    R = I + sin(a) K + (1 - cos(a)) K K,   K the cross-product matrix of the unit axis,

mirroring in a plane of unit normal n by Householder, H = I - 2 n n'.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.placement import Repetition, Rotation, TransformStep
from mbla.model.blocks.generated import Generated
from mbla.model.solids.plane import unit
from mbla.model.solids.polyhedra import Polyhedra, turn_faces


@dataclass(frozen=True)
class AffineMap:
    """x -> matrix x + offset, a similarity: matrix is a multiple of an orthogonal one; (3, 3), (3,)."""

    matrix: FloatArray
    offset: FloatArray

    def points(self, points: FloatArray) -> FloatArray:
        """Images of points, (..., 3)."""
        return np.asarray(points @ self.matrix.T + self.offset, dtype=np.float64)

    def directions(self, directions: FloatArray) -> FloatArray:
        """Images of directions or normals, (..., 3), unit."""
        images = directions @ self.matrix.T
        return np.asarray(images / np.linalg.norm(images, axis=-1, keepdims=True), dtype=np.float64)

    def after(self, other: AffineMap) -> AffineMap:
        """The map of what another one has moved."""
        return AffineMap(self.matrix @ other.matrix, self.points(other.offset))

    @property
    def mirrors(self) -> bool:
        """True where right-handed becomes left-handed."""
        return bool(np.linalg.det(self.matrix) < 0)


IDENTITY = AffineMap(np.eye(3), np.zeros(3))


def build_transform(transform: Sequence[TransformStep] | TransformStep) -> AffineMap | None:
    """The affine map of an item's steps; None where there are none."""
    steps = [transform] if isinstance(transform, TransformStep) else transform
    return reduce(lambda total, step: _step(step).after(total), steps, IDENTITY) if steps else None


def repetitions(repeat: Sequence[Repetition] | Repetition) -> list[AffineMap]:
    """The maps to the copies of an item, the first of which is the item itself; of steps, the last varies slowest."""
    copies = [IDENTITY]
    for step in [repeat] if isinstance(repeat, Repetition) else repeat:
        copies = [_onwards(step, number).after(copy) for number in range(step.count) for copy in copies]
    return copies


def copies_of(repeat: Sequence[Repetition] | Repetition) -> int:
    """How often something is there that is repeated, itself included."""
    return math.prod(step.count for step in ([repeat] if isinstance(repeat, Repetition) else repeat))


def _onwards(step: Repetition, number: int) -> AffineMap:
    """To a copy: a multiple of the displacement or the angle, so that no rounding adds up."""
    if step.rotate is not None:
        return _rotation(step.rotate.model_copy(update={"angle": number * step.rotate.angle}))
    assert step.translate is not None  # a rule of the deck: one of translate and rotate
    return AffineMap(np.eye(3), number * np.array(step.translate))


def transform_item(generated: Generated, transform: AffineMap) -> Generated:
    """Everything that a generator made, moved; faces keep pointing the way they did."""
    parts = tuple(replace(part, polyhedra=moved(part.polyhedra, transform)) for part in generated.parts)
    grounds = tuple(
        replace(ground, point=transform.points(ground.point), normal=transform.directions(ground.normal))
        for ground in generated.grounds
    )
    surfaces = tuple(replace(surface, outline=transform.points(surface.outline)) for surface in generated.surfaces)
    return replace(generated, parts=parts, grounds=grounds, surfaces=surfaces)


def moved(polyhedra: Polyhedra, transform: AffineMap) -> Polyhedra:
    """Images of polyhedra; faces keep pointing the way they did."""
    images = replace(polyhedra, vertices=transform.points(polyhedra.vertices))
    return turn_faces(images, np.ones(len(images.block_of_face), dtype=bool)) if transform.mirrors else images


def _step(step: TransformStep) -> AffineMap:
    if step.rotate is not None:
        return _rotation(step.rotate)
    if step.mirror is not None:
        return reflection(np.array(step.mirror.point), unit(step.mirror.normal))
    if step.scale is not None:
        return AffineMap(step.scale * np.eye(3), np.zeros(3))
    return AffineMap(np.eye(3), np.array(step.translate or (0.0, 0.0, 0.0)))


def _rotation(rotation: Rotation) -> AffineMap:
    x, y, z = unit(rotation.axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, cosine = _sine_and_cosine(rotation.angle)
    return _about(np.eye(3) + sine * cross + (1 - cosine) * cross @ cross, np.array(rotation.about))


def reflection(point: FloatArray, normal: FloatArray) -> AffineMap:
    """Mirror images in the plane through a point, (3,), with a unit normal, (3,)."""
    return _about(np.eye(3) - 2 * np.outer(normal, normal), point)


def _about(matrix: FloatArray, point: FloatArray) -> AffineMap:
    return AffineMap(matrix, point - matrix @ point)


def _sine_and_cosine(degrees: float) -> tuple[float, float]:
    """Exact at multiples of a right angle, so that turned boxes stay along the axes."""
    quarter, rest = divmod(degrees, 90.0)
    if rest == 0:
        return ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))[int(quarter) % 4]
    radians = np.radians(np.fmod(degrees, 360.0))
    return float(np.sin(radians)), float(np.cos(radians))
