"""Input files of Abaqus and CalculiX: nodes, elements, and the element sets that name them.

Solid elements are blocks, one each; a file without any holds surfaces (shells, plane elements, facets). Elements of
second order go by their corners. Read here because the library at hand keeps only the last of several ``*NODE`` cards,
knows few types of elements, and follows ``*INCLUDE`` out of the deck's folder.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Notice
from mbla.model.geometry.geometry import (
    Geometry,
    GeometryFileError,
    cells_left_out,
    malformed,
    refuse_long_line,
    unused_points,
)
from mbla.model.geometry.surfaces import VOLUME_CELLS
from mbla.model.geometry.welding import surfaces_by_label
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_cells, take_polyhedra

SOLIDS = re.compile(r"(?:C3D|F3D|DC3D|AC3D)(4|6|8|10|15|20|27)(?:[A-Z].*)?$")
"""solid elements of stress, fluid and heat flow; the number is that of the nodes, letters are variants"""
SHELLS = re.compile(r"(?:S|M3D|CPS|CPE|CPEG|CAX|R3D|SFM3D|DS|DCAX|STRI)(3|4|6|8|9|65)(?:[A-Z].*|5)?$")
SOLID_SHAPES = {
    4: "tetra",
    10: "tetra",
    6: "wedge",
    15: "wedge",
    8: "hexahedron",
    20: "hexahedron",
    27: "hexahedron",
}
SHELL_CORNERS = {3: 3, 6: 3, 65: 3, 4: 4, 8: 4, 9: 4}
SHELL_NODES = {65: 6}
REFUSED = {
    "INCLUDE": "put the mesh into one file",
    "INSTANCE": "write the input without parts and assemblies",
    "SYSTEM": "write the nodes in global coordinates",
    "NGEN": "write all nodes",
    "ELGEN": "write all elements",
    "NCOPY": "write all nodes",
    "ELCOPY": "write all elements",
}
"""cards that change the mesh in ways that are not followed"""

UNREADABLE = "\ufffd"
"""stands for bytes that are no text"""
ALIKE = frozenset({"NSET", "ELGEN", "NODE FILE", "NODE PRINT", "NODAL", "SECTION", "CLEARANCE"})
"""cards of other names than those that are followed, and not misspelt"""


@dataclass
class _Card:
    """A card: its line, keyword and options in capitals, and its lines of data with their numbers, split at commas."""

    line: int
    keyword: str
    options: dict[str, str]
    data: list[tuple[int, list[str]]] = field(default_factory=list)


@dataclass
class _Content:
    """The mesh as read: nodes by number, elements by number with type, nodes and set, members of sets in their order.

    Members may be ranges: a line can name more elements than any file has.
    """

    nodes: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    elements: dict[int, tuple[str, list[int], str]] = field(default_factory=dict)
    sets: dict[str, dict[int | range, None]] = field(default_factory=dict)


def read_inp(path: Path) -> Geometry:
    """Solid elements, or else the surfaces, of an input file in the order of the file.

    Raises
    ------
    GeometryFileError
        for malformed lines, with their number, and for cards that are not followed
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    content = _read(text)
    if text.strip() and not content.nodes and not content.elements:
        raise malformed("Abaqus or CalculiX .inp", "it has no nodes")
    rows = {number: row for row, number in enumerate(content.nodes)}
    points = np.array(list(content.nodes.values()), dtype=np.float64).reshape(-1, 3)
    names = _set_of_elements(content)
    solids = {n: e for n, e in content.elements.items() if SOLIDS.match(e[0])}
    shells = {} if solids else {n: e for n, e in content.elements.items() if SHELLS.match(e[0])}
    used = solids or shells
    nodes = [rows[node] for _, numbers, _ in content.elements.values() for node in numbers if node in rows]
    left_out = (kind for number, (kind, _, _) in content.elements.items() if number not in used)
    notices = cells_left_out(left_out, bool(solids)) + unused_points(len(rows), np.array(nodes, dtype=np.int64))
    try:
        if solids:
            cells, order = _solids(solids, rows, points)
            named = tuple(names.get(number, "") for number in order)
            return Geometry(cells, notices, named if any(named) else (), cells=True)
        return _surfaces(shells, rows, points, names, notices)
    except KeyError as error:
        raise GeometryFileError("geometry-file", f"an element names node {error}, which does not exist") from error


