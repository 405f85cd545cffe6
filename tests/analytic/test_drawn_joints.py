"""Structures with joints drawn as gaps, against the same with blocks drawn up to the middle of the joints."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.errors import DeckError
from mbla.model.model import Model
from tests.line import HEAD, factor_of, line_of

HEX = "[[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]"
Box = tuple[Sequence[float], Sequence[float]]


def corners(box: Box) -> FloatArray:
    (x, y, z), (X, Y, Z) = box
    return np.array([[x, y, z], [X, y, z], [X, Y, z], [x, Y, z], [x, y, Z], [X, y, Z], [X, Y, Z], [x, Y, Z]])


def deck(
    blocks: Sequence[FloatArray],
    contacts: str = "",
    turn: FloatArray | None = None,
    ground: str = "{z: 0}",
    push: Sequence[float] = (1, 0, 0),
) -> str:
    """Hexahedra on the ground, pushed along a direction."""
    turn = np.eye(3) if turn is None else turn
    items = [
        f"  - polyhedron: {{group: b, material: stone, vertices: {(each @ turn.T).tolist()}, faces: {HEX}}}"
        for each in blocks
    ]
    return (
        HEAD.replace("joint: dry", f"joint: dry{contacts}")
        + "joints: {dry: {friction: 0.6}}\nblocks:\n"
        + "\n".join(items)
        + f"\nsupports: [{{ground: {ground}}}]\nload_cases: {{x: {{live: [{{acceleration: {list(push)}}}]}}}}\n"
    )


def wall(joint: float, *, ends: float = 0.0, window: bool = False) -> list[FloatArray]:
    """Three courses of units 0.4 x 0.2 in running bond, each drawn smaller by half a joint on every side but the ends.

    ends : what is taken off free faces: the ends of the wall, its top, and the sides of its window
    """
    found, half = [], joint / 2
    for course, cuts in enumerate(((0, 0.4, 0.8, 1.2), (0, 0.2, 0.6, 1.0, 1.2), (0, 0.4, 0.8, 1.2))):
        for number, (left, right) in enumerate(itertools.pairwise(cuts)):
            if window and (course, number) in ((1, 2),):
                continue
            beside = window and course == 1
            x = (
                left + (ends if left == 0 or (beside and number == 3) else half),
                right - (ends if right == 1.2 or (beside and number == 1) else half),
            )
            z = 0.2 * course + half, 0.2 * (course + 1) - (ends if course == 2 else half)
            found.append(corners(((x[0], 0, z[0]), (x[1], 0.25, z[1]))))
    return found


def full(ends: float, *, window: bool = False) -> list[FloatArray]:
    """The same wall with units that touch, and stand on the ground."""
    return wall(0.0, ends=ends, window=window)


THICKNESS = ', joint_thickness: "10 mm"'


def volume(model: Model) -> float:
    return float(model.blocks.volumes.sum())


@pytest.mark.parametrize("window", [False, True], ids=["whole", "with an opening"])
def test_a_wall_with_mortar_joints_is_the_wall_of_full_units(window: bool) -> None:
    drawn, touching = deck(wall(0.01, ends=0.005, window=window), THICKNESS), deck(full(0.005, window=window))
    one, other = line_of(drawn), line_of(touching)
    assert len(one.contacts) == len(other.contacts)
    assert one.contacts.bodies.tolist() == other.contacts.bodies.tolist()
    assert one.contacts.areas == pytest.approx(other.contacts.areas, rel=1e-9)
    assert one.contacts.centroids == pytest.approx(other.contacts.centroids, abs=1e-12)
    assert volume(one.model) == pytest.approx(volume(other.model), rel=1e-12)
    assert factor_of(drawn) == pytest.approx(factor_of(touching), rel=1e-9)
    notice = next(notice.message for notice in one.model.notices if notice.identifier == "joints-closed")
    before = sum(float(np.prod(np.ptp(each, axis=0))) for each in wall(0.01, ends=0.005, window=window))
    grown = volume(one.model) - before
    assert f"grow by {grown:.3g} m3 in all, {100 * grown / before:.2g} % of the volume" in notice


def rotation() -> FloatArray:
    """Some rotation in space."""
    rng = np.random.default_rng(2)
    found = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return np.asarray(found * np.sign(np.linalg.det(found)))


def test_neither_position_nor_order_nor_unit_changes_what_is_closed() -> None:
    plain = line_of(deck(wall(0.01, ends=0.005), THICKNESS))
    for turn, scale, order in ((rotation(), 1.0, 1), (np.eye(3), 1000.0, -1), (-np.eye(3), 1e-3, -1)):
        normal = (turn @ [0, 0, 1]).tolist()
        text = deck(
            wall(0.01, ends=0.005)[::order],
            f", joint_thickness: {0.01 * scale}",
            scale * turn,
            f"{{point: [0, 0, 0], normal: {normal}}}",
        )
        found = line_of(text)
        assert volume(found.model) == pytest.approx(scale**3 * volume(plain.model), rel=1e-9)
        assert len(found.contacts) == len(plain.contacts)
        assert found.contacts.areas.sum() == pytest.approx(scale**2 * plain.contacts.areas.sum(), rel=1e-9)


def arch(n: int, lost: float, *, wedge: bool) -> list[FloatArray]:
    """Voussoirs of a semicircular arch, radii 2 and 2.3, each of which loses something on its radial sides.

    lost : m, the same all along (mortar of one thickness), or at the extrados (a wedge: an angle)
    """
    found = []
    for number in range(n):
        angles = np.pi * (1 - np.array([number, number + 1]) / n)
        along, across = (
            np.column_stack(each) for each in ((np.cos(angles), np.sin(angles)), (np.sin(angles), -np.cos(angles)))
        )
        edges: list[list[FloatArray]] = [[], []]
        for radius in (2.0, 2.3):
            ends, loss = radius * along, lost * (radius / 2.3 if wedge else 1.0)
            chord = ends[1] - ends[0]
            for side, sign in ((0, 1.0), (1, -1.0)):
                stands = number + side in (0, n)  # springers stand on the ground
                edges[side].append(ends[side] + (0.0 if stands else sign * loss / (chord @ across[side])) * chord)
        ring = [[p[0], y, p[1]] for y in (0.0, 0.5) for p in (*edges[0], *edges[1][::-1])]
        found.append(np.array(ring))
    return found


@pytest.mark.parametrize("wedge", [False, True], ids=["of one thickness", "wedges"])
def test_an_arch_with_mortar_in_its_radial_joints(wedge: bool) -> None:
    drawn = deck(arch(11, 0.005, wedge=wedge), THICKNESS)
    touching = deck(arch(11, 0.0, wedge=wedge))
    one, other = line_of(drawn), line_of(touching)
    assert len(one.contacts) == len(other.contacts) == 12
    assert volume(one.model) == pytest.approx(volume(other.model), rel=1e-9)
    assert one.contacts.areas == pytest.approx(other.contacts.areas, rel=1e-9)
    assert factor_of(drawn) == pytest.approx(factor_of(touching), rel=1e-6)


def test_a_block_beside_joints_of_two_widths_takes_the_plane_between_all_of_them() -> None:
    """Two stones at 6 and 10 mm over a sill: the joint is one plane, 3 mm over the sill."""
    boxes: list[Box] = [((0, 0, 0), (1, 1, 0.5)), ((0, 0, 0.506), (0.45, 1, 1)), ((0.55, 0, 0.51), (1, 1, 1))]
    line = line_of(deck([corners(box) for box in boxes], THICKNESS))
    between = line.contacts.bodies[:, 0] < 3
    assert line.contacts.centroids[between, 2] == pytest.approx([0.503, 0.503])


def test_a_joint_that_is_closed_somewhere_stays_there() -> None:
    boxes: list[Box] = [((0, 0, 0), (1, 1, 0.5)), ((0, 0, 0.5), (0.45, 1, 1)), ((0.55, 0, 0.51), (1, 1, 1))]
    line = line_of(deck([corners(box) for box in boxes], THICKNESS))
    assert line.contacts.centroids[line.contacts.bodies[:, 0] < 3, 2] == pytest.approx([0.5, 0.5])


def test_wider_gaps_stay_open() -> None:
    boxes: list[Box] = [((0, 0, 0), (1, 1, 1)), ((1.011, 0, 0), (2, 1, 1)), ((2.009, 0, 0), (3, 1, 1))]
    line = line_of(deck([corners(box) for box in boxes], THICKNESS))
    assert line.contacts.bodies[line.contacts.bodies[:, 0] < 3].tolist() == [[1, 2]]


@pytest.mark.parametrize(
    ("boxes", "words"),
    [
        (
            [((0, 0, 0), (1, 1, 1)), ((0, 0, 1.002), (1, 1, 1.006)), ((0, 0, 1.008), (1, 1, 2))],
            "would swallow a block",
        ),
        (
            [
                ((0, 0, 0), (1, 1, 1)), ((0.6, 0, 1.009), (1.6, 1, 2)), ((1.2, 0, 0), (2.2, 1, 1.0085)),
                ((2, 0, 1.0105), (3, 1, 2)), ((2.6, 0, 0), (3.6, 1, 1.01)), ((3, 0, 1.0102), (4, 1, 2)),
                ((-1, 0, 1.0001), (0.3, 1, 2)),
            ],
            "goes up or down in steps",
        ),
    ],
    ids=["a thin plate", "steps"],
)  # fmt: skip
def test_what_cannot_be_closed_is_refused(boxes: list[Box], words: str) -> None:
    with pytest.raises(DeckError, match=f"contacts.joint_thickness = .*{words}"):
        line_of(deck([corners(box) for box in boxes], THICKNESS))


def test_bricks_that_touch_along_one_edge_of_their_joint() -> None:
    """An arch of rectangular bricks: each joint is a wedge of mortar, closed by the plane that bisects it."""
    n, angle = 9, np.radians(4.0)
    half, depth = 0.5, 0.1
    reach = half / np.tan(angle / 2)  # of the centre from the lower faces, which meet at their edges
    found = []
    for number in range(n):
        turn = (number - (n - 1) / 2) * angle
        radial, along = np.array([np.sin(turn), np.cos(turn)]), np.array([np.cos(turn), -np.sin(turn)])
        flat = [
            r * radial + s * half * along for r, s in ((reach, -1), (reach, 1), (reach + depth, 1), (reach + depth, -1))
        ]
        found.append(np.array([[p[0], y, p[1]] for y in (0.0, 0.5) for p in flat]))
    ends = ", ".join(f"{{blocks: {{group: b, index: {number}}}}}" for number in (0, n - 1))
    text = deck(found, ", joint_thickness: 0.01").replace("{ground: {z: 0}}", ends)
    line = line_of(text)
    assert len(line.contacts) == n - 1
    # each joint is longer than the brick is deep, for its plane leans by half the angle
    assert line.contacts.areas == pytest.approx(0.5 * depth / np.cos(angle / 2), rel=1e-9)


def test_blocks_that_are_not_convex_grow_as_well() -> None:
    """An L around a box, 8 mm away from both of its legs."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    sides = [[k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
    item = (
        f"  - polyhedron: {{group: l, material: stone, vertices: {vertices}, "
        f"faces: {[[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11], *sides]}}}\nsupports:"
    )
    line = line_of(deck([corners(((1.008, 1.008, 0), (2, 2, 1)))], THICKNESS).replace("supports:", item))
    assert line.model.blocks.volumes == pytest.approx([0.996**2, 4 - 0.996**2], rel=1e-12)
    assert volume(line.model) == pytest.approx(4.0, rel=1e-12)
    between = line.contacts.bodies[:, 0] < 2
    assert line.contacts.areas[between] == pytest.approx([0.996, 0.996])
