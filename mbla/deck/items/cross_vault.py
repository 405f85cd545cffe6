"""Item `cross_vault`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.vault import VaultItem
from mbla.deck.quantities import PositiveLength


class CrossVaultItem(VaultItem):
    """A cross (groin) vault: two barrels that meet in vertical planes over the diagonals, the middle of the bay at the
    origin, springings at z = 0.

    The curve spans bay[0], across the webs towards +y and -y; over an oblong bay the other section is this one
    stretched along y, so that the groins stay plane. Blocks at the groins belong to both webs. An odd number of courses
    has a keystone with a course along each ridge, an even one joints along the ridges. Members `groin`, `web`,
    `keystone`; labels: `course` from the springings up, of webs `span` (0 to 3: the webs towards +x, +y, -x, -y) and
    `unit` from the groin outwards, of groins `segment` (0 to 3: the corners at +x+y, -x+y, -x-y, +x-y).
    """

    bay: tuple[PositiveLength, PositiveLength] = Field(
        description="distance along x and y between the corners where the intrados springs"
    )
    edge: PositiveLength | None = Field(
        None,
        description="how far the webs run on beyond these corners, the width of the piers: more than the thickness; "
        "twice the thickness unless given, over an oblong bay that of its stretched section",
    )
