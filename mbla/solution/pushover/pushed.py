"""What a pushover leaves: its steps, the rows of its curve, and why it ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.pose import Pose


class CurveEnd(StrEnum):
    """Why a pushover ends."""

    NONE = ""
    NOTHING_LEFT = "the load factor is nothing"
    FALLS = "it goes on by itself at that load"
    NOT_CARRIED = "nothing carries it any more"
    REACHED = "the displacement asked for is reached"
    STEPS_DONE = "the steps asked for are done"
    BLOCKED = "something blocks its way"
    DEEP = "blocks overlap, however short the step"
    STUCK = "no forces or no motion were found for the next step"
    LATE = "the time limit was reached"
    STOPPED = "the run was stopped"


@dataclass(frozen=True)
class CurveRow:
    """One step of a pushover, as code that did not solve it finds it from its forces and mechanism.

    step         : from 0, limit analysis of the structure as built
    displacement : of the control point, m
    load_factor  : that holds the structure there
    reaction     : of a support that gives way, N; nan without one
    error        : estimated error of the load factor, from steps of twice the size; nan where that is not known
    residual     : of the joint law, the greatest measure of the verification
    overlap      : m, the greatest of blocks
    live_work, friction, tie_work, potential : J since the first step: work of the live load, dissipated in sliding and
                   by ties, gained by the dead load
    new_mechanism : whether it moves in another way than the step before
    debris       : blocks that have fallen without the rest
    broken       : ties that have broken, or went with debris
    """

    step: int
    displacement: float
    load_factor: float
    reaction: float
    error: float
    residual: float
    overlap: float
    live_work: float
    friction: float
    tie_work: float
    potential: float
    new_mechanism: bool
    debris: int
    broken: int


@dataclass(frozen=True)
class PushedSteps:
    """What the rows of a pushover follow from: its loads, mechanisms and forces, step by step, limit analysis first.

    work         : (n_steps,) live work of the step that led there
    scale        : (n_steps,) live work for which it was solved: the gaps there close by no more in it; inf at first
    load_factors : (n_steps,)
    mechanisms   : (n_steps, n_blocks, 6) for a live power of 1
    fallen       : (n_steps, n_blocks) blocks that are debris
    point_start  : (n_steps + 1,) contact points of step k are rows point_start[k]:point_start[k + 1] of
    forces       : (n, 3) N, T1, T2 [N] at the contact points of the moved blocks
    errors       : (n_steps,) estimated error of the load factor, nan where it is not known
    """

    work: FloatArray
    scale: FloatArray
    load_factors: FloatArray
    mechanisms: FloatArray
    fallen: BoolArray
    point_start: IntArray
    forces: FloatArray
    errors: FloatArray

    def __len__(self) -> int:
        return len(self.work)

    @property
    def poses(self) -> Iterator[Pose]:
        """Where the blocks are at every step, from its mechanisms."""
        pose = Pose.at_rest(self.mechanisms.shape[1])
        yield pose
        for work, mechanism in zip(self.work[1:], self.mechanisms[:-1], strict=True):
            pose = pose.after(work * mechanism)
            yield pose
