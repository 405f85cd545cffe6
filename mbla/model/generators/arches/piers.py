"""Piers in courses, and the springer blocks that give an inclined springing joint a level bed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.arches.section import Section

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
        """Height of the extrados over the intrados [length]; exactly zero where level."""
        rise = float(self.extrados[1] - self.intrados[1])
        return 0.0 if abs(rise) <= LEVEL * float(np.linalg.norm(self.extrados - self.intrados)) else rise


def unfit_rise(joint: SpringingJoint) -> str | None:
    """What is wrong with the inclination of a joint that a pier shall carry; None where nothing is."""
    if joint.rise < 0:
        return "a pier needs a springing joint that is level or rises outwards: at most half a circle"
    if 0 < joint.rise < LEAST_RISE * float(np.linalg.norm(joint.extrados - joint.intrados)):
        return "the springing joint is almost level, its springer block a sliver: make it level, or incline it more"
    return None


def springing_joints(section: Section) -> tuple[SpringingJoint, SpringingJoint]:
    """Of the left and of the right springing."""
    first, last = section.joints[0], section.joints[-1]
    return SpringingJoint(first[0], first[-1], -1), SpringingJoint(last[0], last[-1], 1)


def rectangle(left: float, right: float, bottom: float, top: float) -> FloatArray:
    """Polygon counter-clockwise, (4, 2)."""
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])


def courses(left: float, right: float, bottom: float, top: float, count: int) -> list[FloatArray]:
    """Rectangles of equal height on top of each other."""
    levels = np.linspace(bottom, top, count + 1)
    return [rectangle(left, right, levels[i], levels[i + 1]) for i in range(count)]


def end_springer(joint: SpringingJoint, width: float) -> FloatArray | None:
    """Block between a springing joint and the pier under it, over its whole width; None where the joint is level."""
    if not joint.rise:
        return None
    far = joint.intrados[0] + joint.side * width
    top = joint.extrados[1]
    corners = [joint.intrados, joint.extrados, [far, top], [far, joint.intrados[1]]]
    if abs(width - joint.reach) <= LEVEL * width:
        corners = [joint.intrados, joint.extrados, [far, joint.intrados[1]]]
    polygon = np.array(corners)
    return polygon if joint.side < 0 else polygon[::-1]
