"""Structures on a base that moves, for comparison with LMGC90: regular motions, whose peaks do not jump."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray

GRAVITY = 9.81
"""m/s², of LMGC90; standard gravity is 0.03 % less"""
STIFF, SOFT = 1e12, 1e10
"""Stiffness of joints per area, Pa/m: as good as rigid, and that of the default"""
STEEP_RATIO = 100.0
"""shear stiffness over normal stiffness that stands for the rigid shear of elastic joints of LMGC90"""
CASE = "pulse"
ALONG_X = (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Pulse:
    """Acceleration of the base.

    kind      : ``half_sine``, or ``dejong``: ``amplitude`` for ``duration``, minus half of it for twice as long
    amplitude : m/s²
    duration  : s
    direction : a unit vector
    """

    kind: str
    amplitude: float
    duration: float
    direction: tuple[float, float, float] = ALONG_X

    def velocities(self, times: FloatArray) -> FloatArray:
        """Of the base at times (n,), (n, 3) m/s."""
        return np.asarray(self._speeds(times)[:, None] * np.array(self.direction))

    def _speeds(self, times: FloatArray) -> FloatArray:
        """By integration in closed form."""
        first = np.clip(times, 0.0, self.duration)
        if self.kind == "half_sine":
            w = np.pi / self.duration
            return np.asarray(self.amplitude / w * (1.0 - np.cos(w * first)))
        second = np.clip(times - self.duration, 0.0, 2.0 * self.duration)
        return np.asarray(self.amplitude * (first - 0.5 * second))


@dataclass(frozen=True)
class Point:
    """A point of a block whose displacement along an axis, relative to the base, is followed; its place as built, m."""

    group: str
    index: int
    place: tuple[float, float, float]
    axis: int = 0


@dataclass(frozen=True)
class Scene:
    """Blocks of one density with one friction coefficient on blocks that the base holds, and a pulse.

    blocks      : items of the deck's ``blocks``, lines
    held        : group of the blocks of the base
    points      : by name
    duration    : s
    area        : m², of every interface, so that one stiffness a point fits all; None: joints as good as rigid only
    base_area   : m², of interfaces with the base where it is another
    """

    blocks: str
    held: str
    points: dict[str, Point]
    pulse: Pulse
    duration: float
    friction: float
    density: float = 2000.0
    area: float | None = None
    base_area: float | None = None

    def text(self, stiffness: float = STIFF, ratio: float = 0.4, step: float = 1e-3) -> str:
        """The deck for mbla.

        stiffness : normal stiffness of joints, Pa/m; with the base less where interfaces are greater
        ratio     : shear stiffness over it
        step      : s
        """
        at_base = stiffness * (self.area or 1.0) / (self.base_area or self.area or 1.0)
        dry, foot = (
            f"{{friction: {self.friction!r}, stiffness: {{normal: {k!r}, ratio: {ratio!r}}}}}"
            for k in (stiffness, at_base)
        )
        groups = sorted({point.group for point in self.points.values()})
        bed = f"[{{between: [{self.held}, {groups[0]}], joint: foot}}]" if self.base_area else "[]"
        foot = f", foot: {foot}" if self.base_area else ""
        points = ", ".join(
            f"{name}: {{on: {{group: {point.group}, index: {point.index}}}, at: {list(point.place)}}}"
            for name, point in self.points.items()
        )
        size = f"amplitude: {self.pulse.amplitude!r} m/s2, duration: {self.pulse.duration!r}"
        return f"""mbla: 1
title: Scene for comparison with LMGC90
materials: {{stone: {{density: {self.density!r}}}}}
joints: {{dry: {dry}{foot}}}
blocks:
{self.blocks}contacts: {{joint: dry, tolerance: 1.e-4, overrides: {bed}}}
supports: [{{blocks: {self.held}}}]
load_cases:
  {CASE}:
    time_history:
      motion: {{pulse: {self.pulse.kind}, {size}, direction: {list(self.pulse.direction)}}}
      step: {step!r}
      duration: {self.duration!r}
      record: {{points: {{{points}}}}}
