"""What one run of one load case gave and what it took: plain numbers, so that they go from process to process."""

from __future__ import annotations

import math
from dataclasses import dataclass

NAN = math.nan


@dataclass(frozen=True)
class Measurement:
    """One load case under one setting; nan where there is no figure.

    case        : load case, or the travelling load whose positions are taken together
    series      : travelling load of which this is a position; empty for others
    positions   : load cases taken together
    status      : after verification, as the JSON of a run has it
    verdict     : ``answer`` where there is a figure; else why there is none: the status, or ``locked_in`` where the
                  structure stands only by self-stress
    verified    : verified as sharply as the setting asks for (a draft may be approximate), or that there is no factor
    kind, unit  : of the answer: load factor, angle (degree) or reaction (deck's unit)
    answer      : what the user asks of the case
    least       : size below which differences of answers are relative to this
    accuracy    : what the answer is good to, relatively: the gap of the bounds, or the largest residual
    lower_bound, upper_bound : of associative flow, in the unit of the answer; the static bound and the kinematic one,
                  of a reaction the other way round
    residual    : largest of those that verification recomputes
    range_lower, range_upper : verified ends for the mechanism found, load factors
    dimension   : 2 where it was solved as planar, 3, or 0 where nothing reached a solver
    programs, iterations : of the solver
    solvers     : that took the programs
    wall, cpu   : seconds of assembling, solving and verifying by the clock and by the processor
    solver      : seconds of the programs in it
    preparation : seconds by the clock of reading, building and finding contacts, once for all load cases
    memory      : largest resident size of the process above what it had after its imports, without pages of files,
                  bytes
    repeats     : runs of which the shortest is told
    """

    case: str
    status: str
    verdict: str
    verified: bool
    series: str = ""
    positions: int = 1
    reason: str = ""
    kind: str = "load factor"
    unit: str = ""
    answer: float = NAN
    least: float = 0.0
    accuracy: float = NAN
    lower_bound: float = NAN
    upper_bound: float = NAN
    residual: float = NAN
    range_lower: float = NAN
    range_upper: float = NAN
    dimension: int = 0
    programs: int = 0
    iterations: int = 0
    solvers: str = ""
    wall: float = NAN
    cpu: float = NAN
    solver: float = NAN
    preparation: float = NAN
    memory: float = NAN
    repeats: int = 1
