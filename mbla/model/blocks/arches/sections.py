"""Sections of arches and barrels in their plane: joints across a curve, voussoirs between them, springings and piers.

Along a joint the boundaries of the rings lie at offsets from the curve. Voussoirs are straight-edged: a quadrilateral
between two joints, or around the apex of a pointed arch a hexagon with an inner and an outer apex of its own. Piers
stand in courses, and springer blocks give an inclined springing joint a level bed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding
from mbla.model.blocks.curves import Curve
from mbla.model.blocks.generated import GroundPart, ItemRefused
from mbla.model.solids.polyhedra import Polyhedra, in_space, prisms


@dataclass(frozen=True)
class ArchSection:
    """An arch in its plane.

    joints   : (n + 1, rings + 1, 2) corners along each joint from left to right, from intrados to extrados
    forwards : (n + 1, 2) direction of travel, at right angles to the joints
    apex     : (rings + 1, 2) corners on the axis of a keystone around an apex; None where there is none
    """

    joints: FloatArray
    forwards: FloatArray
    apex: FloatArray | None

    @property
    def n_voussoirs(self) -> int:
        """Of each ring."""
        return len(self.joints) - 1

    @property
    def rings(self) -> int:
        """Number of rings."""
        return int(self.joints.shape[1]) - 1

    def line(self, boundary: int) -> FloatArray:
        """Corners along a boundary of rings from left to right, (n, 2): 0 the intrados, -1 the extrados."""
        corners = self.joints[:, boundary]
        if self.apex is None:
            return corners
        half = len(corners) // 2
        return np.concatenate([corners[:half], self.apex[None, boundary], corners[half:]])


def build_section(
    curve: Curve, voussoirs: int, rings: int, crown: float, springing: float, inside: float = 0.0
) -> ArchSection:
    """Section over a curve; thickness at crown and springings [length], and the share of it inside the curve [-].

    Raises ItemRefused where the voussoirs are too few to be blocks, or joints cross each other within the thickness.
    """
    _check_count(curve, voussoirs)
    parameters = curve.divide(voussoirs, (0.5 - inside) * (crown + springing) / 2)
    lengths = curve.lengths(parameters)
    here = crown + (springing - crown) * np.abs(2 * lengths / lengths[-1] - 1)  # grows evenly from the middle
    shares = np.linspace(0.0, 1.0, rings + 1) - inside
    joints = curve.points(parameters, here[:, None] * shares)
    apex = None
    if curve.crest is not None and voussoirs % 2:
        apex = curve.points(np.array([curve.crest]), crown * shares[None])[0]
    section = ArchSection(joints, curve.forwards(parameters), apex)
    _check_joints(section)
    return section


def voussoir_polygons(section: ArchSection) -> tuple[list[FloatArray], IntArray, IntArray]:
    """Polygons (k, 2) counter-clockwise, with position and ring of each, (n,), ring by ring from the inside."""
    polygons = []
    for ring in range(section.rings):
        inner, outer = section.joints[:, ring], section.joints[:, ring + 1]
        quadrilaterals = np.stack([inner[:-1], inner[1:], outer[1:], outer[:-1]], axis=1)
        row: list[FloatArray] = list(quadrilaterals)
        if section.apex is not None:
            middle = section.n_voussoirs // 2
            a, b, c, d = quadrilaterals[middle]
            row[middle] = np.stack([a, section.apex[ring], b, c, section.apex[ring + 1], d])
        polygons += row
    number, ring_of = np.arange(section.n_voussoirs), np.arange(section.rings)
    return polygons, np.tile(number, section.rings), np.repeat(ring_of, section.n_voussoirs)


def _check_count(curve: Curve, voussoirs: int) -> None:
    forwards = curve.forwards(curve.divide(8, 0.0))
    across = forwards[:-1, 1] * forwards[1:, 0] - forwards[:-1, 0] * forwards[1:, 1]
    turned = np.degrees(np.arctan2(across, (forwards[:-1] * forwards[1:]).sum(axis=1)).sum())
    if not np.isfinite(turned):
        return  # coordinates beyond what a double holds: refused block by block
    least = int((turned + 1e-9) // 180) + 1  # a semicircle up to rounding is one
    if voussoirs < least:
        message = f"too few: at least {least}, so that each spans less than 180 degrees"
        raise ItemRefused(Finding("arch-shape", message, "voussoirs"))


def _check_joints(section: ArchSection) -> None:
    """Along every boundary of rings the way from joint to joint leads forwards."""
    for boundary in range(section.rings + 1):
        line, forwards = section.line(boundary), section.forwards
        if section.apex is not None:
            half = len(forwards) // 2
            forwards = np.concatenate([forwards[:half], [[1.0, 0.0]], forwards[half:]])
        steps = np.diff(line, axis=0)
        back = (((steps * forwards[:-1]).sum(axis=1) < 0) | ((steps * forwards[1:]).sum(axis=1) < 0)).nonzero()[0]
        if len(back):
            number = min(int(back[0]), section.n_voussoirs - 1)
            message = (
                f"too many for this curve and thickness: the joints of voussoir {number} cross within the arch; "
                "use fewer voussoirs, a thinner arch, or a curve that turns less sharply there"
            )
            raise ItemRefused(Finding("arch-shape", message, "voussoirs"))


def springer_polygons(section: ArchSection, length: float) -> list[FloatArray]:
    """Quadrilaterals (4, 2) straight back from both springing joints, counter-clockwise; length [length]."""
    quadrilaterals = []
    for joint, forwards, towards in ((0, section.forwards[0], -1.0), (-1, section.forwards[-1], 1.0)):
        intrados, extrados = section.joints[joint, 0], section.joints[joint, -1]
        back = towards * length * forwards
        corners = np.stack([intrados, extrados, extrados + back, intrados + back])
        first, second = corners[1] - corners[0], corners[2] - corners[1]
        quadrilaterals.append(corners if first[0] * second[1] - first[1] * second[0] > 0 else corners[::-1])
    return quadrilaterals


def springing_grounds(
    section: ArchSection, number: IntArray, joint: str | None, shear: float = 0.0
) -> tuple[GroundPart, GroundPart]:
    """Planes under the blocks of the first and of the last course, whose numbers are ``number``, (n_blocks,)."""
    left, right = (
        GroundPart(
            in_space(section.joints[row, 0]),
            _plane(towards * section.forwards[row], shear),
            np.flatnonzero(number == last),
            joint,
        )
        for row, last, towards in ((0, 0, 1.0), (-1, section.n_voussoirs - 1, -1.0))
    )
    return left, right


def _plane(forwards: FloatArray, shear: float) -> FloatArray:
    """Unit normal of the plane through a joint: at right angles to it, and to the sheared width (shear, 1, 0)."""
    normal = np.array([forwards[0], -shear * forwards[0], forwards[1]])
    return np.asarray(normal / np.linalg.norm(normal) if shear else normal, dtype=np.float64)


LEVEL = 1e-9
"""rise of a springing joint, relative to its length, that is rounding of a level one"""
LEAST_RISE = 0.02
"""rise of an inclined springing joint, relative to its length: a springer block under a flatter one is a sliver, which
the tolerance of contacts sees through"""


@dataclass(frozen=True)
class SpringingJoint:
    """Springing joint of an arch: its corners at intrados and extrados, (2,) each; side -1 left, +1 right."""

    intrados: FloatArray
    extrados: FloatArray
    side: int

    @property
    def reach(self) -> float:
        """Horizontal extent outwards [length]."""
        return float((self.extrados[0] - self.intrados[0]) * self.side)

    @property
    def rise(self) -> float:
        """Height of the extrados over the intrados, relative to its length [-]; exactly zero where level."""
        rise = float((self.extrados[1] - self.intrados[1]) / np.linalg.norm(self.extrados - self.intrados))
        return 0.0 if abs(rise) <= LEVEL else rise


def springing_joints(section: ArchSection) -> tuple[SpringingJoint, SpringingJoint]:
    """Of the left and of the right springing."""
    first, last = section.joints[0], section.joints[-1]
    return SpringingJoint(first[0], first[-1], -1), SpringingJoint(last[0], last[-1], 1)


def check_rise(joint: SpringingJoint, *path: str | int) -> None:
    """Raises ItemRefused for the inclination of a joint that a pier cannot carry; key path below the item."""
    if joint.rise < 0:
        words = "a pier needs a springing joint that is level or rises outwards: at most half a circle"
        raise ItemRefused(Finding("arch-shape", words, *path))
    if 0 < joint.rise < LEAST_RISE:
        words = "the springing joint is almost level, its springer block a sliver: make it level, or incline it more"
        raise ItemRefused(Finding("arch-shape", words, *path))


def check_width(width: float, joints: Iterable[SpringingJoint], key: str) -> Iterator[Finding]:
    """What stands under springing joints is as wide as they reach."""
    least = max(joint.reach for joint in joints)
    if width < least * (1 - LEVEL):
        yield Finding("out-of-bounds", f"must be >= {least:g}, the extent of the springing joint", key, "width")


def stacks(places: Sequence[tuple[float, float, float]], height: float, count: int) -> list[FloatArray]:
    """Rectangles (4, 2) of equal height, course by course from the bottom; places: left, right and top of each pier."""
    levels = [np.linspace(top - height, top, count + 1) for _, _, top in places]
    return [
        np.array([[left, at[course]], [right, at[course]], [right, at[course + 1]], [left, at[course + 1]]])
        for course in range(count)
        for (left, right, _), at in zip(places, levels, strict=True)
    ]


def end_springer(joint: SpringingJoint, width: float) -> FloatArray | None:
    """Block (k, 2) between a springing joint and the pier under it, over its width; None where the joint is level."""
    if not joint.rise:
        return None
    far, top = joint.intrados[0] + joint.side * width, joint.extrados[1]
    beyond = [] if abs(width - joint.reach) <= LEVEL * width else [[far, top]]
    polygon = np.array([joint.intrados, joint.extrados, *beyond, [far, joint.intrados[1]]])
    return polygon if joint.side < 0 else polygon[::-1]


def ends_of(joints: FloatArray) -> FloatArray:
    """Both ends of each unit between joints (n + 1,), (n, 2)."""
    return np.stack([joints[:-1], joints[1:]], axis=1)


def units_across(
    polygons: Sequence[FloatArray], ends: Sequence[FloatArray], shear: float = 0.0
) -> tuple[Polyhedra, IntArray, IntArray]:
    """Prisms of each polygon between ends along y, (n, 2) each: all of them, the polygon of each, its number across."""
    polygon = np.repeat(np.arange(len(polygons)), [len(each) for each in ends])
    made = prisms([polygons[row] for row in polygon.tolist()], np.concatenate(ends), shear)
    return made, polygon, np.concatenate([np.arange(len(each)) for each in ends])


def through(polygons: Sequence[FloatArray], across: Sequence[float], shear: float = 0.0) -> Polyhedra:
    """Prisms of polygons between two places along y, the same for all."""
    return prisms(polygons, np.tile(across, (len(polygons), 1)), shear)