"""


def box(group: str, least: tuple[float, ...], greatest: tuple[float, ...]) -> str:
    """An item between two corners."""
    return f"  - box: {{group: {group}, material: stone, min: {list(least)}, max: {list(greatest)}}}\n"


def hexahedron(group: str, corners: FloatArray) -> str:
    """An item of corners (8, 3): four of one face in turn, anticlockwise seen from the other, and those opposite."""
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    places = np.round(corners, 12).tolist()
    return f"  - polyhedron: {{group: {group}, material: stone, vertices: {places}, faces: {faces}}}\n"


def prism(group: str, outline: FloatArray, width: float) -> str:
    """An item across y, centred there: an outline (4, 2) of x and z, clockwise seen along y."""
    sides = [np.insert(outline, 1, y, axis=1) for y in (0.5 * width, -0.5 * width)]
    return hexahedron(group, np.vstack(sides))


FLOOR = box("base", (-3.0, -1.0, -0.3), (3.0, 1.0, 0.0))


def block() -> Scene:
    """A block .2 × .3 × 1 m that rocks; .49 g would overturn it. Its upper right edge."""
    lines = FLOOR + box("block", (-0.1, -0.15, 0.0), (0.1, 0.15, 1.0))
    points = {"top": Point("block", 0, (0.1, 0.0, 1.0))}
    return Scene(lines, "base", points, Pulse("half_sine", 0.35 * GRAVITY, 0.25), 3.0, 0.7, area=0.06)


def arch() -> Scene:
    """Semicircular arch of 17 voussoirs, radii 3.75 and 4.25 m, 1 m wide. The centroid of its crown."""
    radii, half = (3.75, 4.25), np.pi / 34.0
    middle = 2.0 / 3.0 * np.sin(half) * np.cos(half) * (radii[1] ** 3 - radii[0] ** 3)
    height = middle / (np.sin(half) * np.cos(half) * (radii[1] ** 2 - radii[0] ** 2)) * np.cos(half)
    lines = (
        "  - arch: {group: arch, material: stone, shape: semicircular, span: 7.5, thickness: 0.5, width: 1.0,"
        " voussoirs: 17, springers: blocks}\n"
    )
    points = {"crown": Point("arch", 8, (3.75, 0.5, float(height)))}
    friction = float(np.tan(np.radians(35.0)))
    return Scene(lines, "arch_springers", points, Pulse("half_sine", 1.5, 0.25), 1.5, friction, area=0.5)


def stack() -> Scene:
    """A block on a wedge of 10°, on the ground: the block slides on the wedge, the wedge on the ground."""
    slope = np.radians(10.0)
    along, across = np.array([np.cos(slope), -np.sin(slope)]), np.array([np.sin(slope), np.cos(slope)])
    low, length, foot = 0.3, 1.0, -0.15
    rise = float(np.tan(slope))
    wedge = np.array([[-0.5, 0.0], [0.5, 0.0], [0.5, low], [-0.5, low + rise * length]])
    middle = np.array([foot, low + rise * (0.5 - foot)])
    upper = middle + np.array([-0.2 * along, 0.2 * along, 0.2 * along + 0.2 * across, -0.2 * along + 0.2 * across])
    lines = FLOOR + prism("wedge", wedge, 0.4) + prism("block", upper, 0.3)
    place = middle + 0.1 * across
    points = {
        "wedge": Point("wedge", 0, (0.0, 0.0, 0.2)),
        "block": Point("block", 0, (float(place[0]), 0.0, float(place[1]))),
    }
    return Scene(lines, "base", points, Pulse("half_sine", 0.5 * GRAVITY, 0.3, (-1.0, 0.0, 0.0)), 1.2, 0.3)


def wall() -> Scene:
    """Three units by eight courses in running bond, in its plane. The centroid of the last unit of the top course."""
    lines = box("base", (-0.4, -0.2, -0.2), (1.6, 0.4, 0.0)) + (
        "  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.2, courses: 8, bond: running}\n"
    )
    points = {"top": Point("wall", 27, (1.1, 0.1, 1.5))}
    pulse = Pulse("half_sine", 0.8 * GRAVITY, 0.25)
    return Scene(lines, "base", points, pulse, 1.5, 0.6, area=0.04, base_area=0.08)


def column() -> Scene:
    """Seven drums of .82 m and a cap of .21 m, 1 m square. The centroid of the cap."""
    lines, foot = FLOOR, 0.0
    for drum in range(8):
        top = round(foot + (0.82 if drum < 7 else 0.21), 2)
        lines += box("column", (-0.5, -0.5, foot), (0.5, 0.5, top))
        foot = top
    points = {"cap": Point("column", 7, (0.0, 0.0, round(foot - 0.105, 3)))}
    return Scene(lines, "base", points, Pulse("dejong", 0.21 * GRAVITY, 0.4), 3.0, 0.7, density=2620.0, area=1.0)


def drums() -> Scene:
    """Three drums, .4 m square and .6 m high, under a pulse 40° off their sides. The middle of the top, both ways."""
    lines = FLOOR + "".join(box("column", (-0.2, -0.2, 0.6 * n), (0.2, 0.2, round(0.6 * n + 0.6, 1))) for n in range(3))
    points = {name: Point("column", 2, (0.0, 0.0, 1.8), axis) for axis, name in enumerate(("top_x", "top_y"))}
    angle = np.radians(40.0)
    pulse = Pulse("half_sine", 0.55 * GRAVITY, 0.25, (float(np.cos(angle)), float(np.sin(angle)), 0.0))
    return Scene(lines, "base", points, pulse, 1.0, 0.7, area=0.16)


SCENES: dict[str, Callable[[], Scene]] = {
    "block": block,
    "arch": arch,
    "stack": stack,
    "wall": wall,
    "column": column,
    "drums": drums,
}


def scaled(scene: Scene, factor: float) -> Scene:
    """The same with another amplitude: whether the motion is regular."""
    return replace(scene, pulse=replace(scene.pulse, amplitude=factor * scene.pulse.amplitude))
