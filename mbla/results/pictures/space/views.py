"""The view that suits a structure by itself: one from which what moves, its hinges and its gaps are seen."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.pictures.geometry import front_axis
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.camera import fitted
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.mechanism import moving_blocks
from mbla.results.pictures.space.renderer import Renderer
from mbla.results.pictures.space.shapes import Faces, Shape
from mbla.results.pictures.space.structure import block_faces, grounds

USUAL = (-60.0, 25.0)
"""azimuth and elevation where nothing speaks for another view"""
SIDES = (
    (-60.0, -30.0, -120.0, -150.0, 30.0, 60.0, 120.0, 150.0),
    (-68.0, -112.0, 68.0, 112.0),
    (-22.0, 22.0, 158.0, 202.0),
)
"""azimuths that are tried: of a structure about as wide as deep, of one long along x, of one long along y"""
LONG = 2.0
"""length over width in plan from which a structure is looked at across its length"""
ELEVATIONS = {25.0: 1.0, -25.0: 0.5}
"""from above, and from below, which takes twice as much to be seen: one does not stand there"""
BEHIND = 0.9
"""weight of views from +y, which is the back of most decks"""
LOOKING_ON = 0.25
"""weight of facing the side towards which the structure moves"""
PIXELS = (240, 150)
"""of the trial pictures"""
JOINTS = 4.0
"""weight of a pixel of a hinge or a gap over one of a block that moves"""


def best_view(scene: Scene) -> tuple[float, float]:
    """Azimuth and elevation in degrees.

    What is thin is seen from the front. For the rest trial pictures are drawn from several sides, with what moves in
    one colour and joints that hinge, slide or open in another, and the one that shows most of them is taken.
    """
    vertices = scene.model.blocks.vertices
    travel = np.abs(scene.moved - vertices).max(axis=0)
    axis = front_axis(np.ptp(vertices, axis=0), travel)
    if axis is not None:
        return (0.0, 0.0) if axis == 0 else (-90.0, 0.0)
    moving = moving_blocks(scene)
    if not moving.any():
        return USUAL
    heading = np.average((scene.moved - vertices)[:, :2], axis=0)
    heading /= float(np.linalg.norm(heading)) or 1.0
    best, most = USUAL, 0.0
    with Renderer(_trial(scene, moving), ()) as renderer:
        for elevation, weight in ELEVATIONS.items():
            for azimuth in _azimuths(vertices):
                seen = _seen(renderer, scene, azimuth, elevation)
                turn = np.deg2rad(azimuth)
                facing = float(np.cos(turn) * heading[0] + np.sin(turn) * heading[1])
                seen *= weight * (BEHIND if 0 < azimuth < 180 else 1.0) * (1 + LOOKING_ON * facing)
                if seen > 1.02 * most:
                    best, most = (azimuth, elevation), seen
    return best


def _azimuths(vertices: FloatArray) -> tuple[float, ...]:
    wide, deep = np.ptp(vertices[:, :2], axis=0)
    return SIDES[1 if wide > LONG * deep else 2 if deep > LONG * wide else 0]


def _trial(scene: Scene, moving: BoolArray) -> list[Shape]:
    colours = np.zeros((len(moving), 3))
    colours[moving, 2] = 1.0
    faces, marks, *_ = joint_marks(scene, scene, scene.moved)
    joints = [shape for shape in (*faces, *marks) if isinstance(shape, Faces)]
    green = [
        Faces(shape.points, shape.start, shape.loops, np.tile([0.0, 1.0, 0.0], (len(shape.colours), 1)), lit=False)
        for shape in joints
    ]
    black = [
        Faces(shape.points, shape.start, shape.loops, np.zeros_like(shape.colours), lit=False)
        for shape in grounds(scene)
        if isinstance(shape, Faces)
    ]
    return [*black, block_faces(scene, scene.moved, colours, lit=False), *green]


def _seen(renderer: Renderer, scene: Scene, azimuth: float, elevation: float) -> float:
    """Area of what moves and of joints that is seen, in squares of the size of the structure."""
    width, height = PIXELS
    camera = fitted(scene.moved, azimuth, elevation, width / height)
    image = renderer.image(camera, width, height, 0.0)
    dark = image[..., 0] < 0.5
    pixels = (dark & (image[..., 2] > 0.5)).sum() + JOINTS * (dark & (image[..., 1] > 0.5)).sum()
    return float(pixels) * (camera.height / height / scene.size) ** 2