def _read(text: str) -> _Content:
    content = _Content()
    for card in _cards(text):
        if card.keyword in REFUSED:
            raise GeometryFileError(
                "geometry-not-read", f"line {card.line}: *{card.keyword} is not followed: {REFUSED[card.keyword]}"
            )
        _refuse_misspelt(card)
        read = READ.get(card.keyword)
        if read is not None:
            read(content, card)
    return content


def _refuse_misspelt(card: _Card) -> None:
    """Cards that are not known are passed over; one that is nearly known would take its blocks with it."""
    if UNREADABLE in card.keyword + "".join(card.options) + card.options.get("TYPE", ""):
        raise GeometryFileError("geometry-file", f"line {card.line} cannot be read: it has bytes that are no UTF-8")
    if card.keyword not in (*READ, *ALIKE):
        near = get_close_matches(card.keyword, READ, n=1, cutoff=0.8)
        if near:
            words = f"line {card.line} cannot be read: *{card.keyword} is no card; did you mean *{near[0]}?"
            raise GeometryFileError("geometry-file", words)


def _read_nodes(content: _Content, card: _Card) -> None:
    """Nodes in space; a number given twice is one node only where both lie at one place."""
    for number, fields in card.data:
        try:
            if len(fields) != 4:
                raise ValueError(f"a node has its number and three coordinates, here are {len(fields)} fields")
            node, place = int(fields[0]), (float(fields[1]), float(fields[2]), float(fields[3]))
            if content.nodes.setdefault(node, place) != place:
                raise ValueError(f"node {node} lies elsewhere in an earlier line")
        except ValueError as error:
            raise _unreadable(number, error) from error


def _read_elements(content: _Content, card: _Card) -> None:
    """Elements of one type; one may go on over several lines."""
    kind, name = card.options.get("TYPE", "").upper(), card.options.get("ELSET", "")
    needed = _node_count(kind)
    numbers: list[int] = []
    for number, fields in card.data:
        try:
            numbers += [int(each) for each in fields]
        except ValueError as error:
            raise _unreadable(number, error) from error
        if needed is None or len(numbers) > needed:
            _add_element(content, number, kind, numbers, name, needed)
            numbers = []
    if numbers:
        raise GeometryFileError(
            "geometry-file", f"line {card.line}: the last element has fewer than the {needed} nodes of a {kind}"
        )


def _add_element(content: _Content, line: int, kind: str, numbers: list[int], name: str, needed: int | None) -> None:
    if needed is not None and len(numbers) > needed + 1:
        raise _unreadable(line, ValueError(f"a {kind} has {needed} nodes, here are {len(numbers) - 1}"))
    element = (kind, numbers[1:], name)
    if content.elements.setdefault(numbers[0], element)[:2] != element[:2]:
        raise _unreadable(line, ValueError(f"element {numbers[0]} has other nodes in an earlier line"))


def _read_set(content: _Content, card: _Card) -> None:
    """Members of ``*ELSET``: numbers, ranges with GENERATE, or names of earlier sets."""
    members = content.sets.setdefault(card.options.get("ELSET", ""), {})
    for number, fields in card.data:
        try:
            if "GENERATE" in card.options:
                first, last, *step = (int(each) for each in fields)
                members[range(first, last + 1, step[0] if step else 1)] = None
                continue
            for each in fields:
                members.update({int(each): None} if each.isdigit() else content.sets.get(each, {}))
        except ValueError as error:
            raise _unreadable(number, error) from error


