"""Loads on a tilting table: gravity turns, seen from the structure.

The table turns about the axis k by the angle t; in the axes of the structure gravity g turns back by it (Rodrigues),

    g(t) = (g · k) k + cos t (g - (g · k) k) - sin t k × g

so that the load of every block is fixed + cos t turning + sin t across. Only gravity turns: forces, pressures and
accelerations keep their direction in the structure, as if they turned with the table.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Direction
from mbla.deck.section import Section
from mbla.errors import Finding
from mbla.model.applied_load import AppliedLoad
from mbla.model.loads.gravity import GRAVITY, gravity_of
from mbla.model.loads.load_kind import CaseKind, Entry, LoadSite, Variant
from mbla.model.loads.mass_forces import mass_forces
from mbla.model.solids.plane import unit
from mbla.model.wording import vector
from mbla.questions.angle import Angle
from mbla.questions.tilt import Tilt as TiltedLoads

ALONG = 1e-9
"""share of gravity across the axis, below which the axis counts as parallel to it"""


class Tilt(Section):
    """Tilting table: the structure turns with its supports until it collapses; the answer is an angle."""

    axis: Direction = Field(
        description="axis about which the table turns, by the right hand: about [0, 1, 0] it tips towards +x"
    )


def tilt_variants(
    name: str, entry: Entry, dead: Sequence[Entry], dead_load: FloatArray, site: LoadSite
) -> list[Variant]:
    """What turns of the dead load, (n_blocks, 6), and how; a fault where nothing does. What acts is gravity across."""
    tilt: Tilt = entry.value
    axis = unit(np.array(tilt.axis))
    gravity = gravity_of(dead)
    others = any(load.kind != GRAVITY for load in dead)
    level = gravity - (gravity @ axis) * axis
    everywhere = np.arange(len(site.blocks))
    turning = mass_forces(everywhere, level, site)[:, :6]
    across = mass_forces(everywhere, -np.cross(axis, gravity), site)
    size = max(np.abs(gravity).max(), np.finfo(np.float64).tiny)  # so that squares do not overflow
    if np.linalg.norm(level / size) <= ALONG * np.linalg.norm(gravity / size):
        what = "gravity lies along the axis" if gravity.any() else "there is no gravity among the dead loads"
        site.refuse(Finding("live-load-without-effect", f"nothing turns: {what}", *entry.path, "tilt"))
    if others:
        message = f"{name}: only gravity turns; the other dead loads keep their direction in the structure"
        site.warn("tilt-turns-gravity-only", message)
    applied = AppliedLoad(everywhere, across, f"tilt about {vector(tilt.axis)}", on_masses=True)
    return [Variant(applied, Angle(TiltedLoads(axis, dead_load - turning, turning, across[:, :6])))]


register_load(
    CaseKind(
        name="tilt",
        section=Tilt,
        description="gravity turns; the only load of its list",
        after="travel",
        refuses={"on": "tilt, which turns the whole structure", "factor": "tilt: gravity turns as it is"},
        alone="whose answer is an angle",
        variants=tilt_variants,
    )
)
