"""Prescribed interfaces: a deck gives them as a table of their corners, instead of having them found.

Each must lie on a face of either body, within the tolerance of contacts: what lies beside a face is no interface. Nor
may two of one pair of bodies lie on each other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import combinations

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.deck.deck import Deck
from mbla.deck.sections.materials import BUILT_IN
from mbla.deck.suggestions import did_you_mean, unknown
from mbla.deck.tree import KeyPath
from mbla.errors import DeckError, Message
from mbla.model.model import Ground, PrescribedInterfaces
from mbla.model.selectors import Roster
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import plane_axes
from mbla.model.tables import Table, TableRefused, read_table

GROUND = "ground"
"""name that stands for ground planes, numbered in their order"""
COLUMNS = ("interface", "group_a", "index_a", "group_b", "index_b", "x", "y", "z")
OPTIONAL = ("joint",)
FLAT = 1e-6
"""area over perimeter squared below which an outline has none"""
FACING = 0.99
"""cosine of the angle between an interface and a face that it may lie on, as of faces of one facet"""


def read_interfaces(deck: Deck, roster: Roster, grounds: tuple[Ground, ...]) -> PrescribedInterfaces | None:
    """Interfaces of the deck's table; None where it has none, or where it is at fault, which the roster is told."""
    path: KeyPath = ("contacts", "table")
    if deck.contacts.table is None or roster.partial:
        return None
    try:
        table = read_table(deck.resolve_file(path, deck.contacts.table), COLUMNS, OPTIONAL)
        laws = (*deck.content.joints, *BUILT_IN)
        return prescribed_interfaces(table, roster.blocks, roster.members, grounds, laws, deck.contacts.tolerance)
    except DeckError as error:
        roster.faults.extend(error.faults)
    except TableRefused as refused:
        roster.faults.extend(deck.fault_at(path, fault) for fault in refused.faults)
    return None


def prescribed_interfaces(
    table: Table,
    blocks: Blocks,
    members: dict[str, IntArray],
    grounds: tuple[Ground, ...],
    joints: Collection[str],
    tolerance: float,
) -> PrescribedInterfaces:
    """Interfaces of a table with the columns ``COLUMNS``, a row for each corner, those of an interface together.

    members : blocks of each group; joints : names of laws; tolerance : relative to block size

    Raises
    ------
    TableRefused
        with every fault, by file and line
    """
    points = table.numbers("xyz")
    bodies = np.array([_bodies(table, row, members, len(blocks), len(grounds)) for row in range(len(table))])
    start = _starts(table, bodies, joints)
    table.check()
    first = start[:-1]
    pairs = [_ground_first(bodies[row].tolist(), len(blocks)) for row in first]
    normals, outlines = _fitted(table, points, start, pairs, blocks, grounds, tolerance)
    laws = table.columns.get("joint", [""] * len(table))
    return PrescribedInterfaces(
        np.array(pairs), np.array(normals), np.concatenate(outlines), start, tuple(laws[row] for row in first)
    )


