"""Blocks of an item `table`, from its two tables."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Finding, Message
from mbla.model.blocks.files.members import left_in
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, ItemRefused
from mbla.model.geometry.geometry import Geometry, member_name
from mbla.model.solids.polyhedra import polyhedra_from_lists
from mbla.model.tables import CsvTable, TableRefused, read_table

if TYPE_CHECKING:
    from mbla.model.blocks.table import TableItem

COLUMNS = {"vertices": ("block", "vertex", "x", "y", "z"), "faces": ("block", "face")}


def read_blocks(item: TableItem, context: ItemContext) -> Generated:
    """Blocks in the order in which the table of vertices names them first.

    Raises
    ------
    ItemRefused
        with every fault of the tables, by file and line
    DeckError
        for files that are missing or outside the deck's folder
    """
    findings: list[Finding] = []
    tables: dict[str, CsvTable] = {}
    for key, columns in COLUMNS.items():
        with _collected(findings, key):
            file = context.resolve_file((key,), getattr(item, key))
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
    geometry = Geometry(polyhedra_from_lists(points, faces), names=tuple(blocks), cells=True)
    if item.leave_out is not None:
        geometry = left_in(geometry, item.leave_out, "the tables have")
    return Generated((ItemPart(geometry.polyhedra, member=[member_name(name) for name in geometry.names]),))


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


def _blocks(vertices: CsvTable, faces: CsvTable) -> dict[str, _Block]:
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
