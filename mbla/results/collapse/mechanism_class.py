"""A mechanism in one word, to count and colour many of them: what its joints do that moves notably.

Told of the clusters of a failure (:mod:`mbla.results.collapse.failure`), by joints whose contact speed is a notable
share of the largest:

- sliding: joints slide and none hinges;
- twisting: the same, and each of them slides by turning about its normal;
- overturning: parts turn about hinges on what is at rest, each by itself;
- hinging: parts hinge on each other, as in an arch;
- sliding and hinging: both;
- opening: joints only open, as under a block that is lifted off, or above a support that gives way and is not missed.
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from mbla.results.collapse.failure import MovingJoints
from mbla.results.collapse.hinge_lines import HingeLine

NOTABLE = 0.1
"""share of the largest contact speed, or of the power put in, from which a joint counts: a tenth is seen in a picture,
and the residuals up to which a case counts as solved are far below"""


class MechanismClass(StrEnum):
    """The words."""

    SLIDING = "sliding"
    TWISTING = "twisting"
    OVERTURNING = "overturning"
    HINGING = "hinging"
    SLIDING_AND_HINGING = "sliding and hinging"
    OPENING = "opening"


def mechanism_class(joints: MovingJoints) -> MechanismClass:
    """The class of a mechanism."""
    lines = [line for line in joints.hinge_lines if line.share >= NOTABLE]
    planes = [plane for plane in joints.sliding_planes if plane.speed >= NOTABLE]
    slides = bool(planes) or any(_slides(line) for line in lines)
    if lines and slides:
        return MechanismClass.SLIDING_AND_HINGING
    if lines:
        on_rest = all(0 in line.clusters for line in lines)
        return MechanismClass.OVERTURNING if on_rest else MechanismClass.HINGING
    if planes:
        return MechanismClass.TWISTING if all(plane.twists for plane in planes) else MechanismClass.SLIDING
    return MechanismClass.OPENING


def _slides(line: HingeLine) -> bool:
    """Whether a hinge slides notably too: its shear forces take some of the power."""
    return line.slides and bool(np.nan_to_num(line.shear) >= NOTABLE)
