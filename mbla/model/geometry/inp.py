"""Input files of Abaqus and CalculiX: nodes, elements, and the element sets that name them.

Solid elements are blocks, one each; a file without any holds surfaces (shells, plane elements, facets). Elements of
second order go by their corners. Read here because the library at hand keeps only the last of several ``*NODE`` cards,
knows few types of elements, and follows ``*INCLUDE`` out of the deck's folder.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from mbla.model.geometry.cells import VOLUME_CELLS
from mbla.model.geometry.geometry import Geometry, GeometryFileError, cells_left_out, malformed, unused_points
from mbla.model.geometry.welding import surfaces_by_label
from mbla.model.solids.polyhedra import polyhedra_from_lists

SOLIDS = re.compile(r"(?:C3D|F3D|DC3D|AC3D)(4|6|8|10|15|20|27)(?:[A-Z].*)?$")
"""solid elements of stress, fluid and heat flow; the number is that of the nodes, letters are variants"""
SHELLS = re.compile(r"(?:S|M3D|CPS|CPE|CPEG|CAX|R3D|SFM3D|DS|DCAX|STRI)(3|4|6|8|9|65)(?:[A-Z].*|5)?$")
SOLID_SHAPES = {"tetra": (4, 10), "wedge": (6, 15), "hexahedron": (8, 20, 27)}
"""shapes by their numbers of nodes"""
SHELL_CORNERS = {3: 3, 6: 3, 4: 4, 8: 4, 9: 4}
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
FOLLOWED = ("NODE", "ELEMENT", "ELSET")
ALIKE = frozenset({"NSET", "ELGEN", "NODE FILE", "NODE PRINT", "NODAL", "SECTION", "CLEARANCE"})
"""cards of other names than those that are followed, and not misspelt"""
UNREADABLE = "\ufffd"
"""stands for bytes that are no text"""


@dataclass
class _Card:
    """A card: its line, keyword and options in capitals, and its lines of data with their numbers, split at commas."""

    line: int
    keyword: str
    options: dict[str, str]
    data: list[tuple[int, list[str]]] = field(default_factory=list)


@dataclass
class _InpMesh:
    """The mesh as read: nodes by number, elements by number with type, nodes and set, members of sets in their order.

    Members may be ranges: a line can name more elements than any file has.
    """

    nodes: dict[int, tuple[float, ...]] = field(default_factory=dict)
    elements: dict[int, tuple[str, list[int], str]] = field(default_factory=dict)
    sets: dict[str, dict[range, None]] = field(default_factory=dict)


def read_inp(path: Path) -> Geometry:
    """Solid elements, or else the surfaces, of an input file in the order of the file.

    Raises GeometryFileError for malformed lines, with their number, and for cards that are not followed.
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    content = _InpMesh()
    for card in _cards(text):
        _read_card(content, card)
    if text.strip() and not content.nodes and not content.elements:
        raise malformed("Abaqus or CalculiX .inp", "it has no nodes")
    rows = {number: row for row, number in enumerate(content.nodes)}
    for kind, nodes, _ in content.elements.values():
        missing = [node for node in nodes if node not in rows]
        if missing and (SOLIDS.match(kind) or SHELLS.match(kind)):
            raise GeometryFileError("geometry-file", f"an element names node {missing[0]}, which does not exist")
    points = np.array(list(content.nodes.values()), dtype=np.float64).reshape(-1, 3)
    solids = [number for number, (kind, _, _) in content.elements.items() if SOLIDS.match(kind)]
    used = solids or [number for number, (kind, _, _) in content.elements.items() if SHELLS.match(kind)]
    left_out = [kind for number, (kind, _, _) in content.elements.items() if number not in set(used)]
    named = [rows[node] for _, nodes, _ in content.elements.values() for node in nodes if node in rows]
    notices = cells_left_out(left_out, bool(solids)) + unused_points(len(rows), np.array(named, dtype=np.int64))
    sets = _set_of_elements(content)
    names = [sets.get(number, "") for number in used]
    corners = [[rows[node] for node in content.elements[number][1]] for number in used]
    if solids:
        shapes = [_solid(len(each)) for each in corners]
        vertices = [points[each[:count]] for each, (count, _) in zip(corners, shapes, strict=True)]
        cells = polyhedra_from_lists(vertices, [faces for _, faces in shapes])
        return Geometry(cells, notices, tuple(names) if any(names) else (), cells=True)
    faces = [each[: SHELL_CORNERS[len(each)]] for each in corners]
    surfaces, present = surfaces_by_label(points, faces, names)
    return Geometry(surfaces, notices, tuple(present) if any(present) else ())


