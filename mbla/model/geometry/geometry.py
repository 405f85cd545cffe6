"""What a reader of geometry files gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mbla.errors import Notice, Refusal
from mbla.model.solids.polyhedra import Polyhedra

LONGEST_LINE = 1_000_000
"""characters of a line of text, with those that continue it: a face of some hundred thousand corners"""


class GeometryFileError(Refusal):
    """The file cannot be read, or holds no blocks; the message is for the user of the deck."""


def refuse_long_line(number: int, length: int) -> None:
    """GeometryFileError for a line of so many characters that what it lists would take gigabytes."""
    if length > LONGEST_LINE:
        words = f"line {number} is too long: with the lines that it continues it has more than {LONGEST_LINE:,} "
        raise GeometryFileError("geometry-too-large", words + "characters; no face has so many corners")


@dataclass(frozen=True)
class Geometry:
    """Content of a file in its own coordinates and order, faces in any orientation.

    polyhedra : what the file keeps apart: its objects, each one or several closed surfaces; or its volume cells
    notices   : what was left out or put right
    names     : name of each polyhedron in the file, empty where it has none; or no entry at all
    cells     : each polyhedron is a volume cell, and so a block; else surfaces, whose closed parts are the blocks
    indexed   : faces share vertices by number, so that two vertices at one place are worth a remark
    up        : axis of the file that points upwards, where its format says so
    unit      : unit of length of the file, where its format or its header says so
    planar    : outlines of a drawing in x and z, each extended from y = 0 to y = 1; the deck gives the thickness
    """

    polyhedra: Polyhedra
    notices: tuple[Notice, ...] = ()
    names: tuple[str, ...] = ()
    cells: bool = False
    indexed: bool = True
    up: Literal["z", "y"] = "z"
    unit: str | None = None
    planar: bool = False

    def name(self, row: int) -> str:
        """Name of a polyhedron; empty where it has none."""
        return self.names[row] if self.names else ""
