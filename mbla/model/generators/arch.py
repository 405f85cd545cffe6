"""Generator of circular arches with radial joints and straight-edged voussoirs.

With r the intrados radius and a half the angle of embrace, both springings of the intrados lie at z = 0, a span
s = 2 r sin a apart, and the centre at x = s/2, z = -r cos a (above the springings for an embrace beyond 180 degrees).
A point at radius R and angle t from the crown is x = s/2 + R sin t, z = -r cos a + R cos t, with t from -a to a.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.types import ArchItem
from mbla.model.generators.generator import Generated, GroundPart, ItemRefused, Part, Site
from mbla.model.polyhedra import HEXAHEDRON, Polyhedra, polyhedra_from_cells


@dataclass(frozen=True)
class _Circle:
    """Intrados circle: radius [length], half angle of embrace [rad], centre (x, z) [length]."""

    radius: float
    half_angle: float
    centre: FloatArray


def generate_arch(item: ArchItem, site: Site) -> Generated:
    """Voussoirs from left to right; with them the ground or the fixed blocks behind the springing joints.

    Raises
    ------
    ItemRefused
        where the voussoirs are too few to be blocks
    """
    circle = _circle(item)
    least = int(np.degrees(2 * circle.half_angle) // 180) + 1
    if item.voussoirs < least:
        message = f"too few: at least {least}, so that each spans less than 180 degrees"
        raise ItemRefused([(("voussoirs",), message)])
    angles = np.linspace(-circle.half_angle, circle.half_angle, item.voussoirs + 1)
    rays = np.stack([np.sin(angles), np.cos(angles)], axis=1)
    intrados = circle.centre + circle.radius * rays
    extrados = circle.centre + (circle.radius + item.thickness) * rays
    intrados[[0, -1]] = [[0.0, 0.0], [item.span, 0.0]]
    section = np.stack([intrados[:-1], intrados[1:], extrados[1:], extrados[:-1]], axis=1)
    voussoirs = Part(_prisms(section, item.width))
    # direction of travel along the arch at both springings
    forwards = np.array([[np.cos(circle.half_angle), np.sin(circle.half_angle)]] * 2) * [[1, 1], [1, -1]]
    if item.springers == "blocks":
        left = _behind(intrados[0], extrados[0], -item.thickness * forwards[0])
        right = _behind(intrados[-1], extrados[-1], item.thickness * forwards[1])
        return Generated((voussoirs, Part(_prisms(np.stack([left, right]), item.width), "_springers", fixed=True)))
    if item.springers == "ground":
        return Generated(
            (voussoirs,),
            (
                GroundPart(_in_space(intrados[0]), _in_space(forwards[0]), 0, item.joint),
                GroundPart(_in_space(intrados[-1]), -_in_space(forwards[1]), item.voussoirs - 1, item.joint),
            ),
        )
    return Generated((voussoirs,))


def _circle(item: ArchItem) -> _Circle:
    if item.shape == "semicircular":
        half_angle = np.pi / 2
    elif item.rise is not None:
        # half the rise over half the span is the tangent of half the half angle
        half_angle = 2 * np.arctan2(item.rise, item.span / 2)
    else:
        assert item.embrace is not None  # a rule of the deck: one of rise and embrace
        half_angle = np.radians(item.embrace) / 2
    radius = item.span / (2 * np.sin(half_angle))
    centre = np.array([item.span / 2, -radius * np.cos(half_angle)])
    return _Circle(float(radius), float(half_angle), centre)


def _prisms(section: FloatArray, width: float) -> Polyhedra:
    """Prisms from quadrilaterals in the x-z plane, (n, 4, 2), between y = 0 and y = width.

    Corners counter-clockwise as seen in the x-z plane (x to the right, z up), which is from -y.
    """
    near = _in_space(section)
    far = near + np.array([0.0, width, 0.0])
    # seen from the far side the order is clockwise, so that the near face is the upper one of the template
    return polyhedra_from_cells(np.concatenate([far, near], axis=1), HEXAHEDRON)


def _behind(intrados: FloatArray, extrados: FloatArray, back: FloatArray) -> FloatArray:
    """Quadrilateral from a springing joint straight back, (4, 2), counter-clockwise."""
    corners = np.stack([intrados, extrados, extrados + back, intrados + back])
    first, second = corners[1] - corners[0], corners[2] - corners[1]
    return corners if first[0] * second[1] - first[1] * second[0] > 0 else corners[::-1]


def _in_space(points: FloatArray) -> FloatArray:
    """Points (..., 2) of the x-z plane in space, (..., 3)."""
    return np.stack([points[..., 0], np.zeros(points.shape[:-1]), points[..., 1]], axis=-1)
