"""Item `pavilion_vault`: webs from all four sides that meet in hips."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.vaults.mitred import (
    SHORTEST,
    HalfSection,
    MitredVaultItem,
    Webs,
    half_section,
    mitred_block,
    mitred_vault,
    register_vault,
    units_between,
)


class PavilionVaultItem(MitredVaultItem):
    """A pavilion (cloister) vault: it rises from all four sides of a bay, whose middle is at the origin, springings at
    z = 0; courses run along the sides and meet in vertical planes over the diagonals.

    The curve spans bay[0]; over an oblong bay the other section is this one stretched along y, so that the hips stay
    plane. The number of courses is odd: a keystone closes the crown. Members `hip`, `web`, `keystone`; labels: `course`
    from the springings up, of webs `span` (0 to 3: the webs towards +x, +y, -x, -y) and `unit` counter-clockwise, of
    hips `segment` (0 to 3: the corners at +x+y, -x+y, -x-y, +x-y).
    """

    bay: tuple[PositiveLength, PositiveLength] = Field(
        description="extents along x and y between the intrados springings"
    )


@rule(PavilionVaultItem)
def pavilion_keystone(vault: PavilionVaultItem) -> Iterator[Finding]:
    """Four webs end in a keystone, which is flat."""
    if vault.courses % 2 == 0:
        yield Finding("out-of-bounds", "must be odd: a keystone closes the crown", "courses")
    if vault.shape == "pointed":
        words = "must not be pointed: a keystone closes the crown, and the apex would be a kink in it"
        yield Finding("vault-shape", words, "shape")


def generate(item: PavilionVaultItem, context: ItemContext) -> Generated:
    """Hips from the springings up, four blocks in each course; units of the webs; keystone; fixed springers."""
    section = half_section(item)
    hips, webs = [], Webs()
    for course in range(section.courses):
        x, y = _joints_between(item, section, course)
        hips.append(_hip(section, course, x[-1], y[-1]))
        along_x, along_y = units_between(section.profile(course), section.stretch, x, y)
        for span, units in enumerate((along_y, along_x[::-1]) * 2):  # counter-clockwise
            webs.append((units if span < 2 else units * [-1.0, -1.0, 1.0], (1, 1), course, span))
    return mitred_vault(item, section, "hip", hips, webs, _hip(section, -1, 0.0, 0.0))


def _hip(section: HalfSection, course: int, x: float, y: float) -> FloatArray:
    """The block in the corner +x+y, (1, 3, 4, 3): its end along y, the mitre, its end along x."""
    return mitred_block(section, course, x, y)[:, ::-1]


def _joints_between(item: PavilionVaultItem, section: HalfSection, course: int) -> tuple[FloatArray, FloatArray]:
    """Upright joints of a course along x and along y, increasing; the arms of the hips end at the first and last."""
    shifted = item.bond == "running" and course % 2 == 1
    found = []
    for stretched in (1.0, section.stretch):
        reach = stretched * section.profile(course)[:, 0].min() - SHORTEST * item.unit
        reach = np.fmin(reach, max(item.bay))  # infinite, or no number, where a radius is beyond what a double holds
        steps = np.arange(int(max(reach, 0.0) / item.unit) + 1) + (0.5 if shifted else 0.0)
        right = item.unit * steps[item.unit * steps <= reach]
        found.append(np.unique(np.concatenate([-right, right])) if len(right) else np.zeros(1))
    return found[0], found[1]


def amount(item: PavilionVaultItem) -> tuple[float, str]:
    """Units along the webs."""
    return item.courses * sum(item.bay) / item.unit, "unit"


register_vault("pavilion_vault", PavilionVaultItem, generate, amount, after="cross_vault")
