"""The voussoirs of the dome of the benchmarks as an OBJ file; ``python -m tests.decks.dome_mesh`` writes it again."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tests.decks.folder import DECKS

FILE = DECKS / "benchmarks" / "closed_forms" / "data" / "dome_24_voussoirs.obj"
RINGS, SEGMENTS, TOP, RADIUS, THICKNESS = 3, 8, 60.0, 2.0, 0.3
"""voussoirs up and around; latitude of the oculus [degrees]; mean radius and thickness [m]"""

SIDES = [[s + q, s + 4 + q, s + 4 + (q + 1) % 4, s + (q + 1) % 4] for s in (0, 4) for q in range(4)]
FACES = [[0, 1, 2, 3], [8, 11, 10, 9], *SIDES]
"""of twelve corners, four on each of three meridians: both ends, and the sides of the two halves"""


def mesh_text() -> str:
    """The whole file: one object for each voussoir, from the ground up.

    Every voussoir spans three meridians, so that its faces are planar and the ring above fits half a voussoir on.
    """
    lines = ["# Dome of three rings of eight voussoirs, metres. Generated: tests/decks/dome_mesh.py"]
    for ring in range(RINGS):
        for segment in range(SEGMENTS):
            number = ring * SEGMENTS + segment
            lines.append(f"o voussoir {number}")
            lines += [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in _corners(ring, segment)]
            lines += [f"f {' '.join(str(12 * number + corner + 1) for corner in face)}" for face in FACES]
    return "\n".join(lines) + "\n"


def _corners(ring: int, segment: int) -> Iterator[tuple[float, float, float]]:
    low, high = (math.radians(TOP) * (ring + i) / RINGS for i in (0, 1))
    for meridian in range(3):
        around = math.pi * (2 * segment + ring % 2 + meridian) / SEGMENTS
        for side, latitude in ((-1, low), (1, low), (1, high), (-1, high)):
            r = RADIUS + side * THICKNESS / 2
            yield (
                r * math.cos(latitude) * math.cos(around),
                r * math.cos(latitude) * math.sin(around),
                r * math.sin(latitude),
            )


def main() -> None:
    """Write the file again."""
    FILE.parent.mkdir(exist_ok=True)
    FILE.write_text(mesh_text(), encoding="utf-8")


if __name__ == "__main__":
    main()
