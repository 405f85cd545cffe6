"""Generator of blocks from tables of their vertices and faces."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray, starts
from mbla.deck.items.table import TableItem
from mbla.deck.tree import KeyPath
from mbla.errors import Message
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.geometry.geometry import member_name
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.tables import Table, TableRefused, read_table


def generate_table(item: TableItem, site: Site) -> Generated:
    """Blocks in the order in which the table of vertices names them first.

    Raises
    ------
    ItemRefused
        with every fault of the tables, by file and line
    DeckError
        for files that are missing or outside the deck's folder
    """
    findings: list[tuple[KeyPath, Message]] = []
    vertices, faces = (
        _read(item, site, key, columns, rest, findings)
        for key, columns, rest in (
            ("vertices", ("block", "vertex", "x", "y", "z"), False),
            ("faces", ("block", "face"), True),
        )
    )
    if vertices is None or faces is None:
        raise ItemRefused(findings)
    faults: list[Message] = []
    points = vertices.numbers("xyz", faults)
    blocks, row_of_vertex = _vertices_by_name(vertices, faults)
    findings += [(("vertices",), fault) for fault in TableRefused(faults).faults]
    faults = []
    block_of_face, corners = _faces(faces, blocks, row_of_vertex, faults)
    findings += [(("faces",), fault) for fault in TableRefused(faults).faults]
    if findings:
        raise ItemRefused(findings)
    names = list(blocks)
    owner = np.array([blocks[name] for name in vertices.columns["block"]], dtype=np.int64)
    polyhedra = _polyhedra(points, owner, np.array(block_of_face, dtype=np.int64), corners, len(names))
    return Generated((Part(polyhedra, member=[member_name(name) for name in names]),))


def _read(
    item: TableItem, site: Site, key: str, columns: tuple[str, ...], rest: bool, findings: list[tuple[KeyPath, Message]]
) -> Table | None:
    try:
        return read_table(site.resolve_file((key,), getattr(item, key)), columns, with_rest=rest)
    except TableRefused as refused:
        findings += [((key,), fault) for fault in refused.faults]
        return None


def _vertices_by_name(table: Table, faults: list[Message]) -> tuple[dict[str, int], dict[tuple[str, str], int]]:
    """Number of each block by its name, and row of each vertex by the names of block and vertex."""
    blocks: dict[str, int] = {}
    rows: dict[tuple[str, str], int] = {}
    for row, key in enumerate(zip(table.columns["block"], table.columns["vertex"], strict=True)):
        block, vertex = key
        if not block or not vertex:
            faults.append(Message("table-row", f"{table.place(row)}: {'vertex' if block else 'block'} is empty"))
        elif key in rows:
            faults.append(
                Message(
                    "table-row",
                    f"{table.place(row)}: block {block} has a vertex {vertex} in line {table.lines[rows[key]]}",
                )
            )
        blocks.setdefault(block, len(blocks))
        rows.setdefault(key, row)
    return blocks, rows


def _faces(
    table: Table, blocks: dict[str, int], row_of_vertex: dict[tuple[str, str], int], faults: list[Message]
) -> tuple[list[int], list[list[int]]]:
    """Block of each face, and its corners as rows of the table of vertices."""
    owners, corners = [], []
    for row, (block, names) in enumerate(zip(table.columns["block"], table.rest, strict=True)):
        missing = [name for name in names if (block, name) not in row_of_vertex]
        if block not in blocks:
            faults.append(Message("table-row", f"{table.place(row)}: block {block or '(empty)'} has no vertices"))
        elif missing:
            faults.append(Message("table-row", f"{table.place(row)}: block {block} has no vertex {missing[0]}"))
        elif len(names) < 3:
            faults.append(
                Message(
                    "table-row", f"{table.place(row)}: a face has at least three corners, this one has {len(names)}"
                )
            )
        else:
            owners.append(blocks[block])
            corners.append([row_of_vertex[block, name] for name in names])
    bare = set(blocks.values()) - set(owners)
    if bare and not faults:
        names_of_bare = [name for name, number in blocks.items() if number in bare]
        faults.append(Message("table-row", f"{table.file}: block {names_of_bare[0]} has no faces"))
    return owners, corners


def _polyhedra(
    points: np.typing.NDArray[np.float64], owner: IntArray, block_of_face: IntArray, corners: list[list[int]], n: int
) -> Polyhedra:
    """Vertices and faces sorted by block, each in the order of its table."""
    order = np.argsort(owner, kind="stable")
    place = np.empty(len(order), dtype=np.int64)
    place[order] = np.arange(len(order))
    faces = [corners[row] for row in np.argsort(block_of_face, kind="stable")]
    return Polyhedra(
        vertices=points[order],
        vertex_start=starts(np.bincount(owner, minlength=n)),
        loops=place[np.array([corner for face in faces for corner in face], dtype=np.int64)],
        loop_start=starts(np.array([len(face) for face in faces], dtype=np.int64)),
        face_start=starts(np.bincount(block_of_face, minlength=n)),
    )
