"""Rules on items of `blocks`."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import is_zero, least_below_greatest
from mbla.deck.section import Finding, rule
from mbla.errors import Message


@rule(types.Rotation)
def rotation_axis(rotation: types.Rotation) -> Iterator[Finding]:
    """An axis has a direction."""
    if is_zero(rotation.axis):
        yield ("axis",), Message("zero-vector", "must not be the zero vector")


@rule(types.Reflection)
def mirror_normal(reflection: types.Reflection) -> Iterator[Finding]:
    """A plane has a normal."""
    if is_zero(reflection.normal):
        yield ("normal",), Message("zero-vector", "must not be the zero vector")


@rule(types.BoxItem)
def box_extent(box: types.BoxItem) -> Iterator[Finding]:
    """Corners in order, none equal."""
    yield from least_below_greatest(box.min, box.max, "max", "xyz")


@rule(types.PolyhedronItem)
def polyhedron_faces(polyhedron: types.PolyhedronItem) -> Iterator[Finding]:
    """Faces use vertices that exist, each once."""
    n_vertices = len(polyhedron.vertices)
    for number, face in enumerate(polyhedron.faces):
        if max(face) >= n_vertices:
            position = next(i for i, corner in enumerate(face) if corner >= n_vertices)
            yield (
                ("faces", number, position),
                Message("out-of-bounds", f"must be <= {n_vertices - 1}: there are {n_vertices} vertices, from 0"),
            )
        elif len(set(face)) < len(face):
            position = next(i for i, corner in enumerate(face) if corner in face[:i])
            yield ("faces", number, position), Message("duplicate-key", "is a corner of this face already")
