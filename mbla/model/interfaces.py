"""Prescribed interfaces: a deck gives them as a table of their corners, instead of having them found.

Each must lie on a face of either body, within the tolerance of contacts: what lies off a face is no interface. Nor
may two of one pair of bodies lie on each other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray, starts
from mbla.deck.deck import Deck
from mbla.deck.sections.materials import BUILT_IN
from mbla.deck.suggestions import did_you_mean, unknown
from mbla.errors import DeckError, KeyPath, Message
from mbla.model.model import Ground, PrescribedInterfaces
from mbla.model.selectors import BlockSelection
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import plane_axes
from mbla.model.supports.surfaces import lies_on
from mbla.model.tables import CsvTable, TableRefused, read_table

GROUND = "ground"
"""name that stands for ground planes, numbered in their order"""
COLUMNS = ("interface", "group_a", "index_a", "group_b", "index_b", "x", "y", "z")
OPTIONAL = ("joint",)
FLAT = 1e-6
"""area over perimeter squared below which an outline has none"""
FACING = 0.99
"""cosine of the greatest angle between an interface and a face on which it lies, and between two such faces"""


@dataclass(frozen=True)
class _Bodies:
    """Faces of bodies on which interfaces may lie; tolerance relative to block size."""

    blocks: Blocks
    members: dict[str, IntArray]
    grounds: tuple[Ground, ...]
    tolerance: float

    def reach(self, pair: tuple[int, int]) -> float:
        """Distance that is rounding at an interface of two bodies; grounds have no size."""
        return self.tolerance * min(float(self.blocks.sizes[body]) for body in pair if body < len(self.blocks))


def read_interfaces(deck: Deck, selection: BlockSelection, grounds: tuple[Ground, ...]) -> PrescribedInterfaces | None:
    """Interfaces of the deck's table; None where it has none, or where it has faults, which go to the selection."""
    path: KeyPath = ("contacts", "table")
    if deck.contacts.table is None or selection.partial:
        return None
    try:
        table = read_table(deck.resolve_file(path, deck.contacts.table), COLUMNS, OPTIONAL)
        bodies = _Bodies(selection.blocks, selection.members, grounds, deck.contacts.tolerance)
        return _prescribed(table, bodies, (*deck.content.joints, *BUILT_IN))
    except DeckError as error:
        selection.faults.extend(error.faults)
    except TableRefused as refused:
        selection.faults.extend(deck.fault_at(path, fault) for fault in refused.faults)
    return None


def _prescribed(table: CsvTable, bodies: _Bodies, joints: Collection[str]) -> PrescribedInterfaces:
    """Interfaces of a table with a row for each corner, those of an interface together; joints are names of laws.

    Raises TableRefused with every fault, by file and line.
    """
    points = table.numbers("xyz")
    both = np.array([_pair(table, row, bodies) for row in range(len(table))])
    start = _starts(table, both, joints)
    table.check()
    pairs: list[tuple[int, int]] = [(int(a), int(b)) for a, b in both[start[:-1]]]
    normals, outlines, faults = [], [], []
    for row, last, pair in zip(start[:-1], start[1:], pairs, strict=True):
        found = _oriented(points[row:last], pair, bodies)
        if isinstance(found, str):
            faults.append(f"{_called(table, row)} {found}")
        else:
            normals.append(found[0])
            outlines.append(found[1])
    if not faults:
        names = table.columns["interface"]
        faults = [
            f"{_called(table, start[other])} overlaps interface {names[start[one]]} between the same bodies"
            for one, other in _overlapping(pairs, normals, outlines, [bodies.reach(pair) for pair in pairs])
        ]
    if faults:
        raise TableRefused(*(Message("interface-misfit", fault) for fault in faults))
    laws = table.columns.get("joint", [""] * len(table))
    corners, joint = np.concatenate(outlines), tuple(laws[row] for row in start[:-1])
    return PrescribedInterfaces(np.array(pairs), np.array(normals), corners, start, joint)


def _called(table: CsvTable, row: int) -> str:
    """``contacts.csv:7: interface bed``."""
    return f"{table.file}:{table.lines[row]}: interface {table.columns['interface'][row]}"


def _pair(table: CsvTable, row: int, bodies: _Bodies) -> tuple[int, int]:
    """Body a and b of a row, a ground plane first, else the block of lower number; -1 where there is a fault."""
    count, found = len(bodies.blocks), list[int | None]()
    for side in "ab":
        group = table.columns[f"group_{side}"][row]
        known = bodies.members.get(group)
        known = np.arange(count, count + len(bodies.grounds)) if group == GROUND else known
        if known is None:
            table.refuse(row, f"unknown group {group}{did_you_mean(group, bodies.members)}")
            continue
        there = f"has 0 to {len(known) - 1}" if len(known) else "has none: give ground under supports"
        found.append(table.place_in(f"index_{side}", row, known, f"{group} {there}"))
    match found:
        case [int(a), int(b)]:
            if a == b or min(a, b) >= count:
                table.refuse(row, "an interface is between two blocks, or a block and ground")
            first, second = sorted((a, b), key=lambda body: (body < count, body))
            return first, second
    return -1, -1


