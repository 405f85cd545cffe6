"""Blocks by corners and faces, as geometry files hold them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import HEXAHEDRON

Face = tuple[int, ...]


@dataclass(frozen=True)
class Stone:
    """One block: ``corners`` (n, 3) in metres with z upwards, ``faces`` by rows of them."""

    name: str
    corners: FloatArray
    faces: tuple[Face, ...]

    def with_corner(self, row: int, place: Sequence[float]) -> Stone:
        """One corner elsewhere."""
        corners = self.corners.copy()
        corners[row] = place
        return replace(self, corners=corners)

    def with_face(self, row: int, *instead: Face) -> Stone:
        """Other faces in place of one; none leaves a hole."""
        return replace(self, faces=(*self.faces[:row], *instead, *self.faces[row + 1 :]))

    def with_corners(self, corners: FloatArray) -> Stone:
        """Every corner elsewhere, (n, 3)."""
        return replace(self, corners=corners)


def voussoirs() -> FloatArray:
    """Those of decks/benchmarks/formats: corners in the order of ``HEXAHEDRON``, 4 to 7 at y = 0; (9, 8, 3) m."""
    angles = np.pi * np.arange(10) / 9
    rays = np.stack([-np.cos(angles), 0 * angles, np.sin(angles)], axis=1)
    rays[-1, 2] = 0.0
    inner, outer = (rays * radius + [2.0, 0, 0] for radius in (2.0, 2.6))
    front = np.stack([inner[:-1], inner[1:], outer[1:], outer[:-1]], axis=1)
    return np.asarray(np.concatenate([front + np.array([0, 1.0, 0]), front], axis=1))


def arch() -> list[Stone]:
    """Nine voussoirs."""
    faces = tuple(tuple(face) for face in HEXAHEDRON)
    return [Stone(f"voussoir {number}", corners.copy(), faces) for number, corners in enumerate(voussoirs())]


def triangles(stone: Stone) -> tuple[Face, ...]:
    """Faces split into triangles from their first corner on."""
    return tuple((face[0], face[i], face[i + 1]) for face in stone.faces for i in range(1, len(face) - 1))
