"""Item `pavilion_vault`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.vault import VaultItem
from mbla.deck.quantities import PositiveLength


class PavilionVaultItem(VaultItem):
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
