"""What fill does to blocks that move sideways: a horizontal force on each face that slopes, between two limits.

On a face with the outward normal n, its horizontal part n_h and the column of soil of the volume V over it

    K_a γ V |n_h|/n_z  <=  h  <=  m_p K_p γ V |n_h|/n_z + m_c 2 √K_p c A,    K_p = (1 + sin φ)/(1 − sin φ) = 1/K_a

acts against n_h; V |n_h|/n_z is the integral of the depth over A, the projection onto an upright plane of what of the
face lies below the top. The stress grows with depth: its part acts at the centroid of the face weighted by depth,

    x_p = ∫ d x dA / ∫ d dA,

that of cohesion, which is the same everywhere, at the plain centroid: a strut of its own, of the form cohesion. Where
all of a face moves into the soil, or all of it away, its parts have the same effect as the whole. Where it turns about
a line within itself, one force does not show that soil resists on one side and follows on the other, which is safe.

The soil resists with the upper limit where the face moves into it and follows with the lower one
where it moves away: a strut to the ground. Only a share m_p of the passive pressure, m_c of that of cohesion, is
reached before an arch comes down: peak strengths over-predict (Gilbert et al. 2010). The defaults, φ = 30°, m_p = 0.33
and m_c = 0.01, are those of Grandjean 2010, doi:10.5075/epfl-thesis-4596. The weight of loads on the fill does not
count in the pressure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts, summed
from mbla.deck.sections.fill import Passive
from mbla.errors import Notice
from mbla.model.fill.fill import FillBody, columns
from mbla.model.selectors import BlockSelection
from mbla.model.solids.blocks import Blocks
from mbla.model.ties.ties import COHESION, FILL, OUTSIDE, Ties, joined_ties
from mbla.model.wording import counted

LEVEL = 1e-6
"""horizontal component of the unit normal of a face up to which it is level and has nothing to push against"""


def fill_struts(bodies: Iterable[FillBody], selection: BlockSelection, fixed: BoolArray) -> list[Ties]:
    """Struts of the fills that restrain, on each sloping face of a block that can move; a notice of each fill.

    fixed : (n_blocks,) blocks that do not move
    """
    found = []
    for body in bodies:
        if body.passive is None:
            continue
        struts = _struts(body, body.passive, selection.blocks, fixed)
        found.append(struts)
        least, most = coefficients(body.passive)
        faces = counted(struts.forms.count(FILL), "face")
        words = (
            f"the fill {body.name} pushes on {faces} with {least:.4g} to {most:.4g} times the "
            f"vertical stress: how much of the passive pressure is mobilised, {body.passive.mobilisation:g} here, is a "
            "matter of calibration; vary it"
        )
        selection.remark(Notice("notice", "fill-restrains", words))
    return found


def coefficients(passive: Passive) -> tuple[float, float]:
    """Least and greatest horizontal over vertical stress, K_a and m_p K_p."""
    sine = math.sin(math.radians(passive.friction_angle))
    return (1.0 - sine) / (1.0 + sine), passive.mobilisation * (1.0 + sine) / (1.0 - sine)


def _struts(body: FillBody, passive: Passive, blocks: Blocks, fixed: BoolArray) -> Ties:
    """Struts from what lies outside of the model to faces, of the stress of the soil, then of its cohesion if any."""
    own = columns(body, blocks)
    faces, of_face = np.unique(body.faces[own.rows], return_inverse=True)
    chosen = _pushed(faces, blocks, fixed)
    normals, owner = blocks.face_normals[faces[chosen]], blocks.block_of_face[faces[chosen]]
    slopes = np.hypot(normals[:, 0], normals[:, 1])
    outwards = np.column_stack([normals[:, :2] / slopes[:, None], np.zeros(len(chosen))])
    names = tuple(f"{body.name}[{number}]" for number in range(len(chosen)))

    def resultant(amounts: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Of amounts at places of columns, on the upright projections of faces: their sizes, and where they act."""
        sums = summed(of_face, np.column_stack([amounts, amounts[:, None] * places]), len(faces))[chosen]
        return sums[:, 0] * slopes / normals[:, 2], sums[:, 1:] / sums[:, :1]

    least, most = coefficients(passive)
    depths, pressed = resultant(own.volumes, own.pressed)
    stress = body.unit_weight * depths
    struts = [_pushes(names, FILL, owner, pressed, outwards, most * stress, least * stress)]
    if passive.cohesion > 0.0:
        areas, middles = resultant(own.areas, own.middles)
        cohesive = passive.cohesion_mobilisation * 2.0 * math.sqrt(1.0 / least) * passive.cohesion * areas
        names = tuple(f"{name}.cohesion" for name in names)
        struts.append(_pushes(names, COHESION, owner, middles, outwards, cohesive, 0.0 * areas))
    return joined_ties(struts)


def _pushed(faces: IntArray, blocks: Blocks, fixed: BoolArray) -> IntArray:
    """Positions of faces that slope, of blocks that can move."""
    slopes = np.hypot(*blocks.face_normals[faces, :2].T)
    return np.flatnonzero((slopes > LEVEL) & ~fixed[blocks.block_of_face[faces]])


def _pushes(
    names: tuple[str, ...],
    form: str,
    owner: IntArray,
    places: FloatArray,
    outwards: FloatArray,
    passive: FloatArray,
    active: FloatArray,
) -> Ties:
    """Struts to what does not move, (n,), both ends at one place; ``active`` and ``passive`` pushes are positive."""
    n = len(names)
    return Ties(
        names=names,
        forms=(form,) * n,
        closed=np.zeros(n, dtype=np.int64),
        start=starts(np.full(n, 2)),
        bodies=np.column_stack([owner, np.full(n, OUTSIDE)]).ravel(),
        places=np.repeat(places, 2, axis=0),
        pulls=np.stack([outwards, -outwards], axis=1).reshape(-1, 3),
        least=-passive,
        greatest=-active,
        prestress=np.zeros(n),
        breaks_at=np.full(n, np.inf),
    )
