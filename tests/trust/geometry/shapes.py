"""What is done to stones before they are written: broken, or said in another way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from mbla.arrays import FloatArray
from tests.trust.geometry.formats import Format
from tests.trust.geometry.stones import Face, Stone, triangles

Generator = np.random.Generator
Change = Callable[[list[Stone], Generator], list[Stone]]


class Expect(Enum):
    """What must come of it.

    SAME    : it is taken, with the result of the file that is not broken
    REFUSED : it is refused, with a diagnosis
    EITHER  : one of these
    TOLD    : refused, or what differs is told in a warning
    """

    SAME = "same"
    REFUSED = "refused"
    EITHER = "either"
    TOLD = "told"


def anything(_: Format) -> bool:
    """Every format."""
    return True


def of_any_faces(kind: Format) -> bool:
    """Formats that hold whatever faces there are."""
    return kind.shapes


def of_polygons(kind: Format) -> bool:
    """Formats that hold whatever polygons there are."""
    return kind.shapes and kind.polygons


@dataclass(frozen=True)
class Mutation:
    """One thing that is done to stones.

    expect    : in files that keep stones apart; where all are one surface a refusal is right as well
    suits     : formats in which it can be written
    told      : identifiers of notices of which one must be given where the file is taken; none: nothing need be said
    tolerance : relative, of the result beside that of the file that is not broken
    scale     : of lengths, beside that file
    """

    name: str
    change: Change
    expect: Expect
    suits: Callable[[Format], bool] = of_any_faces
    told: frozenset[str] = frozenset()
    tolerance: float = 1e-6
    scale: float = 1.0


def _one(change: Callable[[Stone, Generator], Stone]) -> Change:
    """The same done to one stone of many."""

    def changed(stones: list[Stone], random: Generator) -> list[Stone]:
        row = int(random.integers(len(stones)))
        return [change(stone, random) if n == row else stone for n, stone in enumerate(stones)]

    return changed


def _all(change: Callable[[Stone, Generator], Stone]) -> Change:
    """The same done to every stone."""
    return lambda stones, random: [change(stone, random) for stone in stones]


def _face(stone: Stone, random: Generator) -> int:
    return int(random.integers(len(stone.faces)))


def _front(random: Generator) -> int:
    """A corner that an elevation shows, too."""
    return int(random.integers(4, 8))


# --- faces -----------------------------------------------------------------------------------------------------------


def hole(stone: Stone, random: Generator) -> Stone:
    return stone.with_face(_face(stone, random))


def hole_of_a_triangle(stone: Stone, random: Generator) -> Stone:
    split = replace(stone, faces=triangles(stone))
    return split.with_face(_face(split, random))


def two_holes(stone: Stone, random: Generator) -> Stone:
    return hole(hole(stone, random), random)


def no_faces(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=())


def one_face(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=(stone.faces[_face(stone, random)],))


def inside_out(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=tuple(face[::-1] for face in stone.faces))


def turned_at_random(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=tuple(face[::-1] if random.random() < 0.5 else face for face in stone.faces))


def face_again(stone: Stone, random: Generator) -> Stone:
    row = _face(stone, random)
    return replace(stone, faces=(*stone.faces, stone.faces[row]))


def faces_again(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=stone.faces * 2)


def both_sides(stone: Stone, random: Generator) -> Stone:
    return replace(stone, faces=stone.faces + tuple(face[::-1] for face in stone.faces))


def fin(stone: Stone, random: Generator) -> Stone:
    """A third face at an edge, into the open."""
    a, b = stone.faces[_face(stone, random)][:2]
    tip = 2 * stone.corners[a] - stone.corners.mean(axis=0)
    return replace(
        stone, corners=np.concatenate([stone.corners, [tip]]), faces=(*stone.faces, (a, b, len(stone.corners)))
    )


def wall_within(stone: Stone, random: Generator) -> Stone:
    """A face through the middle, at four of the edges' ends."""
    return replace(stone, faces=(*stone.faces, (0, 1, 6, 7)))


