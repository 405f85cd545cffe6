"""Item `barrel_vault`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.vault import VaultItem
from mbla.deck.quantities import PositiveLength


class BarrelVaultItem(VaultItem):
    """A barrel vault, its axis along +y, courses along the axis, in the bond of a wall.

    The left intrados springing is at x = 0, the right one at x = span, both at z = 0, from y = 0 to length. Labels:
    `course` from the left springing, `unit` from y = 0.
    """

    span: PositiveLength = Field(description="distance between the intrados springings")
    length: PositiveLength = Field(description="extent along y")
