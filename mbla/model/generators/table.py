"""Generator of blocks from tables of their vertices and faces."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.deck.items.files import TableItem
from mbla.errors import Finding, Message
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.geometry.geometry import member_name
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.tables import Table, TableRefused, read_table

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
    vertices, faces = tables["vertices"], tables["faces"]
    points = vertices.numbers("xyz")
    blocks, row_of_vertex = _vertices_by_name(vertices)
    block_of_face, corners = _faces(faces, blocks, row_of_vertex)
    for key, table in tables.items():
        with _collected(findings, key):
            table.check()
    if findings:
        raise ItemRefused(*findings)
    owner = np.array([blocks[name] for name in vertices.columns["block"]], dtype=np.int64)
    polyhedra = _polyhedra(points, owner, np.array(block_of_face, dtype=np.int64), corners, len(blocks))
    return Generated((Part(polyhedra, member=[member_name(name) for name in blocks]),))


@contextmanager
def _collected(findings: list[Finding], key: str) -> Iterator[None]:
    try:
        yield
    except TableRefused as refused:
        findings += refused.findings(key)


def _vertices_by_name(table: Table) -> tuple[dict[str, int], dict[tuple[str, str], int]]:
    """Number of each block by its name, and row of each vertex by the names of block and vertex."""
    blocks: dict[str, int] = {}
    rows: dict[tuple[str, str], int] = {}
    for row, key in enumerate(zip(table.columns["block"], table.columns["vertex"], strict=True)):
        block, vertex = key
        if not block or not vertex:
            table.refuse(row, f"{'vertex' if block else 'block'} is empty")
        elif key in rows:
            table.refuse(row, f"block {block} has a vertex {vertex} in line {table.lines[rows[key]]}")
        blocks.setdefault(block, len(blocks))
        rows.setdefault(key, row)
    return blocks, rows


def _faces(
    table: Table, blocks: dict[str, int], row_of_vertex: dict[tuple[str, str], int]
) -> tuple[list[int], list[list[int]]]:
    """Block of each face, and its corners as rows of the table of vertices."""
    owners, corners = [], []
    for row, (block, names) in enumerate(zip(table.columns["block"], table.rest, strict=True)):
        missing = [name for name in names if (block, name) not in row_of_vertex]
        if block not in blocks:
            table.refuse(row, f"block {block or '(empty)'} has no vertices")
        elif missing:
            table.refuse(row, f"block {block} has no vertex {missing[0]}")
        elif len(names) < 3:
            table.refuse(row, f"a face has at least three corners, this one has {len(names)}")
        else:
            owners.append(blocks[block])
            corners.append([row_of_vertex[block, name] for name in names])
    with_faces = set(owners)
    bare = next((name for name, number in blocks.items() if number not in with_faces), None)
    if bare is not None and not table.faults:
        table.faults.append(Message("table-row", f"{table.file}: block {bare} has no faces"))
    return owners, corners


def _polyhedra(
    points: FloatArray, owner: IntArray, block_of_face: IntArray, corners: list[list[int]], n: int
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
