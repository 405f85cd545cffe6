"""Generators of blocks from a geometry file, and from tables of their vertices and faces."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.files import MeshItem, TableItem
from mbla.deck.suggestions import unknown
from mbla.deck.units import METRES
from mbla.errors import Finding, Message, Notice
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.geometry import read_geometry
from mbla.model.geometry.geometry import LONGEST_REASON, Geometry, GeometryFileError, member_name
from mbla.model.geometry.repair import repair
from mbla.model.geometry.surfaces import join_cells
from mbla.model.solids.polyhedra import polyhedra_from_lists, take_polyhedra
from mbla.model.tables import Table, TableRefused, read_table

UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""turns y of the file into z by a right angle about x"""


def generate_mesh(item: MeshItem, site: Site) -> Generated:
    """Blocks in the order of the file, in the deck's units and upright; members by the names of the file.

    Raises
    ------
    ItemRefused
        for files that cannot be read, of an unknown kind, or without blocks, names that the file does not have, and
        keys that do not apply to it
    DeckError
        for files that are missing or outside the deck's folder
    """
    path = site.resolve_file(("file",), item.file)
    try:
        geometry = _read(path, item)
    except GeometryFileError as error:
        raise ItemRefused(Finding(error.message.identifier, str(error)[:LONGEST_REASON], "file")) from error
    if findings := list(_misfits(item, geometry)):
        raise ItemRefused(*findings)
    vertices = _placed(geometry, item, site)
    placed = replace(geometry, polyhedra=replace(geometry.polyhedra, vertices=vertices))
    blocks = repair(placed, site.tolerance, item.weld)
    if not len(blocks.polyhedra):
        words = "the file holds no blocks: its faces have no area"
        raise ItemRefused(Finding("geometry-without-blocks", words, "file"))
    members = [member_name(name) for name in blocks.names]
    remarks = (*blocks.notices, *_taken_for_granted(item, geometry, site, vertices))
    notices = tuple(replace(notice, message=f"{item.file}: {notice.message}") for notice in remarks)
    return Generated((Part(blocks.polyhedra, member=members if any(members) else ""),), notices=notices)


def _read(path: Path, item: MeshItem) -> Geometry:
    """The file's content, of the members selected, with cells joined if requested."""
    geometry = read_geometry(path)
    if item.members is not None:
        names = [member_name(name) for name in geometry.names]
        known = sorted({name for name in names if name})
        wrong = []
        for number, name in enumerate(item.members):
            if member_name(name) not in known:
                words = unknown("member", name, known, "the file has") if known else "the file has no names"
                wrong.append(Finding("unknown-name", words, "members", number))
        if wrong:
            raise ItemRefused(*wrong)
        wanted = {member_name(name) for name in item.members}
        rows = np.array([row for row, name in enumerate(names) if name in wanted], dtype=np.int64)
        kept = tuple(geometry.names[row] for row in rows)
        geometry = replace(geometry, polyhedra=take_polyhedra(geometry.polyhedra, rows), names=kept)
    if item.join_cells and not geometry.cells:
        words = "applies to files with volume cells only: leave it out"
        raise ItemRefused(Finding("key-of-another-choice", words, "join_cells"))
    return join_cells(geometry) if item.join_cells else geometry


def _misfits(item: MeshItem, geometry: Geometry) -> Iterator[Finding]:
    """Keys that the file has no use for, or lacks."""
    if geometry.planar and item.extrude is None:
        yield Finding("geometry-options", "is a drawing of outlines: give their thickness with extrude", "file")
    if geometry.planar and item.up is not None:
        yield Finding("key-of-another-choice", "does not apply to a drawing: its y points upwards in the deck", "up")
    if not geometry.planar and item.extrude is not None:
        yield Finding("key-of-another-choice", "applies to drawings (DXF) only: leave it out", "extrude")


def _placed(geometry: Geometry, item: MeshItem, site: Site) -> FloatArray:
    """Vertices in the deck's unit of length, z upwards; drawings with their thickness along y."""
    unit = item.units or geometry.unit
    factor = item.scale * (1.0 if unit in (None, site.length) else METRES[unit] / METRES[site.length])
    vertices = geometry.polyhedra.vertices
    if geometry.planar:
        assert item.extrude is not None  # refused before
        return np.asarray(vertices * np.array([factor, item.extrude, factor]))
    vertices = vertices * factor
    return np.asarray(vertices @ UPRIGHT.T) if item.up == "y" else vertices


