"""Where a spatial picture is seen from: direction, what fills the picture, and the way from points to the page."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray

FRAME = ((0.04, 0.96), (0.12, 0.86))
"""part of the picture, from left to right and from bottom to top, that the structure fills; the rest is for words"""


@dataclass(frozen=True)
class Camera:
    """A parallel projection.

    centre    : (3,) m, in the middle of the picture
    towards   : (3,) unit, from the centre to the eye
    right, up : (3,) unit, directions of the picture
    height    : m from the lower to the upper edge of the picture
    aspect    : width over height of the picture
    depth     : m, radius of everything that is seen
    """

    centre: FloatArray
    towards: FloatArray
    right: FloatArray
    up: FloatArray
    height: float
    aspect: float
    depth: float

    def project(self, points: FloatArray) -> FloatArray:
        """Places on the page, (n, 2): 0 to 1 from left to right and from bottom to top."""
        arms = points - self.centre
        return np.column_stack(
            [0.5 + arms @ self.right / (self.height * self.aspect), 0.5 + arms @ self.up / self.height]
        )


def axes_of(azimuth: float, elevation: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit vectors towards the eye, to the right and up, (3,) each."""
    turn, rise = np.deg2rad([azimuth, elevation])
    towards = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0.0])
    return towards, right, np.cross(towards, right)


def fitted(
    points: FloatArray,
    azimuth: float,
    elevation: float,
    aspect: float,
    frame: tuple[tuple[float, float], tuple[float, float]] = FRAME,
) -> Camera:
    """The camera that shows points as large as the frame allows, (n, 3) m."""
    towards, right, up = axes_of(azimuth, elevation)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    arms = points - middle  # far from the origin their coordinates would lose digits
    across, along = arms @ right, arms @ up
    (left, end), (bottom, top) = frame
    height = float(max(np.ptp(along) / (top - bottom), np.ptp(across) / (end - left) / aspect))
    height = height or 1.0
    centre = middle + right * ((across.max() + across.min()) / 2 + (0.5 - (left + end) / 2) * height * aspect)
    centre = centre + up * ((along.max() + along.min()) / 2 + (0.5 - (bottom + top) / 2) * height)
    depth = float(np.linalg.norm(arms, axis=1).max()) or 1.0
    return Camera(centre, towards, right, up, height, aspect, max(depth, height))
