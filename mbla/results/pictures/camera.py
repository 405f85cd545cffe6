"""The viewpoint of a picture: a parallel projection that shows points as large as their room allows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.motion import drawn_motion, vertex_displacements
from mbla.results.pictures.geometry import front_axis
from mbla.results.record.scene import Scene

USUAL = (-60.0, 25.0)
"""default azimuth and elevation"""
SIDES = (
    (-60.0, -120.0, 60.0, 120.0),
    (-68.0, -112.0, 68.0, 112.0),
    (-22.0, 22.0, 202.0, 158.0),
)
"""azimuths: of a structure about as wide as deep, of one long along x, of one long along y"""
LONG = 2.0
"""length over width in plan from which a structure is viewed across its length"""
BEHIND = 0.4
"""what speaks against views from +y, the back of most decks; 1 speaks for facing the side towards which all moves"""
Room = tuple[tuple[float, float], tuple[float, float]]
"""part of a page, from left to right and from bottom to top"""


@dataclass(frozen=True)
class Camera:
    """A parallel projection.

    centre    : (3,) m, in the middle of the picture
    towards   : (3,) unit, from the centre to the eye
    right, up : (3,) unit, directions of the picture
    height    : m from the lower to the upper edge of the picture
    aspect    : width over height of the picture
    depth     : m, radius of everything that is visible
    """

    centre: FloatArray
    towards: FloatArray
    right: FloatArray
    up: FloatArray
    height: float
    aspect: float
    depth: float

    def project(self, points: FloatArray) -> FloatArray:
        """Places on the page in heights of it from its lower left corner, (..., 2) from (..., 3) m."""
        arms = (points - self.centre) / self.height
        return np.stack([0.5 * self.aspect + arms @ self.right, 0.5 + arms @ self.up], axis=-1)


def axes_of(azimuth: float, elevation: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit vectors towards the eye, to the right and up, (3,) each."""
    turn, rise = np.deg2rad([azimuth, elevation])
    towards = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    right = np.array([-np.sin(turn), np.cos(turn), 0.0])
    return towards, right, np.cross(towards, right)


def fitted(points: FloatArray, view: tuple[float, float], aspect: float, room: Room) -> Camera:
    """The camera that shows points, (n, 3) m, as large as the room allows.

    view : azimuth and elevation in degrees; aspect : width over height of the page
    """
    towards, right, up = axes_of(*view)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    arms = points - middle  # far from the origin their coordinates would lose digits
    across, along = arms @ right, arms @ up
    (left, end), (bottom, top) = room
    height = float(max(np.ptp(along) / (top - bottom), np.ptp(across) / (end - left) / aspect)) or 1.0
    centre = middle + right * ((across.max() + across.min()) / 2 + (0.5 - (left + end) / 2) * height * aspect)
    centre = centre + up * ((along.max() + along.min()) / 2 + (0.5 - (bottom + top) / 2) * height)
    depth = float(np.linalg.norm(arms, axis=1).max()) or 1.0
    return Camera(centre, towards, right, up, height, aspect, max(depth, height))


def view_of_case(scene: Scene) -> tuple[float, float]:
    """Azimuth and elevation in degrees, the same for every kind of picture of a case, and in ParaView.

    What is thin is seen from the front, the rest from the side towards which it moves, the front before the back.
    """
    blocks = scene.model.blocks
    travel = vertex_displacements(blocks, drawn_motion(scene.model, scene.case))
    axis = front_axis(np.ptp(blocks.vertices, axis=0), np.abs(travel).max(axis=0))
    if axis is not None:
        return (0.0, 0.0) if axis == 0 else (-90.0, 0.0)
    if not travel.any():
        return USUAL
    heading = travel[:, :2].mean(axis=0) / np.linalg.norm(travel, axis=1).max()
    wide, deep = np.ptp(blocks.vertices[:, :2], axis=0)
    sides = SIDES[1 if wide > LONG * deep else 2 if deep > LONG * wide else 0]
    found = [float(axes_of(side, 0.0)[0][:2] @ heading) - BEHIND * (0 < side < 180) for side in sides]
    return sides[int(np.argmax(np.round(found, 3)))], USUAL[1]
