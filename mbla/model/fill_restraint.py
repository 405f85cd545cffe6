"""What fill does to blocks that move sideways: a horizontal force on each face that slopes, between two limits.

On a face with the outward normal n, its horizontal part n_h and the column of soil of the volume V over it

    K_a γ V |n_h|/n_z  <=  h  <=  m_p K_p γ V |n_h|/n_z + m_c 2 √K_p c A,    K_p = (1 + sin φ)/(1 − sin φ) = 1/K_a

acts against n_h, at the middle of the face; V |n_h|/n_z is the integral of the depth over A, the projection of the face
onto an upright plane. The soil resists with the upper limit where the face moves into it and follows with the lower one
where it moves away: a strut to the ground. Only a share m_p of the passive pressure, m_c of that of cohesion, is
reached before an arch comes down: peak strengths over-predict (Gilbert et al. 2010). The defaults, φ = 30°, m_p = 0.33
and m_c = 0.01, are those of Grandjean 2010, doi:10.5075/epfl-thesis-4596. The weight of loads on the fill does not
count in the pressure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mbla.arrays import BoolArray, starts, summed
from mbla.deck.sections.fill import Passive
from mbla.errors import Notice
from mbla.model.fill import FillBody, columns
from mbla.model.selectors import Roster
from mbla.model.solids.blocks import Blocks
from mbla.model.ties.ties import FILL, NO_TIES, OUTSIDE, Ties
from mbla.model.wording import counted

LEVEL = 1e-6
"""horizontal component of the unit normal of a face up to which it is level and has nothing to push against"""


def fill_struts(bodies: Iterable[FillBody], roster: Roster, fixed: BoolArray) -> list[Ties]:
    """Struts of the fills that restrain, one for each sloping face of a block that can move; a notice of each fill.

    fixed : (n_blocks,) blocks that do not move
    """
    found = []
    for body in bodies:
        if body.passive is None:
            continue
        struts = _struts(body, body.passive, roster.blocks, fixed)
        found.append(struts)
        least, most = coefficients(body.passive)
        words = (
            f"the fill {body.name} pushes on {counted(len(struts), 'face')} with {least:.4g} to {most:.4g} times the "
            f"vertical stress: how much of the passive pressure is mobilised, {body.passive.mobilisation:g} here, is a "
            "matter of calibration; vary it"
        )
        roster.remark(Notice("notice", "fill-restrains", words))
    return found


def coefficients(passive: Passive) -> tuple[float, float]:
    """Least and greatest horizontal over vertical stress, K_a and m_p K_p."""
    sine = math.sin(math.radians(passive.friction_angle))
    return (1.0 - sine) / (1.0 + sine), passive.mobilisation * (1.0 + sine) / (1.0 - sine)


def _struts(body: FillBody, passive: Passive, blocks: Blocks, fixed: BoolArray) -> Ties:
    """Struts between faces and what lies outside of the model, both ends in the middle of the face."""
    own = columns(body, blocks)
    faces, of_face = np.unique(body.faces[own.rows], return_inverse=True)
    normals = blocks.face_normals[faces]
    slopes = np.hypot(normals[:, 0], normals[:, 1])
    areas, volumes = (summed(of_face, values, len(faces)) for values in (own.areas, own.volumes))
    middles = summed(of_face, own.areas[:, None] * own.middles, len(faces)) / areas[:, None]
    loads = body.unit_weight * volumes * slopes / normals[:, 2]
    least, most = coefficients(passive)
    cohesive = passive.cohesion_mobilisation * 2.0 * math.sqrt(1.0 / least) * passive.cohesion
    owner = blocks.block_of_face[faces]
    chosen = np.flatnonzero((slopes > LEVEL) & ~fixed[owner])
    if not len(chosen):
        return NO_TIES
    outwards = np.column_stack([normals[:, :2] / np.where(slopes > 0, slopes, 1.0)[:, None], np.zeros(len(faces))])
    outwards, middles, owner = outwards[chosen], middles[chosen], owner[chosen]
    n = len(chosen)
    greatest = most * loads[chosen] + cohesive * (areas * slopes / normals[:, 2])[chosen]
    return Ties(
        names=tuple(f"{body.name}[{number}]" for number in range(n)),
        forms=(FILL,) * n,
        closed=np.zeros(n, dtype=np.int64),
        start=starts(np.full(n, 2)),
        bodies=np.column_stack([owner, np.full(n, OUTSIDE)]).ravel(),
        places=np.repeat(middles, 2, axis=0),
        pulls=np.stack([outwards, -outwards], axis=1).reshape(-1, 3),
        least=-greatest,
        greatest=-least * loads[chosen],
        prestress=np.zeros(n),
        breaks_at=np.full(n, np.inf),
    )
