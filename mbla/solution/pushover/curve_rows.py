"""Rows of the curve of a pushover, and why it ends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum


class CurveEnd(StrEnum):
    """Why a pushover ends."""

    NONE = ""
    NOTHING_LEFT = "the load factor is nothing"
    FALLS = "it goes on by itself at that load"
    NOT_CARRIED = "nothing carries it any more"
    REACHED = "the displacement asked for is reached"
    FACTOR_REACHED = "the load factor has fallen to the one asked for"
    STEPS_DONE = "the steps asked for are done"
    BLOCKED = "something blocks its way"
    STUCK = "no forces or no motion were found for the next step"
    LATE = "the time limit was reached"
    STOPPED = "the run was stopped"


@dataclass(frozen=True)
class CurveRow:
    """One row of a pushover, as code that did not solve it finds it from its pose, forces and history.

    step         : from 0, the structure as it starts to move
    displacement : of the control point, m
    load_factor  : that holds the structure there; of a tilting table its angle, rad
    reaction     : of a settling support, N; nan without one
    angle        : of a tilting table, degrees; nan without one
    error        : estimated error of the load factor, from steps of twice the size; nan where that is not known
    residual     : of the law of elastic joints and of balance, the greater; nan of row 0
    overlap      : m, the greatest of blocks
    live_work, friction, tie_work, crushing, potential : J since row 0: work of the live load, dissipated in sliding, by
                   ties and in joints that crush, gained by the dead load
    new_mechanism : whether it has moved there in another way than to the row before
    jumps        : jumps since the row before: no equilibrium was nearby, and it moved in time to its next rest
    unsolved     : rows between it and the row before that were not found
    debris       : blocks that have fallen without the rest
    broken       : ties that have broken, or went with debris
    """

    step: int
    displacement: float
    load_factor: float
    reaction: float
    angle: float
    error: float
    residual: float
    overlap: float
    live_work: float
    friction: float
    tie_work: float
    crushing: float
    potential: float
    new_mechanism: bool
    jumps: int
    unsolved: int
    debris: int
    broken: int

    @property
    def answer(self) -> float:
        """What is asked for: the reaction of a support, the angle of a table in degrees, else the load factor."""
        return next((each for each in (self.reaction, self.angle) if not math.isnan(each)), self.load_factor)
