"""Section of an arch in its plane: joints across a curve, voussoirs between them in one or more rings.

Along a joint the boundaries of the rings lie at offsets from the curve. Voussoirs are straight-edged: a quadrilateral
between two joints, or around the apex of a pointed arch a hexagon with an inner and an outer apex of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Message
from mbla.model.generators.curves import Curve
from mbla.model.generators.generator import ItemRefused


@dataclass(frozen=True)
class Thickness:
    """Of an arch [length]: at crown and springings, and the share of it that lies inside the curve (0 or 1/2) [-]."""

    crown: float
    springing: float
    inside: float = 0.0


@dataclass(frozen=True)
class Section:
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


def build_section(curve: Curve, voussoirs: int, rings: int, thickness: Thickness) -> Section:
    """Section over a curve.

    Raises
    ------
    ItemRefused
        where the voussoirs are too few to be blocks, or joints cross each other within the thickness
    """
    _check_count(curve, voussoirs)
    mean = (thickness.crown + thickness.springing) / 2
    parameters = curve.divide(voussoirs, (0.5 - thickness.inside) * mean)
    here = _thickness_at(curve, parameters, thickness)
    shares = np.linspace(0.0, 1.0, rings + 1) - thickness.inside
    joints = curve.points(parameters, here[:, None] * shares)
    apex = None
    if curve.crest is not None and voussoirs % 2:
        apex = curve.points(np.array([curve.crest]), thickness.crown * shares[None])[0]
    section = Section(joints, curve.forwards(parameters), apex)
    _check_joints(section)
    return section


def voussoir_polygons(section: Section) -> tuple[list[FloatArray], IntArray, IntArray]:
    """Polygons counter-clockwise, with the position and the ring of each, ring by ring from the inside."""
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


def _thickness_at(curve: Curve, parameters: FloatArray, thickness: Thickness) -> FloatArray:
    """Thickness [length] at joints, growing evenly with the length from the middle of the curve."""
    if thickness.crown == thickness.springing:
        return np.full(len(parameters), thickness.crown)
    lengths = curve.lengths(parameters)
    share = np.abs(2 * lengths / lengths[-1] - 1)
    return np.asarray(thickness.crown + (thickness.springing - thickness.crown) * share, dtype=np.float64)


def _check_count(curve: Curve, voussoirs: int) -> None:
    forwards = curve.forwards(curve.divide(8, 0.0))
    across = forwards[:-1, 1] * forwards[1:, 0] - forwards[:-1, 0] * forwards[1:, 1]
    turned = np.degrees(np.arctan2(across, (forwards[:-1] * forwards[1:]).sum(axis=1)).sum())
    if not np.isfinite(turned):
        return  # coordinates beyond what a double holds: refused block by block
    least = int((turned + 1e-9) // 180) + 1  # a semicircle up to rounding is one
    if voussoirs < least:
        message = f"too few: at least {least}, so that each spans less than 180 degrees"
        raise ItemRefused([(("voussoirs",), Message("arch-shape", message))])


def _check_joints(section: Section) -> None:
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
            raise ItemRefused([(("voussoirs",), Message("arch-shape", message))])
