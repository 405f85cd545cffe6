"""What strengthening costs at least.

Virtual work: loads that do more work than the joints dissipate need ties that take the rest, and what these take is no
more than their capacities times the elongations; see :mod:`mbla.program.strengthening`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.lift import motions_of_blocks
from mbla.model.ties.moved import elongations
from mbla.solution.further.strengthening.strengthening import Strengthening
from mbla.solution.verification.case import LoadedModel


def proved_least_cost(
    strengthening: Strengthening, motions: Sequence[FloatArray], forces: Sequence[FloatArray]
) -> float:
    """What capacities cost at least by associative flow, from the mechanisms alone; 0 where they prove nothing.

    Rounding by which joints close is charged with twice the largest normal force.

    motions : of the bodies in each required load case, (n_bodies, 6)
    forces  : of the contact points in each, (n_points, 3) N, compression positive
    """
    unit = strengthening.unit * float(strengthening.costs.mean())
    gain, stretched = 0.0, np.zeros(len(strengthening.costs))
    without = strengthening.without_candidates
    for each, motion, own in zip(strengthening.requirements, motions, forces, strict=True):
        joints = without.of(each.load_case)
        judged = LoadedModel(joints.model, joints.contacts, joints.load_case(each.load_case))
        dissipated, lack = judged.dissipation((motion, None))
        dead, live = judged.powers(motion)
        largest = 2.0 * float(np.abs(own[:, 0]).max(initial=0.0))
        gain += unit * (dead + each.load_factor * live - dissipated - largest * lack)
        on_blocks = motions_of_blocks(joints, motion)
        longer = elongations(strengthening.model.blocks, strengthening.model.ties, on_blocks)[strengthening.first :]
        stretched += unit * np.maximum(longer, 0.0)
    limited = np.isfinite(strengthening.most)
    size = float((stretched / strengthening.costs)[~limited].max(initial=1.0 if limited.any() else 0.0))
    if not size > 0.0:
        return 0.0
    over = np.maximum(stretched / size - strengthening.costs, 0.0)[limited]
    return max(float(gain / size - strengthening.most[limited] @ over), 0.0)