def flat_face(stone: Stone, random: Generator) -> Stone:
    """A triangle of no width between an edge and the middle of it, which one of the faces has as a corner."""
    row = _face(stone, random)
    face = stone.faces[row]
    middle = len(stone.corners)
    corners = np.concatenate([stone.corners, [(stone.corners[face[0]] + stone.corners[face[1]]) / 2]])
    split: Face = (face[0], middle, *face[1:])
    return replace(stone, corners=corners).with_face(row, split, (face[0], face[1], middle))


def t_junction(stone: Stone, random: Generator) -> Stone:
    """The middle of an edge is a corner of one of its faces alone."""
    row = _face(stone, random)
    face = stone.faces[row]
    corners = np.concatenate([stone.corners, [(stone.corners[face[0]] + stone.corners[face[1]]) / 2]])
    return replace(stone, corners=corners).with_face(row, (face[0], len(stone.corners), *face[1:]))


def _loop(change: Callable[[Face], Face]) -> Callable[[Stone, Generator], Stone]:
    """Other corners, or another order of them, in a face."""

    def changed(stone: Stone, random: Generator) -> Stone:
        row = _face(stone, random)
        return stone.with_face(row, change(stone.faces[row]))

    return changed


def _first_corner(number: int) -> Callable[[Stone, Generator], Stone]:
    """Another number for the first corner of a face."""
    return _loop(lambda face: (number, *face[1:]))


# --- corners ---------------------------------------------------------------------------------------------------------


def _coordinate(value: float) -> Callable[[Stone, Generator], Stone]:
    def changed(stone: Stone, random: Generator) -> Stone:
        row, axis = _front(random), int(random.choice([0, 2]))
        return stone.with_corner(row, [value if n == axis else x for n, x in enumerate(stone.corners[row])])

    return changed


def own_corners(stone: Stone, random: Generator) -> Stone:
    """Every face with corners of its own."""
    corners = np.concatenate([stone.corners[list(face)] for face in stone.faces])
    ends = np.cumsum([0, *(len(face) for face in stone.faces)])
    faces = tuple(tuple(range(a, b)) for a, b in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))
    return replace(stone, corners=corners, faces=faces)


def rough(stone: Stone, random: Generator) -> Stone:
    """Every face with corners of its own, which miss each other a little."""
    own = own_corners(stone, random)
    return own.with_corners(own.corners + random.uniform(-1e-7, 1e-7, own.corners.shape))


def idle_corner(stone: Stone, random: Generator) -> Stone:
    """A corner that no face has, far away."""
    return replace(stone, corners=np.concatenate([stone.corners, [[1e3, 2e3, 3e3]]]))


def idle_nan(stone: Stone, random: Generator) -> Stone:
    """A corner that no face has, and that is no place."""
    return replace(stone, corners=np.concatenate([stone.corners, [[np.nan] * 3]]))


def renumbered(stone: Stone, random: Generator) -> Stone:
    """Corners and faces in another order, each face from another corner on."""
    order = random.permutation(len(stone.corners))
    place = np.argsort(order)
    faces = []
    for row in random.permutation(len(stone.faces)):
        face = stone.faces[row]
        turn = int(random.integers(len(face)))
        faces.append(tuple(int(place[corner]) for corner in face[turn:] + face[:turn]))
    return Stone(stone.name, stone.corners[order], tuple(faces))


def split_faces(stone: Stone, random: Generator) -> Stone:
    other = renumbered(stone, random)
    return replace(other, faces=triangles(other))


def bent(stone: Stone, random: Generator) -> Stone:
    """A corner that is off its faces' planes by some centimetres."""
    row = _front(random)
    return stone.with_corner(row, stone.corners[row] + [0.0, 0.07, 0.0])


def _corners(change: Callable[[FloatArray], FloatArray]) -> Callable[[Stone, Generator], Stone]:
    """Every corner elsewhere."""
    return lambda stone, random: stone.with_corners(change(stone.corners))


