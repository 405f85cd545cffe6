"""Loads on a tilting table: gravity turns, seen from the structure.

The table turns about the axis k by the angle t; in the axes of the structure gravity g turns back by it (Rodrigues),

    g(t) = (g · k) k + cos t (g - (g · k) k) - sin t k × g

so that the load of every block is fixed + cos t turning + sin t across. Only gravity turns: forces, pressures and
accelerations keep their direction in the structure, as if they turned with the table.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.loads import Tilt as TiltSection
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.loads.gravity import gravity_of, mass_forces
from mbla.model.loads.load_kind import AppliedLoad, Entry, LoadSite
from mbla.model.solids.plane import unit
from mbla.model.wording import vector
from mbla.questions.tilt import Tilt

ALONG = 1e-9
"""share of gravity across the axis, below which the axis counts as parallel to it"""


def tilt_loads(
    load: TiltSection, dead: Sequence[Entry], dead_total: FloatArray, path: KeyPath, site: LoadSite
) -> tuple[Tilt, AppliedLoad]:
    """What turns of the dead load, (n_blocks, 6), and how; a fault where nothing does. Besides, the load across."""
    axis = unit(np.array(load.axis))
    gravity = gravity_of(dead)
    others = any(entry.load.gravity is None for entry in dead)
    level = gravity - (gravity @ axis) * axis
    everywhere = np.arange(len(site.blocks))
    turning = mass_forces(everywhere, level, site)[:, :6]
    across = mass_forces(everywhere, -np.cross(axis, gravity), site)
    size = max(np.abs(gravity).max(), np.finfo(np.float64).tiny)  # so that squares do not overflow
    if np.linalg.norm(level / size) <= ALONG * np.linalg.norm(gravity / size):
        what = "gravity lies along the axis" if gravity.any() else "there is no gravity among the dead loads"
        site.refuse(Finding("live-load-without-effect", f"nothing turns: {what}", *path, "live", 0, "tilt"))
    if others:
        name = path[-1]
        message = f"{name}: only gravity turns; the other dead loads keep their direction in the structure"
        site.warn("tilt-turns-gravity-only", message)
    tilt = Tilt(axis, dead_total - turning, turning, across[:, :6])
    return tilt, AppliedLoad(everywhere, across, f"tilt about {vector(load.axis)}")
