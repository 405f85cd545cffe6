"""How near a path of elastic joints comes to a closed form."""

from __future__ import annotations

ABOVE, BELOW = 1e-5, 2e-3
"""Relative: a path ends at 50 elastic displacements, where its load may still rise, and its smoothing holds that back:
grooves are up to 0.13 % low, nothing lies above its closed form by more than rounding and the smoothing of its peak."""


def reaches(load_factor: float, closed_form: float, below: float = BELOW) -> bool:
    """Whether that is the load factor of a path whose structure has this closed form, greater than zero.

    below : share by which it may lie below
    """
    return (1.0 - below) * closed_form <= load_factor <= (1.0 + ABOVE) * closed_form
