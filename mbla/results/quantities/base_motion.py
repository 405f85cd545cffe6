"""What a structure is followed in time under: motion of the base, forces over time, and what of it is kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import TimeHistory
from mbla.results.quantities.group import Field, Group

ASKED = Group[TimeHistory](
    lambda scene: scene.load_case.time_history, file="cases/*/base_motion", asked=True, part="base motion"
)
ASKED.fields(
    TimeHistory,
    step=Field("length of a step", unit="time"),
    duration=Field("at most", unit="time"),
    damping=Field("of joints, share of critical damping at the first period"),
    contact_damping=Field("of a point and the masses at it, share of critical damping"),
    every=Field("between states that are kept", unit="time"),
    stop_displacement=Field("of a block, at which it ends; inf: none", unit="length", rule="open"),
    stop_at_rest=Field("1 where it ends as soon as all is at rest"),
    stop_at_collapse=Field("1 where it ends as soon as a block has fallen"),
    check=Field("1 where it is followed with half of the step as well"),
)


@ASKED.quantity(dims="motion")
def motion_words(asked: TimeHistory) -> list[str]:
    """Motions of the base, in words."""
    return [motion.words for motion in asked.motions]


@ASKED.quantity(dims="motion axis")
def motion_directions(asked: TimeHistory) -> FloatArray:
    """Unit vector of each."""
    return np.array([motion.direction for motion in asked.motions]).reshape(-1, 3)


@ASKED.quantity(dims="force")
def force_words(asked: TimeHistory) -> list[str]:
    """Forces over time, in words."""
    return [force.words for force in asked.forces]


def _declare_signals(name: str, values: str, unit: str, of: Callable[[TimeHistory], Sequence[Signal]]) -> None:
    """Signals, one after the other: where each begins, times and values, linear in between."""

    def signal_start(asked: TimeHistory) -> IntArray:
        return starts(np.array([len(signal.times) for signal in of(asked)], dtype=np.int64))

    def times(asked: TimeHistory) -> FloatArray:
        return np.concatenate([np.zeros(0), *(signal.times for signal in of(asked))])

    def samples(asked: TimeHistory) -> FloatArray:
        return np.concatenate([np.zeros(0), *(signal.values for signal in of(asked))])

    start, sample = f"{name}_start", f"{name}_sample"
    words = f"first sample of each {name}"
    ASKED.quantity(name=start, words=words, dims=f"{name}_bound", rule=f"start of {sample}")(signal_start)
    ASKED.quantity(name=f"{name}_times", words="time of a sample", dims=sample, unit="time")(times)
    words = f"{values}, linear in between, zero before the first sample and after the last"
    ASKED.quantity(name=f"{name}_{values}", words=words, dims=sample, unit=unit)(samples)


_declare_signals("motion", "accelerations", "acceleration", lambda asked: [each.signal for each in asked.motions])
_declare_signals("force", "values", "force", lambda asked: [each.signal for each in asked.forces])


@ASKED.quantity(dims="recorded_point")
def point_names(asked: TimeHistory) -> list[str]:
    """Points whose histories are kept."""
    return [point.name for point in asked.points]


@ASKED.quantity(dims="recorded_point", rule="index of block")
def point_blocks(asked: TimeHistory) -> IntArray:
    """Block that each moves with."""
    return np.array([point.block for point in asked.points], dtype=np.int64)


@ASKED.quantity(dims="recorded_point axis", unit="length")
def points(asked: TimeHistory) -> FloatArray:
    """Where they are as built."""
    return np.array([point.point for point in asked.points]).reshape(-1, 3)


@ASKED.quantity(dims="recorded_interface")
def interface_names(asked: TimeHistory) -> list[str]:
    """Interfaces whose histories are kept: all those between two bodies are one."""
    return [interface.name for interface in asked.interfaces]


@ASKED.quantity(dims="recorded_interface pair", rule="index of body")
def interface_bodies(asked: TimeHistory) -> IntArray:
    """The two bodies, as the deck names them."""
    return np.array([interface.bodies for interface in asked.interfaces], dtype=np.int64).reshape(-1, 2)


@ASKED.quantity(dims="kinematic_bound", rule="start of kinematic_block")
def rigid_start(asked: TimeHistory) -> IntArray:
    """First block of each set of blocks that moves as one body."""
    return starts(np.array([len(blocks) for blocks in asked.rigid], dtype=np.int64))


@ASKED.quantity(dims="kinematic_block", rule="index of block")
def rigid_blocks(asked: TimeHistory) -> IntArray:
    """Their blocks."""
    return np.concatenate([np.zeros(0, dtype=np.int64), *asked.rigid])
