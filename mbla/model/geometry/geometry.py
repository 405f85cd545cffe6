"""What a reader of geometry files gives."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.errors import Notice
from mbla.model.polyhedra import Polyhedra


class GeometryFileError(Exception):
    """The file cannot be read, or holds no blocks; the message is for the user of the deck."""


@dataclass(frozen=True)
class Geometry:
    """Blocks of a file in its own coordinates, in file order, faces in any orientation, and what was put right."""

    polyhedra: Polyhedra
    notices: tuple[Notice, ...] = ()
