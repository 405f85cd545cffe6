"""Settings of the proof of an associative load factor, in one record.

What each is worth was measured on whole corpora (tests/performance).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class AssociativeSettings:
    """Load factors are in shares of dead over live load.

    small     : load factor below which the program is solved again in units of its own size
    noise     : load factor below which that size is not known
    zero_size : that stands for it then
    sharper   : factor on the tolerance of the second method
    sharpest  : least tolerance
    powers    : of the size of a load factor that are the second method's units of live power, in turn: an arch at its
                least thickness is sharpest in its own
    rough     : friction that counts in the second method, at most
    rough_tolerance : of programs whose forces only say which conditions on interfaces they need
    """

    small: float = 1e-3
    noise: float = 1e-10
    zero_size: float = 1e-7
    sharper: float = 1e-2
    sharpest: float = 1e-12
    powers: tuple[float, ...] = (0.5, 1.0)
    rough: float = 1e3
    rough_tolerance: float = 1e-5

    def validate(self) -> None:
        """Raise a ValueError where nothing could be proved with them."""
        if not 0.0 < self.noise < self.zero_size < self.small < 1.0:
            raise ValueError("load factors must be noise below zero_size, and that below small")
        if not 0.0 < self.sharpest <= self.rough_tolerance < 1.0 or not 0.0 < self.sharper <= 1.0:
            raise ValueError("tolerances must be above 0, and no coarser than the first method's")
        if not self.powers or not all(0.0 < power <= 1.0 for power in self.powers):
            raise ValueError("powers must lie within 0 and 1")
        if not self.rough > 0.0:
            raise ValueError("without friction nothing is proved of rough joints")
