"""Error of moved meshes of soil over the number of cells, against known limit loads: the table of soil_mesh.md.

::

    python -m tests.performance.soil_mesh [part of a name]
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.optimize import minimize

from mbla.arrays import FloatArray
from mbla.soil_mesh.moving import move_corners
from mbla.soil_mesh.planar_program import find_mechanism
from tests.soil_mesh.scenes import SoilCase, slope, strip, wall

SIZES = (0.5, 0.25, 1.0 / 6.0)
MOST = 1000
"""cells"""
STRIPS = {0: (1.8, 1.0), 20: (3.4, 1.4), 30: (5.2, 1.8)}
"""half width and depth of the soil, by its angle of friction, that hold the mechanism of Prandtl"""
VERTICAL_CUT = 3.776
"""between bounds of the literature that differ by less than a thousandth, φ = 0"""
FAR = 8.0
"""greatest coordinates of poles that are tried, over the height"""
ROUNDS = 4000
"""points of a spiral"""


def spiral(pole: FloatArray, first: FloatArray, friction: float, turn: float) -> FloatArray:
    """Points of r = r_0 exp(θ tan φ) about a pole from a first point on, (ROUNDS, 2)."""
    arm = first - pole
    angles = np.linspace(0.0, turn, ROUNDS)
    radius = np.linalg.norm(arm) * np.exp(angles * friction)
    angles = angles + np.arctan2(arm[1], arm[0])
    return np.asarray(pole + radius[:, None] * np.column_stack([np.cos(angles), np.sin(angles)]))


def moment_of_area(corners: FloatArray) -> tuple[float, float]:
    """Area of a polygon, and that times the x of its centroid."""
    x, y = corners.T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    return float(cross.sum() / 2.0), float((cross * (x + np.roll(x, -1))).sum() / 6.0)


def passive_by_log_spiral(angle: float, wall_angle: float) -> float:
    """Least horizontal force on a wall of height 1, weight 1: moments about the pole of one log spiral from the foot.

    The force acts at a third of the height (Terzaghi; as an upper bound Soubra and Macuh 2002, Proc. ICE Geotechnical
    Engineering 155, 119-131).
    """
    friction, delta = np.tan(np.radians(angle)), np.radians(wall_angle)

    def force(pole: FloatArray) -> float:
        curve = spiral(pole, np.zeros(2), friction, np.pi / 2)
        if curve[-1, 1] < 1.0 or pole[1] < 0.5 or np.abs(pole).max() > FAR:
            return 1e3
        end = int(np.argmax(curve[:, 1] >= 1.0))
        share = (1.0 - curve[end - 1, 1]) / (curve[end, 1] - curve[end - 1, 1])
        last = curve[end - 1] + share * (curve[end] - curve[end - 1])
        area, moment = moment_of_area(np.vstack([curve[:end], last, [[0.0, 1.0]]]))
        lever = pole[0] * np.sin(delta) - (1.0 / 3.0 - pole[1]) * np.cos(delta)
        thrust = (moment - area * pole[0]) / lever if lever > 0.0 else 1e3
        return float(thrust * np.cos(delta)) if thrust > 0.0 else 1e3

    starts = [(-x, y) for x in (0.1, 0.5, 1.0, 2.0) for y in (1.0, 1.5, 2.5)]
    return min(float(minimize(force, start, method="Nelder-Mead").fun) for start in starts)


def slope_by_log_spiral(angle: float, face: float) -> float:
    """Least γ H / c of a slope of height 1, by one log spiral through its toe (Chen 1975, Limit analysis and soil
    plasticity, chapter 9)."""
    friction, foot = np.tan(np.radians(angle)), 1.0 / np.tan(np.radians(face)) if face < 90.0 else 0.0

    def number(pole: FloatArray) -> float:
        toe, mirror = np.array([foot, 0.0]), np.array([-1.0, 1.0])
        curve = spiral(pole * mirror, toe * mirror, -friction, np.pi / 2) * mirror
        if curve[-1, 1] < 1.0 or pole[1] < 0.5 or np.abs(pole).max() > FAR:
            return 1e3
        end = int(np.argmax(curve[:, 1] >= 1.0))
        if (curve[1:end, 0] > foot * (1.0 - curve[1:end, 1])).any():
            return 1e3
        share = (1.0 - curve[end - 1, 1]) / (curve[end, 1] - curve[end - 1, 1])
        last = curve[end - 1] + share * (curve[end] - curve[end - 1])
        area, moment = moment_of_area(np.vstack([curve[:end], last, [[0.0, 1.0]]])[::-1])
        first, final = np.linalg.norm(toe - pole), np.linalg.norm(last - pole)
        turn = abs(np.arctan2(*(toe - pole)[::-1]) - np.arctan2(*(last - pole)[::-1]))
        resisting = (first**2 - final**2) / (2.0 * friction) if angle else first**2 * turn
        driving = area * pole[0] - moment
        return float(resisting / driving) if driving > 0.0 and last[0] < 0.0 and resisting > 0.0 else 1e3

    starts = [(x, y) for x in (-0.5, 0.2, 1.0, 2.0) for y in (1.2, 2.0, 3.0)]
    return min(float(minimize(number, start, method="Nelder-Mead").fun) for start in starts)


def cases() -> dict[str, tuple[float, Callable[..., SoilCase]]]:
    """Name, known load factor, and the case by size of cells and kind of triangles."""
    found: dict[str, tuple[float, Callable[..., SoilCase]]] = {}
    for angle, (width, depth) in STRIPS.items():
        exact = strip(angle, 0.5, width, depth).exact
        found[f"strip, N_c, φ {angle}"] = exact, partial(strip, angle, width=width, depth=depth)
    for angle, face in ((0, 90), (20, 90), (20, 60)):
        exact = slope_by_log_spiral(angle, face) if angle else VERTICAL_CUT
        found[f"slope {face}, φ {angle}"] = exact, partial(slope, angle, face=face, width=1.5 if face > 60 else 2.5)
    for angle, delta in ((30, 0), (30, 20)):
        q = np.sqrt(np.sin(np.radians(angle + delta)) * np.sin(np.radians(angle)) / np.cos(np.radians(delta)))
        exact = -float((np.cos(np.radians(angle)) / (1 + q)) ** 2) / 2.0
        found[f"active, φ {angle}, δ {delta}"] = exact, partial(wall, angle, delta, passive=False)
    for angle, delta in ((30, 0), (30, 10), (30, 20), (30, 30), (40, 20)):
        rankine = float(np.tan(np.radians(45 + angle / 2)) ** 2 / 2.0)
        exact = passive_by_log_spiral(angle, delta) if delta else rankine
        found[f"passive, φ {angle}, δ {delta}"] = exact, partial(wall, angle, delta, passive=True)
    return found


def main(part: str, sizes: tuple[float, ...]) -> None:
    """One row for every case, size and kind of triangles; the rate is that in the size, by the last two."""
    for name, (exact, make) in cases().items():
        if part not in name:
            continue
        for crossed in (True, False):
            before: tuple[int, float] | None = None
            for size in sizes:
                case, started = make(size=size, crossed=crossed), time.process_time()
                if len(case.scene.triangles) > MOST:
                    break
                moved = move_corners([case.scene], case.points, case.motions)
                seconds, cells = time.process_time() - started, len(case.scene.triangles)
                error = moved.load_factor / exact - 1.0
                rate = 2 * np.log(abs(before[1] / error)) / np.log(cells / before[0]) if before else np.nan
                before = cells, error
                kind = "crossed" if crossed else "equilateral"
                first = find_mechanism(case.scene, case.points)
                at_first = "locks" if first is None else f"{100 * (first.load_factor / exact - 1.0):+.1f}"
                row = (name, f"{exact:.4f}", kind, str(cells), at_first, f"{100 * error:+.2f}")
                print("|", " | ".join((*row, f"{rate:.1f}", str(moved.steps), f"{seconds:.1f}")), "|", flush=True)  # noqa: T201


if __name__ == "__main__":
    main(
        sys.argv[1] if len(sys.argv) > 1 else "",
        tuple(map(float, sys.argv[2].split(","))) if len(sys.argv) > 2 else SIZES,
    )
