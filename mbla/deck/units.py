"""Units of a deck, and the conversion of strings with a unit (only importer of pint)."""

from __future__ import annotations

from dataclasses import dataclass

METRES = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
NEWTONS = {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": 4.4482216152605, "kip": 4448.2216152605}
KILOGRAMS = {"kg": 1.0, "t": 1e3, "lb": 0.45359237}
STANDARD_GRAVITY = 9.81
"""m/s2; the g of load factors that are accelerations, and of unit weights"""


@dataclass(frozen=True)
class Units:
    """Units of length, force and mass; time is always in seconds."""

    length: str = "m"
    force: str = "N"
    mass: str = "kg"

    @property
    def standard_gravity(self) -> float:
        """9.81 m/s2 in the deck's unit of length per s2."""
        return STANDARD_GRAVITY / METRES[self.length]

    @property
    def force_per_mass_acceleration(self) -> float:
        """Factor from (unit of mass) x (unit of length)/s2 to the unit of force."""
        return KILOGRAMS[self.mass] * METRES[self.length] / NEWTONS[self.force]