def _fitted(
    table: Table,
    points: FloatArray,
    start: IntArray,
    pairs: list[tuple[int, int]],
    blocks: Blocks,
    grounds: tuple[Ground, ...],
    tolerance: float,
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Normal and outline of each interface; TableRefused where one does not fit its bodies, or overlaps another."""
    first = start[:-1]
    found = [
        _oriented(points[row:last], pair, blocks, grounds, tolerance)
        for row, last, pair in zip(first, start[1:], pairs, strict=True)
    ]
    faults = [
        f"{_called(table, row)} {wrong}" for row, wrong in zip(first, found, strict=True) if isinstance(wrong, str)
    ]
    fitting = [each for each in found if not isinstance(each, str)]
    normals, outlines = [normal for normal, _ in fitting], [outline for _, outline in fitting]
    if not faults:
        reach = tolerance * np.array([_size(pair, blocks) for pair in pairs])
        faults = [
            f"{_called(table, first[other])} overlaps interface {table.columns['interface'][first[one]]} between the "
            "same bodies"
            for one, other in overlapping(pairs, normals, outlines, reach)
        ]
    if faults:
        raise TableRefused(*(Message("interface-misfit", fault) for fault in faults))
    return normals, outlines


def _starts(table: Table, bodies: IntArray, joints: Collection[str]) -> IntArray:
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


def _called(table: Table, row: int) -> str:
    """``contacts.csv:7: interface bed``."""
    return f"{table.file}:{table.lines[row]}: interface {table.columns['interface'][row]}"


def _ground_first(bodies: Sequence[int], n_blocks: int) -> tuple[int, int]:
    """A pair of bodies as body a and body b: a ground plane is body a, else the block of lower number."""
    a, b = sorted(bodies, key=lambda body: (body < n_blocks, body))
    return a, b


def _size(bodies: tuple[int, int], blocks: Blocks) -> float:
    """Size of the smaller block of a pair; grounds have none."""
    return min(float(blocks.sizes[body]) for body in bodies if body < len(blocks))


def _bodies(table: Table, row: int, members: dict[str, IntArray], n_blocks: int, n_grounds: int) -> tuple[int, int]:
    """Both bodies of a row; -1 where there is a fault."""
    found: list[int | None] = []
    for side in "ab":
        group = table.columns[f"group_{side}"][row]
        known = np.arange(n_blocks, n_blocks + n_grounds) if group == GROUND else members.get(group)
        if known is None:
            table.refuse(row, f"unknown group {group}{did_you_mean(group, members)}")
            continue
        there = f"has 0 to {len(known) - 1}" if len(known) else "has none: give ground under supports"
        found.append(table.place_in(f"index_{side}", row, known, f"{group} {there}"))
    match found:
        case [int(a), int(b)]:
            if a == b or min(a, b) >= n_blocks:
                table.refuse(row, "an interface is between two blocks, or a block and ground")
            return a, b
    return -1, -1


def _oriented(
    points: FloatArray, bodies: tuple[int, int], blocks: Blocks, grounds: tuple[Ground, ...], tolerance: float
) -> tuple[FloatArray, FloatArray] | str:
    """Normal from a to b and outline counter-clockwise about it; or what is wrong with them."""
    if len(points) < 3:
        return f"has {len(points)} corners: at least three make an outline"
    arms = points - points.mean(axis=0)
    ahead = np.roll(arms, -1, axis=0)
    area_vector = 0.5 * np.cross(arms, ahead).sum(axis=0)
    area = float(np.linalg.norm(area_vector))
    if area <= FLAT * np.linalg.norm(ahead - arms, axis=1).sum() ** 2:
        return "has no area"
    normal = area_vector / area
    size = _size(bodies, blocks)
    departure = float(np.abs(arms @ normal).max())
    if departure > tolerance * size:
        return f"is not planar: corners leave its plane by {departure:.3g}"
    for turn in (1.0, -1.0):
        if all(
            _lies_on(points, sign * turn * normal, body, blocks, grounds, tolerance * size)
            for body, sign in zip(bodies, (1.0, -1.0), strict=True)
        ):
            return turn * normal, points if turn > 0 else points[::-1]
    return "does not lie on a face of both: its corners must, within contacts.tolerance"


def _lies_on(
    points: FloatArray, normal: FloatArray, body: int, blocks: Blocks, grounds: tuple[Ground, ...], reach: float
) -> bool:
    """Whether all corners lie on a ground, or within one facet of a block, that faces along the normal."""
    if body >= len(blocks):
        ground = grounds[body - len(blocks)]
        return bool(
            ground.normal @ normal > FACING and (np.abs((points - ground.point) @ ground.normal) <= reach).all()
        )
    import shapely

    faces = np.arange(blocks.face_start[body], blocks.face_start[body + 1])
    faces = faces[blocks.face_normals[faces] @ normal > FACING]
    frame = plane_axes(normal[None])[0].T
    places = shapely.points(points @ frame)
    facets = blocks.facet_of_face[faces]
    covered = np.zeros((len(faces), len(points)), dtype=bool)
    for row, face in enumerate(faces):
        outline = blocks.vertices[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]]
        near = np.abs((points[:, None] - outline) @ normal).min(axis=1) <= reach
        covered[row] = near & shapely.dwithin(shapely.polygons(outline @ frame), places, reach)
    return any(covered[facets == facet].any(axis=0).all() for facet in np.unique(facets))


SAME_PLANE = 0.99
"""cosine of the angle between normals from which outlines may lie on each other, as that of faces of one facet"""


def overlapping(
    bodies: Sequence[tuple[int, int]], normals: Sequence[FloatArray], outlines: Sequence[FloatArray], reach: FloatArray
) -> Iterator[tuple[int, int]]:
    """Numbers of interfaces, the earlier one first, that share more than a strip as wide as ``reach`` along an edge.

    outlines : (n, 3) corners of each, counter-clockwise about its normal
    reach    : (n,) length below which a distance is rounding
    """
    of_pair: dict[tuple[int, int], list[int]] = {}
    for number, pair in enumerate(bodies):
        of_pair.setdefault(pair, []).append(number)
    for numbers in of_pair.values():
        for first, second in combinations(numbers, 2):
            normal = normals[first]
            if normal @ normals[second] < SAME_PLANE:
                continue
            away = (outlines[second] - outlines[first][0]) @ normal
            if np.abs(away).min() > reach[first]:
                continue  # steps of one bed
            if common_area(outlines[first], outlines[second], normal) > reach[first] * _half_perimeter(
                outlines[first], outlines[second]
            ):
                yield first, second


def common_area(outline: FloatArray, other: FloatArray, normal: FloatArray) -> float:
    """Area that two outlines (n, 3) have in common as seen along a unit normal, (3,)."""
    import shapely

    frame = plane_axes(normal[None])[0].T
    one, two = shapely.make_valid([shapely.Polygon(each @ frame) for each in (outline, other)])
    return float(shapely.intersection(one, two).area)


def _half_perimeter(*outlines: FloatArray) -> float:
    """Half the perimeter of the shortest outline: no edge of a convex one is longer."""
    return min(float(np.linalg.norm(np.roll(each, -1, axis=0) - each, axis=1).sum()) for each in outlines) / 2