READ = {"NODE": _read_nodes, "ELEMENT": _read_elements, "ELSET": _read_set}
"""cards that are followed, and how"""


def _unreadable(line: int, error: ValueError) -> GeometryFileError:
    return GeometryFileError("geometry-file", f"line {line} cannot be read: {error}")


def _cards(text: str) -> Iterator[_Card]:
    card: _Card | None = None
    for number, raw in enumerate(text.splitlines(), start=1):
        refuse_long_line(number, len(raw))
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if line.startswith("*"):
            if card is not None:
                yield card
            keyword, *rest = (each.strip() for each in line[1:].split(","))
            pairs = (each.partition("=") for each in rest)
            options = {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}
            card = _Card(number, keyword.upper(), options)
        elif card is not None:
            card.data.append((number, [each.strip() for each in line.rstrip(",").split(",")]))
    if card is not None:
        yield card


def _node_count(kind: str) -> int | None:
    """Number of nodes of a type that is read; None for others, whose elements are only counted."""
    if match := SOLIDS.match(kind):
        return int(match[1])
    if match := SHELLS.match(kind):
        return SHELL_NODES.get(int(match[1]), int(match[1]))
    return None


def _set_of_elements(content: _Content) -> dict[int, str]:
    """Name of the smallest set that each element is in; of equal ones that of an ``*ELSET`` card."""
    sets = {(True, name): _elements_in(members, content) for name, members in content.sets.items()}
    for number, (_, _, name) in content.elements.items():
        if name:
            sets.setdefault((False, name), []).append(number)
    names: dict[int, str] = {}
    for (_, name), members in sorted(sets.items(), key=lambda item: (-len(item[1]), item[0][0])):
        names.update(dict.fromkeys(members, name))
    return names


def _elements_in(members: Mapping[int | range, None], content: _Content) -> list[int]:
    """Elements of the file that a set names."""
    found: dict[int, None] = {}
    for each in members:
        if isinstance(each, int):
            named: Iterable[int] = (each,)
        elif (each.stop - each.start) // each.step <= len(content.elements):
            named = each
        else:
            named = (number for number in content.elements if number in each)
        found.update((number, None) for number in named if number in content.elements)
    return list(found)


def _solids(
    solids: dict[int, tuple[str, list[int], str]], rows: dict[int, int], points: FloatArray
) -> tuple[Polyhedra, list[int]]:
    """One polyhedron for each solid element in the order of the file, and their numbers."""
    by_shape: dict[str, list[int]] = {}
    for number, (kind, _, _) in solids.items():
        match = SOLIDS.match(kind)
        assert match is not None  # chosen by it
        by_shape.setdefault(SOLID_SHAPES[int(match[1])], []).append(number)
    parts, numbers = [], []
    for shape, members in by_shape.items():
        count, faces = VOLUME_CELLS[shape]
        corners = np.array([[rows[node] for node in solids[number][1][:count]] for number in members])
        parts.append(polyhedra_from_cells(points[corners], faces))
        numbers += members
    position = {number: place for place, number in enumerate(solids)}
    order = np.argsort([position[number] for number in numbers], kind="stable")
    return take_polyhedra(join_polyhedra(parts), order), [numbers[row] for row in order]


def _surfaces(
    shells: dict[int, tuple[str, list[int], str]],
    rows: dict[int, int],
    points: FloatArray,
    names: dict[int, str],
    notices: tuple[Notice, ...],
) -> Geometry:
    """Faces of each element set as one surface; of a file without sets all faces as one."""
    faces, owners = [], []
    for number, (kind, nodes, _) in shells.items():
        match = SHELLS.match(kind)
        assert match is not None  # chosen by it
        faces.append([rows[node] for node in nodes[: SHELL_CORNERS[int(match[1])]]])
        owners.append(names.get(number, ""))
    surfaces, present = surfaces_by_label(points, faces, owners)
    return Geometry(surfaces, notices, tuple(present) if any(present) else ())