def _starts(table: CsvTable, bodies: IntArray, joints: Collection[str]) -> IntArray:
    """First row of each interface, and the number of rows; rows of one interface agree and follow each other."""
    names, laws = table.columns["interface"], table.columns.get("joint", [""] * len(table))
    first = [row for row in range(len(table)) if row == 0 or names[row] != names[row - 1]]
    start = starts(np.diff([*first, len(table)]))
    seen: set[str] = set()
    for row, last in zip(first, start[1:], strict=True):
        if names[row] in seen:
            table.refuse(row, f"the rows of interface {names[row]} do not follow each other")
        seen.add(names[row])
        if (bodies[row:last] != bodies[row]).any():
            table.refuse(row, f"interface {names[row]} is between different blocks in its rows")
        if len(set(laws[row:last])) > 1:
            table.refuse(row, f"interface {names[row]} has different joint laws in its rows")
        elif laws[row] and laws[row] not in joints:
            table.refuse(row, unknown("joint", laws[row], joints, "known"))
    return start


def _oriented(points: FloatArray, pair: tuple[int, int], bodies: _Bodies) -> tuple[FloatArray, FloatArray] | str:
    """Normal from a to b and outline counter-clockwise about it; or what is wrong with them."""
    if len(points) < 3:
        return f"has {len(points)} corners: at least three make an outline"
    arms = points - points.mean(axis=0)
    ahead = np.roll(arms, -1, axis=0)
    area_vector = 0.5 * np.cross(arms, ahead).sum(axis=0)
    area = float(np.linalg.norm(area_vector))
    if area <= FLAT * np.linalg.norm(ahead - arms, axis=1).sum() ** 2:
        return "has no area"
    normal, reach = area_vector / area, bodies.reach(pair)
    departure = float(np.abs(arms @ normal).max())
    if departure > reach:
        return f"is not planar: corners leave its plane by {departure:.3g}"
    for turn in (1.0, -1.0):
        if all(
            _lies_on(points, sign * turn * normal, body, bodies, reach)
            for body, sign in zip(pair, (1, -1), strict=True)
        ):
            return turn * normal, points if turn > 0 else points[::-1]
    return "does not lie on a face of both: its corners must, within contacts.tolerance"


def _lies_on(points: FloatArray, normal: FloatArray, body: int, bodies: _Bodies, reach: float) -> bool:
    """Whether all corners lie on a ground, or within one facet of a block, that faces along the normal."""
    blocks = bodies.blocks
    if body >= len(blocks):
        ground = bodies.grounds[body - len(blocks)]
        return bool(ground.normal @ normal > FACING and lies_on(points, ground, reach).all())
    faces = np.arange(blocks.face_start[body], blocks.face_start[body + 1])
    faces = faces[blocks.face_normals[faces] @ normal > FACING]
    frame = plane_axes(normal[None])[0].T
    facets = blocks.facet_of_face[faces]
    covered = np.zeros((len(faces), len(points)), dtype=bool)
    for row, face in enumerate(faces):
        outline = blocks.vertices[blocks.loop(face)]
        near = np.abs((points[:, None] - outline) @ normal).min(axis=1) <= reach
        covered[row] = near & shapely.dwithin(shapely.polygons(outline @ frame), shapely.points(points @ frame), reach)
    return any(covered[facets == facet].any(axis=0).all() for facet in np.unique(facets))


def _overlapping(
    pairs: Sequence[tuple[int, int]],
    normals: Sequence[FloatArray],
    outlines: Sequence[FloatArray],
    reach: Sequence[float],
) -> Iterator[tuple[int, int]]:
    """Numbers of interfaces, the earlier one first, that share more than a strip as wide as ``reach`` along an edge.

    outlines : (n, 3) corners of each, counter-clockwise about its normal
    """
    of_pair: dict[tuple[int, int], list[int]] = {}
    for number, pair in enumerate(pairs):
        of_pair.setdefault(pair, []).append(number)
    for first, second in (both for numbers in of_pair.values() for both in combinations(numbers, 2)):
        away = np.abs((outlines[second] - outlines[first][0]) @ normals[first])
        if normals[first] @ normals[second] < FACING or away.min() > reach[first]:
            continue  # steps of one bed
        frame = plane_axes(normals[first][None])[0].T
        one, two = shapely.make_valid([shapely.Polygon(outlines[each] @ frame) for each in (first, second)])
        # no edge of a convex outline is longer than half its perimeter
        if shapely.area(shapely.intersection(one, two)) > reach[first] * min(one.length, two.length) / 2:
            yield first, second
