"""What a time history is about: motion of the base, forces over time, and what is recorded of the answer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mbla.arrays import FloatArray, IntArray
from mbla.model.motion.signal import Signal


@dataclass(frozen=True)
class BaseMotion:
    """Acceleration of the base along a direction.

    words     : in words, for the listing
    signal    : acceleration, in the deck's unit of length per s2
    direction : (3,) unit
    source    : name of its file in the deck; empty of a pulse
    """

    words: str
    signal: Signal
    direction: FloatArray
    source: str = ""

    @property
    def peak_acceleration(self) -> float:
        """Length/s2."""
        return self.signal.peak

    @property
    def peak_velocity(self) -> float:
        """Length/s."""
        return self.signal.peak_integral

    @property
    def peak_displacement(self) -> float:
        """Up to the end of the motion."""
        return self.signal.peak_second_integral


@dataclass(frozen=True)
class ForceHistory:
    """A force over time.

    words    : in words, for the listing
    signal   : force
    wrenches : (n_blocks, 15) of a unit force, as those of ``AppliedLoad``; it keeps its direction
    source   : name of its file in the deck
    """

    words: str
    signal: Signal
    wrenches: FloatArray
    source: str = ""


@dataclass(frozen=True)
class RecordedPoint:
    """A point whose motion is kept.

    block : that it moves with
    point : (3,) as built
    """

    name: str
    block: int
    point: FloatArray


@dataclass(frozen=True)
class RecordedInterface:
    """What is kept of all interfaces between two bodies.

    bodies : (2,) of the model, as the deck names them: blocks, then grounds; forces are those on the second
    """

    name: str
    bodies: IntArray


@dataclass(frozen=True)
class TimeHistory:
    """Base motion and forces over time, how they are followed, and what is kept.

    Without motions and forces what the structure does is its fall, or rest. Base motion acts in the frame of the base:
    a block of mass m feels −m times the change of base velocity.

    step, duration    : s
    damping           : of joints, as a share of critical damping at the first period
    contact_damping   : of what a point and the masses at it do by themselves, as a share of critical damping
    every             : s, between states that are kept
    stop_displacement : of a block, at which it ends; inf: none
    stop_at_rest      : it ends where motion and blocks are at rest
    stop_at_collapse  : it ends where a block has fallen
    rigid             : blocks of each kinematic block, which move as one body; ascending
    check             : whether it is made once more, with half of the step
    dead_levers       : (n_blocks, 9) sums of arm times force of dead loads that keep their direction
    dead_following    : (n_blocks, 6) the part of the dead loads that turns with its block
    """

    motions: tuple[BaseMotion, ...]
    forces: tuple[ForceHistory, ...]
    step: float
    duration: float
    damping: float
    contact_damping: float
    every: float
    points: tuple[RecordedPoint, ...]
    interfaces: tuple[RecordedInterface, ...]
    stop_displacement: float
    stop_at_rest: bool
    rigid: tuple[IntArray, ...]
    check: bool
    dead_levers: FloatArray
    dead_following: FloatArray
    stop_at_collapse: bool = True

    @property
    def drivers(self) -> tuple[BaseMotion | ForceHistory, ...]:
        """What drives the structure: motions, then forces."""
        return (*self.motions, *self.forces)

    def base_acceleration(self, time: ArrayLike) -> FloatArray:
        """At times of any shape (...), (..., 3)."""
        return self._sum([motion.signal.value(time) for motion in self.motions], time)

    def base_velocity(self, time: ArrayLike) -> FloatArray:
        """At times of any shape (...), (..., 3); zero at first, and exact."""
        return self._sum([motion.signal.integral(time) for motion in self.motions], time)

    def base_displacement(self, time: ArrayLike) -> FloatArray:
        """At times of any shape (...), (..., 3); zero at first, and exact."""
        return self._sum([motion.signal.second_integral(time) for motion in self.motions], time)

    def _sum(self, values: list[FloatArray], time: ArrayLike) -> FloatArray:
        total = np.zeros((*np.shape(time), 3))
        for motion, value in zip(self.motions, values, strict=True):
            total += value[..., None] * motion.direction
        return total
