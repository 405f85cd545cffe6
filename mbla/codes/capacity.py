"""What an assessment takes from a result: load factors, kinematic blocks and the capacity curve."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.codes.kinematic_blocks import KinematicBlocks, kinematic_blocks_of
from mbla.results.outcome import least_known, result_of, ultimate_displacement
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from mbla.solution.thresholds import SOLVED_RESIDUAL

LOWER = 1e-6
"""share by which the least load factor that was found lies below that of the state shown where it is another figure"""


@dataclass(frozen=True)
class Capacity:
    """A mechanism that a live load brings about, and how far it can go.

    least, shown : the least load factor that was found, by which everything is assessed, and that of the state shown
    blocks       : kinematic blocks of the state shown
    associative  : whether the load factor is one of associative flow
    crushes      : whether all joints have a compressive strength
    pushed       : whether a pushover was asked for
    curve        : (n, 2) displacement of the control point, load factor; empty without a pushover
    ultimate     : displacement of the control point at which the load factor is nothing; nan where it is not known
    without      : what keeps the curve from a verdict, in words; empty where nothing does
    """

    least: float
    shown: float
    blocks: KinematicBlocks
    associative: bool
    crushes: bool
    pushed: bool
    curve: FloatArray
    ultimate: float
    without: str

    @property
    def differs(self) -> bool:
        """Whether the least load factor is another one than that of the state shown."""
        return self.least < (1.0 - LOWER) * self.shown


def capacity_of(assembly: Assembly, case: CaseResult) -> Capacity | None:
    """That of a load case; None where it has no verified load factor above 0."""
    mechanics, least = result_of(case), least_known(case)
    if mechanics is None or case.status is not Status.SOLVED or not least > 0.0:
        return None
    model, contacts = assembly.model.of_case(case.load_case), assembly.contacts
    laws = [model.joints[contacts.joint_names[number]] for number in np.unique(contacts.joints).tolist()]
    blocks = kinematic_blocks_of(assembly, case.load_case, mechanics)
    rows = [(row.displacement, row.load_factor) for row in case.solution.further.pushover.curve]
    return Capacity(
        least=least,
        shown=mechanics.load_factor,
        blocks=blocks,
        associative=case.solution.flow_rule == "associative",
        crushes=all(np.isfinite(law.compressive_strength) for law in laws),
        pushed=case.load_case.pushover is not None,
        curve=np.array(rows, dtype=float).reshape(-1, 2),
        ultimate=ultimate_displacement(case),
        without="" if case.load_case.pushover is None else _why_no_displacement(case, blocks),
    )


def _why_no_displacement(case: CaseResult, blocks: KinematicBlocks) -> str:
    """What keeps the curve of a pushover from a verdict, in words; empty where nothing does."""
    from mbla.solution.pushover.curve import dropped  # late, as few load cases are pushed

    curve = case.solution.further.pushover.curve
    if math.isnan(ultimate_displacement(case)):
        return "the pushover did not come to where the load factor is nothing"
    if dropped(curve):
        return "blocks drop on the way"
    if any(not row.residual <= SOLVED_RESIDUAL for row in curve[1:]):
        return f"steps of the pushover violate the joint law by more than {SOLVED_RESIDUAL:g}"
    if any(after.displacement <= before.displacement for before, after in pairwise(curve)):
        return "the control point goes back on its way"
    return "the control point does not count along the live load" if math.isnan(blocks.control) else ""
