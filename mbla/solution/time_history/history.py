"""A time history: what became of a structure in time."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from mbla.arrays import FloatArray
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows

STEPS_IN_PERIOD = 10.0
"""Steps in the shortest period of spectra: there the mean of a step is off by 3 %, and it adds π/10 of damping."""


@dataclass(frozen=True)
class RecordedHistories:
    """At the points and interfaces that the deck names, m instants.

    times         : (m,) s
    velocity_times : (m,) s, instants of the velocities: half of the last step before, which may be a small one
    displacements : (m, n_points, 3) m, relative to the base, from rest
    velocities    : (m, n_points, 3) relative to the base
    accelerations : (m, n_points, 3) absolute, of the base and relative: means since the velocity before,
                    0 at the first instant
    base          : (m, 3, 3) displacement, velocity and acceleration of the base
    openings, slips : (m, n_interfaces) m, the largest between corners of the two bodies that touched as built
    forces        : (m, n_interfaces, 3) sum of the forces on the second body as the deck names them, along x, y, z
    """

    times: FloatArray
    velocity_times: FloatArray
    displacements: FloatArray
    velocities: FloatArray
    accelerations: FloatArray
    base: FloatArray
    openings: FloatArray
    slips: FloatArray
    forces: FloatArray


@dataclass(frozen=True)
class PointSpectra:
    """Response spectra of absolute accelerations along x, y and z: of the base and of the points that the deck names.

    periods : (n,) s, from ten steps to the length of the history
    damping : share of critical damping
    base    : (n, 3) spectral accelerations of the base over the same steps
    points  : (n_points, n, 3)
    """

    periods: FloatArray
    damping: float
    base: FloatArray
    points: FloatArray


@dataclass(frozen=True)
class Peaks:
    """Greatest values over the whole history, from every step.

    displacements : (n_blocks,) m, greatest displacement of the centroid relative to the base, from rest
    times         : (n_blocks,) s, when
    rotations     : (n_blocks,) rad, greatest
    residuals     : (n_blocks,) m, displacement at the end
    ends          : (n_blocks, 6) m, rad, displacements and rotation vectors of the blocks there, from as built
    wanders       : (n_blocks,) m, greatest distance from there over the last tenth of the duration
    openings, slips : (n_interfaces,) m of the interfaces of the assembly, between corners that touched as built
    falling       : (n_blocks,) s when a block has fallen: by half of its height, or tilted by 60 degrees; a cell of
                    soil by half of the height of its soil; else nan
    """

    displacements: FloatArray
    times: FloatArray
    rotations: FloatArray
    residuals: FloatArray
    ends: FloatArray
    wanders: FloatArray
    openings: FloatArray
    slips: FloatArray
    falling: FloatArray

    @property
    def block(self) -> int:
        """The block that is displaced most."""
        return int(self.displacements.argmax())

    @property
    def peak(self) -> float:
        """Its displacement, m."""
        return float(self.displacements.max(initial=0.0))

    @property
    def peak_time(self) -> float:
        """When, s."""
        return float(self.times[self.block])

    @property
    def first_to_fall(self) -> int:
        """The block that has fallen first; −1 where none has."""
        fallen = [number for number, at in enumerate(self.falling) if not math.isnan(at)]
        return min(fallen, key=lambda number: float(self.falling[number]), default=-1)


@dataclass(frozen=True)
class HalfStep:
    """The same history with half of the step: its greatest displacement, its time, residual displacement, and end."""

    peak: float
    time: float
    residual: float
    end: HistoryEnd


@dataclass(frozen=True)
class TimeHistoryResult:
    """What was followed.

    end      : why it ends
    sag      : m, greatest displacement by which the joints give under the dead load
    stiffness : (2,) normal and shear stiffness of the joints, force per volume, mean
    period   : s, first period of the joints that press at rest; nan where it was not needed
    damping  : share of critical damping at that period: what was asked and that of the step, h/2, without those of
               contact points
    rows, frames, histories, peaks : None where the structure does not stand
    spectra  : of points; None where the deck names none, or the history is too short for them
    half     : with half of the step; None where that was not asked for
    searches : searches for contacts
    """

    end: HistoryEnd = HistoryEnd.NONE
    sag: float = math.nan
    stiffness: tuple[float, float] = (math.nan, math.nan)
    period: float = math.nan
    damping: float = math.nan
    rows: StepRows | None = field(default=None, compare=False)
    frames: Frames | None = field(default=None, compare=False)
    histories: RecordedHistories | None = field(default=None, compare=False)
    peaks: Peaks | None = field(default=None, compare=False)
    spectra: PointSpectra | None = field(default=None, compare=False)
    half: HalfStep | None = None
    searches: int = 0
    seconds: float = 0.0


NO_HISTORY = TimeHistoryResult()
