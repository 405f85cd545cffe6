"""Plane curves of arches and vaults. A new one is a file and a line here."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from mbla.model.blocks.curves.shape_keys import SIDE_ANGLE
from mbla.model.blocks.curves.shapes import Pointed, Smooth, basket, catenary, circle, ellipse, segmental
from mbla.model.blocks.curves.shapes import radius_of as radius_of

Curve: TypeAlias = Smooth | Pointed
WITH_RISE: dict[str, Callable[[float, float], Curve]] = {
    "segmental": segmental,
    "pointed": Pointed,
    "elliptic": ellipse,
    "catenary": catenary,
}
"""curves that span and rise determine"""


def named_curve(
    shape: str, span: float, rise: float | None = None, embrace: float | None = None, side_angle: float | None = None
) -> Curve:
    """Curve by its shape; span and rise [length], embrace and side_angle [degrees].

    The deck's rules ensure that what a shape needs is given, and that the rise is one it can have.
    """
    if shape == "semicircular":
        return circle(span, np.pi / 2)
    if embrace is not None:
        return circle(span, float(np.radians(embrace) / 2))
    assert rise is not None  # a rule of the deck
    if shape == "basket":
        return basket(span, rise, float(np.radians(SIDE_ANGLE if side_angle is None else side_angle)))
    return WITH_RISE[shape](span, rise)