def pulled_through(stone: Stone, random: Generator) -> Stone:
    """A corner pulled through the stone and out at the other side; faces are triangles, so all of them are planar."""
    split_stone = replace(stone, faces=triangles(stone))
    row = _front(random)
    middle = stone.corners.mean(axis=0)
    return split_stone.with_corner(row, stone.corners[row] + 3.5 * (middle - stone.corners[row]))


def crossed_outline(stone: Stone, random: Generator) -> Stone:
    """Two neighbouring corners exchanged at both ends: sides cross."""
    corners = stone.corners.copy()
    corners[[5, 6, 1, 2]] = corners[[6, 5, 2, 1]]
    return stone.with_corners(corners)


def hollow(stone: Stone, random: Generator) -> Stone:
    """Another surface inside."""
    middle = stone.corners.mean(axis=0)
    inner = tuple(tuple(corner + len(stone.corners) for corner in face[::-1]) for face in stone.faces)
    return replace(
        stone,
        corners=np.concatenate([stone.corners, middle + 0.5 * (stone.corners - middle)]),
        faces=stone.faces + inner,
    )


def one_sided(stone: Stone, random: Generator) -> Stone:
    """A Moebius band of five triangles, closed by nothing."""
    at = np.array([[np.cos(t), np.sin(t), 1 + 0.2 * t] for t in range(5)])
    return replace(stone, corners=at, faces=tuple((n, (n + 1) % 5, (n + 2) % 5) for n in range(5)))


def projective(stone: Stone, random: Generator) -> Stone:
    """The projective plane of six corners: every edge has two faces, and it has one side."""
    faces: tuple[Face, ...] = ((0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1))
    faces += ((1, 2, 4), (2, 3, 5), (3, 4, 1), (4, 5, 2), (5, 1, 3))
    at = stone.corners.mean(axis=0) + 0.1 * random.normal(size=(6, 3))
    return replace(stone, corners=at, faces=faces)


def many_cornered(stone: Stone, random: Generator) -> Stone:
    """Two hundred more corners in line on every edge: faces of 804 corners."""
    corners, rows = [stone.corners], {}
    count = len(stone.corners)
    faces = []
    for face in stone.faces:
        loop: list[int] = []
        for tail, head in zip(face, face[1:] + face[:1], strict=True):
            low, high = min(tail, head), max(tail, head)
            if (low, high) not in rows:
                share = np.arange(1, 201)[:, None] / 201
                corners.append(stone.corners[low] + share * (stone.corners[high] - stone.corners[low]))
                rows[low, high] = list(range(count, count + 200))
                count += 200
            loop += [tail, *(rows[low, high] if tail < head else rows[low, high][::-1])]
        faces.append(tuple(loop))
    return replace(stone, corners=np.concatenate(corners), faces=tuple(faces))


# --- stones ----------------------------------------------------------------------------------------------------------


def shuffled(stones: list[Stone], random: Generator) -> list[Stone]:
    return [stones[row] for row in random.permutation(len(stones))]


def stone_again(stones: list[Stone], random: Generator) -> list[Stone]:
    stone = stones[int(random.integers(len(stones)))]
    return [*stones, replace(stone, name="once more")]


def pushed_into_the_next(stones: list[Stone], random: Generator) -> list[Stone]:
    row = int(random.integers(len(stones) - 1))
    step = 0.2 * (stones[row + 1].corners.mean(axis=0) - stones[row].corners.mean(axis=0))
    return [stone.with_corners(stone.corners + step) if n == row else stone for n, stone in enumerate(stones)]


def stone_within(stones: list[Stone], random: Generator) -> list[Stone]:
    stone = stones[int(random.integers(len(stones)))]
    middle = stone.corners.mean(axis=0)
    return [*stones, replace(stone.with_corners(middle + 0.5 * (stone.corners - middle)), name="within")]