def _taken_for_granted(item: MeshItem, geometry: Geometry, site: Site, vertices: FloatArray) -> list[Notice]:
    """What the header of the file decided, with the size that follows."""
    if item.units is not None or geometry.unit is None or not len(vertices):
        return []
    x, y, z = np.ptp(vertices, axis=0)
    size = f"{x:.4g} x {y:.4g} x {z:.4g} {site.length} along x, y, z"
    words = (
        f"coordinates in {geometry.unit}, as the file has it; its blocks measure {size} in the deck; "
        "units may say otherwise"
    )
    return [Notice("notice", "mesh-placed", words)]


COLUMNS = {"vertices": ("block", "vertex", "x", "y", "z"), "faces": ("block", "face")}


def generate_table(item: TableItem, site: Site) -> Generated:
    """Blocks in the order in which the table of vertices names them first.

    Raises
    ------
    ItemRefused
        with every fault of the tables, by file and line
    DeckError
        for files that are missing or outside the deck's folder
    """
    findings: list[Finding] = []
    tables: dict[str, Table] = {}
    for key, columns in COLUMNS.items():
        with _collected(findings, key):
            file = site.resolve_file((key,), getattr(item, key))
            tables[key] = read_table(file, columns, with_rest=key == "faces")
    if findings:
        raise ItemRefused(*findings)
    blocks = _blocks(tables["vertices"], tables["faces"])
    for key, table in tables.items():
        with _collected(findings, key):
            table.check()
    if findings:
        raise ItemRefused(*findings)
    points = [np.array(list(block.points.values())) for block in blocks.values()]
    numbers = [{vertex: row for row, vertex in enumerate(block.points)} for block in blocks.values()]
    faces = [
        [[number[corner] for corner in face] for face in block.faces]
        for block, number in zip(blocks.values(), numbers, strict=True)
    ]
    members = [member_name(name) for name in blocks]
    return Generated((Part(polyhedra_from_lists(points, faces), member=members),))


@contextmanager
def _collected(findings: list[Finding], key: str) -> Iterator[None]:
    try:
        yield
    except TableRefused as refused:
        findings += refused.findings(key)


@dataclass(frozen=True)
class _Block:
    """Points of a block by the names of its vertices, lines of the table that give them, and corners of its faces."""

    points: dict[str, FloatArray] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    faces: list[list[str]] = field(default_factory=list)


def _blocks(vertices: Table, faces: Table) -> dict[str, _Block]:
    """Blocks by name in the order of their first vertices; the tables report what is wrong."""
    blocks: dict[str, _Block] = {}
    points, names = vertices.numbers("xyz"), zip(vertices.columns["block"], vertices.columns["vertex"], strict=True)
    for row, (name, vertex) in enumerate(names):
        block = blocks.setdefault(name, _Block())
        if not name or not vertex:
            vertices.refuse(row, f"{'vertex' if name else 'block'} is empty")
        elif vertex in block.points:
            vertices.refuse(row, f"block {name} has a vertex {vertex} in line {block.lines[vertex]}")
        block.points.setdefault(vertex, points[row])
        block.lines.setdefault(vertex, vertices.lines[row])
    for row, (name, corners) in enumerate(zip(faces.columns["block"], faces.rest, strict=True)):
        missing = [corner for corner in corners if corner not in blocks.get(name, _Block()).points]
        if name not in blocks:
            faces.refuse(row, f"block {name or '(empty)'} has no vertices")
        elif missing:
            faces.refuse(row, f"block {name} has no vertex {missing[0]}")
        elif len(corners) < 3:
            faces.refuse(row, f"a face has at least three corners, this one has {len(corners)}")
        else:
            blocks[name].faces.append(corners)
    bare = next((name for name, block in blocks.items() if not block.faces), None)
    if bare is not None and not faces.faults:
        faces.faults.append(Message("table-row", f"{faces.file}: block {bare} has no faces"))
    return blocks
