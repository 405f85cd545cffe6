"""Geometry files as the deck means them: members by name, coordinates in place, and surfaces that are supports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.geometry_file import GeometryFile
from mbla.deck.suggestions import unknown
from mbla.deck.units import METRES
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemRefused
from mbla.model.geometry.geometry import LONGEST_REASON, Geometry, GeometryFileError, member_name
from mbla.model.geometry.readers import read_geometry
from mbla.model.geometry.sheets import NotFlatError, flat_outlines, sheets
from mbla.model.geometry.welding import take_faces, weld
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, take_polyhedra
from mbla.model.solids.surface import GroundSurface

if TYPE_CHECKING:
    from mbla.deck.sections.supports import Surface
    from mbla.model.blocks.mesh import MeshItem

UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""turns y of the file into z by a right angle about x"""


def read_members(path: Path, item: GeometryFile | Surface) -> Geometry:
    """The file's content, of the members selected.

    Raises ItemRefused for files that cannot be read, and for names that the file does not have.
    """
    try:
        geometry = read_geometry(path)
    except GeometryFileError as error:
        raise ItemRefused(Finding(error.message.identifier, str(error)[:LONGEST_REASON], "file")) from error
    return geometry if item.members is None else taken(geometry, members_of(geometry, item.members, "members"))


def members_of(geometry: Geometry, wanted: Sequence[str], key: str, where: str = "the file has") -> IntArray:
    """Polyhedra of some names, ascending, (n,); raises ItemRefused for names that nothing has.

    key : of the item, that lists them; where : whose names they may be
    """
    names = [member_name(name) for name in geometry.names]
    known = sorted({name for name in names if name})
    wrong = []
    for number, name in enumerate(wanted):
        if member_name(name) not in known:
            words = unknown("member", name, known, where) if known else "the file has no names"
            wrong.append(Finding("unknown-name", words, key, number))
    if wrong:
        raise ItemRefused(*wrong)
    chosen = {member_name(name) for name in wanted}
    return np.array([row for row, name in enumerate(names) if name in chosen], dtype=np.int64)


def left_in(geometry: Geometry, left_out: Sequence[str], where: str) -> Geometry:
    """What is left without some names; raises ItemRefused where that is nothing. ``where`` as of ``members_of``."""
    rows = members_of(geometry, left_out, "leave_out", where)
    left = np.setdiff1d(np.arange(len(geometry.polyhedra)), rows)
    if not len(left):
        raise ItemRefused(Finding("geometry-without-blocks", "leaves no block: all are left out", "leave_out"))
    return taken(geometry, left)


def taken(geometry: Geometry, rows: IntArray) -> Geometry:
    """Some polyhedra of a file, (n,)."""
    names = tuple(geometry.names[row] for row in rows) if geometry.names else ()
    sets = None if geometry.sets is None else geometry.sets[rows]
    return replace(geometry, polyhedra=take_polyhedra(geometry.polyhedra, rows), names=names, sets=sets)


def placed_vertices(
    geometry: Geometry, item: GeometryFile | Surface, length: str, extrude: float | None = None
) -> FloatArray:
    """Vertices in the deck's unit of length, z upwards; drawings with their thickness along y."""
    unit = item.units or geometry.unit
    factor = (item.scale or 1.0) * (1.0 if unit in (None, length) else METRES[unit] / METRES[length])
    vertices = geometry.polyhedra.vertices
    if geometry.planar:
        assert extrude is not None  # refused before
        return np.asarray(vertices * np.array([factor, extrude, factor]))
    vertices = vertices * factor
    return np.asarray(vertices @ UPRIGHT.T) if item.up == "y" else vertices


def split_off_supports(
    geometry: Geometry, item: MeshItem, tolerance: float
) -> tuple[Geometry, tuple[GroundSurface, ...]]:
    """The file's blocks, and the surfaces among them that are supports; flat faces that are left out are in neither.

    Raises ItemRefused for supports that are closed, or not flat, and where no block is left.
    """
    if item.supports is None and item.flat_faces is None:
        return geometry, ()
    if item.flat_faces is not None and not geometry.names and not geometry.cells:
        geometry = _flat_pieces_apart(geometry)
    open_ones, flat = sheets(geometry.polyhedra)
    support = np.zeros(len(open_ones), dtype=bool)
    if item.supports is not None:
        rows = members_of(geometry, item.supports, "supports")
        names = [member_name(geometry.names[row]) for row in rows[~open_ones[rows]]]
        refused = [
            Finding("surface-unfit", "is a closed solid: leave it among the blocks, and fix it", "supports", number)
            for number, name in enumerate(item.supports)
            if member_name(name) in names
        ]
        if refused:
            raise ItemRefused(*refused)
        support[rows] = True
    if item.flat_faces == "supports":
        support |= flat
    gone = support | flat if item.flat_faces is not None else support
    if gone.all():
        raise ItemRefused(Finding("geometry-without-blocks", "the file holds no blocks besides its flat faces", "file"))
    if item.flat_faces is not None and not flat.any():
        words = "none of the file's objects is one flat face: leave it out"
        raise ItemRefused(Finding("key-of-another-choice", words, "flat_faces"))
    surfaces = surfaces_of_sheets(taken(geometry, np.flatnonzero(support)), "file", tolerance)
    return taken(geometry, np.flatnonzero(~gone)), surfaces


def surfaces_of_sheets(geometry: Geometry, key: str, tolerance: float) -> tuple[GroundSurface, ...]:
    """The flat surfaces that sheets consist of, by the names of their objects; raises ItemRefused at a key."""
    names = geometry.names or ("",) * len(geometry.polyhedra)
    found: list[GroundSurface] = []
    for row, name in enumerate(names):
        try:
            outlines = flat_outlines(take_polyhedra(geometry.polyhedra, np.array([row])), tolerance)
        except NotFlatError as error:
            raise ItemRefused(Finding(error.message.identifier, f"surface {name}: {error}", key)) from error
        if not outlines:
            raise ItemRefused(Finding("surface-unfit", f"surface {name} has no area", key))
        found += [GroundSurface(outline, member_name(name)) for outline in outlines]
    return tuple(found)


def _flat_pieces_apart(geometry: Geometry) -> Geometry:
    """A file without names as its flat pieces, each apart, and the rest: pieces have no corner in common."""
    welded = weld(geometry.polyhedra).polyhedra
    n_faces = len(welded.block_of_face)
    corners = np.stack([welded.face_of_corner, n_faces + welded.loops], axis=1)
    piece = connected_labels(corners, n_faces + len(welded.vertices))[:n_faces]
    parts = [_of_faces(welded, piece == number) for number in range(int(piece.max(initial=-1)) + 1)]
    flat = [bool(sheets(part)[1][0]) for part in parts]
    apart = [part for part, is_flat in zip(parts, flat, strict=True) if is_flat]
    kept = ~np.isin(piece, np.flatnonzero(flat))
    rest = [take_faces(welded, kept)] if kept.any() else []
    return replace(geometry, polyhedra=join_polyhedra([*rest, *apart]))


def _of_faces(polyhedra: Polyhedra, chosen: BoolArray) -> Polyhedra:
    """The polyhedron that some faces are of, with these alone."""
    rows = np.unique(polyhedra.block_of_face[chosen])
    return take_polyhedra(take_faces(polyhedra, chosen), rows)