def _scaled(factor: float) -> Change:
    return _all(lambda stone, random: stone.with_corners(stone.corners * factor))


def _moved(distance: float) -> Change:
    return _all(lambda stone, random: stone.with_corners(stone.corners + np.array([distance, 0, 0])))


SAME, REFUSED, EITHER, TOLD = Expect.SAME, Expect.REFUSED, Expect.EITHER, Expect.TOLD
MERGED = frozenset({"vertices-merged", "vertices-welded"})
TURNED = frozenset({"faces-turned-outwards"})
GONE = frozenset({"faces-collapsed", "vertices-merged"})
AGAIN = frozenset({"faces-repeated", "surfaces-repeated"})
SPLIT = frozenset({"bent-faces-split"})

FLAT = _corners(lambda corners: corners * [1, 0, 1] + [0, 0.5, 0])
THIN = _corners(lambda corners: corners * [1, 1e-17, 1])
LINE = _corners(lambda corners: corners[0] + np.linspace(0, 1, len(corners))[:, None] * [1, 0, 1])
POINT = _corners(lambda corners: np.repeat(corners[:1], len(corners), axis=0))

MUTATIONS = (
    Mutation("face missing", _one(hole), REFUSED),
    Mutation("triangle missing", _one(hole_of_a_triangle), REFUSED),
    Mutation("two faces missing", _one(two_holes), REFUSED),
    Mutation("one face only", _one(one_face), REFUSED, suits=lambda kind: kind.shapes and kind.apart),
    Mutation("face missing in every block", _all(hole), REFUSED),
    Mutation("face turned", _one(_loop(lambda face: face[::-1])), SAME, told=TURNED),
    Mutation("block inside out", _one(inside_out), SAME, told=TURNED),
    Mutation("everything inside out", _all(inside_out), SAME, told=TURNED),
    Mutation("faces turned at random", _all(turned_at_random), SAME, told=TURNED),
    Mutation("face listed twice", _one(face_again), SAME, told=AGAIN),
    Mutation("all faces listed twice", _one(faces_again), SAME, told=AGAIN),
    Mutation("both sides of all faces", _one(both_sides), SAME, suits=of_polygons, told=AGAIN),
    Mutation("third face at an edge", _one(fin), REFUSED),
    Mutation("face through the inside", _one(wall_within), REFUSED),
    Mutation("face without area", _one(flat_face), SAME, told=frozenset({"faces-flat", "t-junctions"})),
    Mutation("corner in the middle of an edge", _one(t_junction), SAME, told=frozenset({"t-junctions", "faces-flat"})),
    Mutation("corner named twice in a row", _one(_loop(lambda face: (face[0], *face))), EITHER),
    Mutation(
        "face comes back to a corner",
        _one(_loop(lambda face: (*face[:3], face[1], face[3]))),
        REFUSED,
        suits=of_polygons,
    ),
    Mutation(
        "corners of a face in wrong order", _one(_loop(lambda face: (face[0], face[2], face[1], face[3]))), REFUSED
    ),
    Mutation("face of two corners", _one(_loop(lambda face: face[:2])), REFUSED),
    Mutation(
        "corner that does not exist",
        _one(_first_corner(10**6)),
        REFUSED,
        suits=lambda kind: kind.shapes and kind.by_number,
    ),
    Mutation(
        "corner of an immense number",
        _one(_first_corner(10**30)),
        REFUSED,
        suits=lambda kind: kind.shapes and kind.by_number and not kind.binary,
    ),
    Mutation(
        "corner of a number below the first",  # in OBJ -1 has a meaning
        _one(_first_corner(-5000)),
        REFUSED,
        suits=lambda kind: kind.shapes and kind.by_number,
    ),
    Mutation(
        "corner of the number before the first",
        _one(_first_corner(-1)),
        REFUSED,
        suits=lambda kind: kind.shapes and kind.by_number and kind.name != "obj",
    ),
    Mutation("coordinate nan", _one(_coordinate(np.nan)), REFUSED, anything),
    Mutation("coordinate inf", _one(_coordinate(np.inf)), REFUSED, anything),
    Mutation("coordinate -inf", _one(_coordinate(-np.inf)), REFUSED, anything),
    Mutation("coordinate 1e308", _one(_coordinate(1e308)), REFUSED, anything),
    Mutation("coordinate -1e308", _one(_coordinate(-1e308)), REFUSED, anything),
    Mutation("coordinate 1e40", _one(_coordinate(1e40)), REFUSED, anything),
    Mutation("all coordinates times 3e307", _scaled(3e307), REFUSED, anything),
    Mutation("all coordinates times 1e300", _scaled(1e300), REFUSED, anything),
    Mutation("all coordinates times 1e-308", _scaled(1e-308), REFUSED, anything),
    Mutation("all coordinates times 1e-160", _scaled(1e-160), REFUSED, anything),
    *(
        Mutation(
            f"all coordinates times {factor:.0e}", _scaled(factor), EITHER, lambda kind: not kind.flat, scale=factor
        )
        for factor in (1e-100, 1e-60, 1e-20, 1e-6, 1e6, 1e20, 1e40, 1e60)
    ),
    Mutation("1e5 from the origin", _moved(1e5), SAME, lambda kind: not kind.single, tolerance=1e-5),
    Mutation(
        "1e9 from the origin",
        _moved(1e9),
        EITHER,
        lambda kind: not kind.single,
        told=frozenset({"coordinates-coarse"}),
        tolerance=1e-4,
    ),
    Mutation("1e16 from the origin", _moved(1e16), REFUSED, lambda kind: not kind.single),
    Mutation("1e200 from the origin", _moved(1e200), REFUSED, anything),
    Mutation("corners not shared", _one(own_corners), SAME),
    Mutation("no corners shared", _all(own_corners), SAME),
    Mutation("corners that miss each other", _one(rough), EITHER, told=MERGED, tolerance=1e-5),
    Mutation("corner that no face has", _one(idle_corner), SAME),
    Mutation("corner that no face has, not a number", _one(idle_nan), EITHER),
    Mutation("renumbered", _all(renumbered), SAME),
    Mutation("in triangles", _all(split_faces), SAME),
    Mutation("corner off the plane", _one(bent), TOLD, lambda kind: kind.polygons and not kind.flat, SPLIT),
    Mutation("block without thickness", _one(FLAT), REFUSED, lambda kind: not kind.flat),
    Mutation("block thinner than rounding", _one(THIN), REFUSED, lambda kind: not kind.flat),
    Mutation("block on a line", _one(LINE), REFUSED, lambda kind: kind.apart),
    Mutation("block at a point", _one(POINT), REFUSED, lambda kind: kind.apart),
    Mutation("part on a line", _one(LINE), TOLD, lambda kind: not kind.apart, frozenset({"faces-flat"})),
    Mutation("part at a point", _one(POINT), TOLD, lambda kind: not kind.apart, GONE),
    Mutation("block through itself", _one(pulled_through), REFUSED),
    Mutation("outline crosses itself", _one(crossed_outline), REFUSED, anything),
    Mutation("surface inside a block", _one(hollow), REFUSED),
    Mutation("band with one side", _one(one_sided), REFUSED),
    Mutation("closed surface with one side", _one(projective), REFUSED),
    Mutation("faces of 804 corners", _one(many_cornered), SAME, suits=of_polygons),
    Mutation("blocks in another order", shuffled, SAME, anything),
    Mutation("block twice", stone_again, EITHER, anything, told=AGAIN),
    Mutation("block pushed into the next", pushed_into_the_next, REFUSED, anything),
    Mutation("block within a block", stone_within, REFUSED, anything),
    Mutation(
        "block without faces",
        _one(no_faces),
        TOLD,
        suits=lambda kind: kind.shapes and kind.apart,
        told=frozenset({"objects-empty", "file-vertices-unused"}),
    ),
)