def _solid(nodes: int) -> tuple[int, list[list[int]]]:
    """Number of corners and faces of a solid with this number of nodes."""
    shape = next(shape for shape, counts in SOLID_SHAPES.items() if nodes in counts)
    count, faces = VOLUME_CELLS[shape]
    return count, [list(face) for face in faces]


def _cards(text: str) -> Iterator[_Card]:
    card: _Card | None = None
    for number, raw in enumerate(text.splitlines(), start=1):
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


def _read_card(content: _InpMesh, card: _Card) -> None:
    """Cards that are not known are passed over; a misspelt one would lose its blocks."""
    if card.keyword in REFUSED:
        words = f"line {card.line}: *{card.keyword} is not followed: {REFUSED[card.keyword]}"
        raise GeometryFileError("geometry-not-read", words)
    if UNREADABLE in card.keyword + "".join(card.options) + card.options.get("TYPE", ""):
        raise _unreadable(card.line, "it has bytes that are no UTF-8")
    if card.keyword not in (*FOLLOWED, *ALIKE) and (near := get_close_matches(card.keyword, FOLLOWED, 1, 0.8)):
        raise _unreadable(card.line, f"*{card.keyword} is no card; did you mean *{near[0]}?")
    number = card.line
    try:
        if card.keyword == "ELEMENT":
            _read_elements(content, card)
        for at, fields in card.data if card.keyword in ("NODE", "ELSET") else ():
            number = at
            if card.keyword == "NODE":
                _read_node(content, fields)
            else:
                _read_members(content, card, fields)
    except ValueError as error:
        raise _unreadable(number, error) from error


def _unreadable(line: int, error: object) -> GeometryFileError:
    return GeometryFileError("geometry-file", f"line {line} cannot be read: {error}")


def _read_node(content: _InpMesh, fields: list[str]) -> None:
    """A number given twice is one node only where both lie at one place."""
    if len(fields) != 4:
        raise ValueError(f"a node has its number and three coordinates, here are {len(fields)} fields")
    node, place = int(fields[0]), tuple(float(each) for each in fields[1:])
    if content.nodes.setdefault(node, place) != place:
        raise ValueError(f"node {node} lies elsewhere in an earlier line")


def _read_elements(content: _InpMesh, card: _Card) -> None:
    """Elements of one type; one may go on over several lines."""
    kind, name = card.options.get("TYPE", "").upper(), card.options.get("ELSET", "")
    match = SOLIDS.match(kind) or SHELLS.match(kind)
    needed = None if match is None else {65: 6}.get(int(match[1]), int(match[1]))
    numbers: list[int] = []
    for line, fields in card.data:
        try:
            numbers += [int(each) for each in fields]
            if needed is not None and len(numbers) <= needed:
                continue
            if needed is not None and len(numbers) > needed + 1:
                raise ValueError(f"a {kind} has {needed} nodes, here are {len(numbers) - 1}")
            element = (kind, numbers[1:], name)
            if content.elements.setdefault(numbers[0], element)[:2] != element[:2]:
                raise ValueError(f"element {numbers[0]} has other nodes in an earlier line")
        except ValueError as error:
            raise _unreadable(line, error) from error
        numbers = []
    if numbers:
        words = f"line {card.line}: the last element has fewer than the {needed} nodes of a {kind}"
        raise GeometryFileError("geometry-file", words)


def _read_members(content: _InpMesh, card: _Card, fields: list[str]) -> None:
    """Members of ``*ELSET``: numbers, ranges with GENERATE, or names of earlier sets."""
    members = content.sets.setdefault(card.options.get("ELSET", ""), {})
    if "GENERATE" in card.options:
        first, last, *step = (int(each) for each in fields)
        members[range(first, last + 1, step[0] if step else 1)] = None
        return
    for each in fields:
        own = {range(int(each), int(each) + 1): None} if each.isdigit() else content.sets.get(each, {})
        members.update(own)


def _set_of_elements(content: _InpMesh) -> dict[int, str]:
    """Name of the smallest set that each element is in; of equal ones that of an ``*ELSET`` card."""
    found: dict[tuple[bool, str], list[int]] = {}
    for name, members in content.sets.items():
        few = {number for each in members if len(each) <= len(content.elements) for number in each}
        many = [each for each in members if len(each) > len(content.elements)]
        found[True, name] = [each for each in content.elements if each in few or any(each in some for some in many)]
    for number, (_, _, name) in content.elements.items():
        if name:
            found.setdefault((False, name), []).append(number)
    names: dict[int, str] = {}
    for (_, name), numbers in sorted(found.items(), key=lambda item: (-len(item[1]), item[0][0])):
        names.update(dict.fromkeys(numbers, name))
    return names
