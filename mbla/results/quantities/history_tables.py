"""Histories of points and interfaces in long form, as spreadsheets filter and pandas groups them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.quantities.group import Group
from mbla.results.record.scene import Scene, Values, as_text
from mbla.solution.time_history.history import RecordedHistories

BASE_NAME = "base"
"""what the motion of the base is called among the points"""


@dataclass(frozen=True)
class PointHistories:
    """Histories of points, instant by instant: the base first, then the points that the deck names."""

    names: list[str]
    found: RecordedHistories

    def relative(self, values: FloatArray) -> FloatArray:
        """(m, n_points, 3) of the points, and nothing of the base: (m (n_points + 1), 3)."""
        return np.concatenate([np.zeros((len(values), 1, 3)), values], axis=1).reshape(-1, 3)

    def absolute(self, values: FloatArray, base: int) -> FloatArray:
        """(m, n_points, 3) of the points and those of the base: displacement 0, velocity 1, acceleration 2."""
        return np.concatenate([self.found.base[:, None, base], values], axis=1).reshape(-1, 3)

    @property
    def count(self) -> int:
        """Rows."""
        return len(self.found.times) * (len(self.names) + 1)


def point_histories(scene: Scene) -> PointHistories | None:
    """Of a load case that was followed in time."""
    found, asked = scene.solved.solution.further.time_history.histories, scene.solved.load_case.time_history
    return None if found is None or asked is None else PointHistories([each.name for each in asked.points], found)


POINTS_IN_TIME = Group[PointHistories](point_histories, files="table", table="history")


@POINTS_IN_TIME.quantity(dims="row", unit="time")
def time(of: PointHistories) -> FloatArray:
    """Since the beginning."""
    return np.repeat(of.found.times, len(of.names) + 1)


@POINTS_IN_TIME.quantity(dims="row")
def point(of: PointHistories) -> Values:
    """Point that the deck names, or the base."""
    return as_text([BASE_NAME, *of.names] * len(of.found.times))


@POINTS_IN_TIME.quantity(dims="row axis", unit="length")
def displacement(of: PointHistories) -> FloatArray:
    """Relative to the base, since rest."""
    return of.relative(of.found.displacements)


@POINTS_IN_TIME.quantity(dims="row", unit="time")
def velocity_time(of: PointHistories) -> FloatArray:
    """Of the velocity: the middle of the last step."""
    return np.repeat(of.found.velocity_times, len(of.names) + 1)


@POINTS_IN_TIME.quantity(dims="row axis", unit="speed")
def velocity(of: PointHistories) -> FloatArray:
    """Relative to the base, in the middle of the last step."""
    return of.relative(of.found.velocities)


@POINTS_IN_TIME.quantity(dims="row axis", unit="length")
def absolute_displacement(of: PointHistories) -> FloatArray:
    """With that of the base."""
    return of.absolute(of.found.displacements + of.found.base[:, None, 0], 0)


@POINTS_IN_TIME.quantity(dims="row axis", unit="acceleration")
def absolute_acceleration(of: PointHistories) -> FloatArray:
    """With that of the base; of points the mean since the middle of the step before the last, small ones as well."""
    return of.absolute(of.found.accelerations, 2)


@dataclass(frozen=True)
class InterfaceHistories:
    """Histories of the interfaces that the deck names, instant by instant."""

    names: list[str]
    found: RecordedHistories

    @property
    def count(self) -> int:
        """Rows."""
        return len(self.found.times) * len(self.names)


def interface_histories(scene: Scene) -> InterfaceHistories | None:
    """Of a load case that was followed in time."""
    found, asked = scene.solved.solution.further.time_history.histories, scene.solved.load_case.time_history
    if found is None or asked is None:
        return None
    return InterfaceHistories([each.name for each in asked.interfaces], found)


INTERFACES_IN_TIME = Group[InterfaceHistories](interface_histories, files="table", table="history_interfaces")


@INTERFACES_IN_TIME.quantity(dims="row", unit="time", name="time")
def time_of_interface(of: InterfaceHistories) -> FloatArray:
    """Since the beginning."""
    return np.repeat(of.found.times, len(of.names))


@INTERFACES_IN_TIME.quantity(dims="row")
def interface(of: InterfaceHistories) -> Values:
    """That the deck names: all interfaces between two bodies."""
    return as_text(of.names * len(of.found.times))


@INTERFACES_IN_TIME.quantity(dims="row", unit="length")
def opening(of: InterfaceHistories) -> FloatArray:
    """Greatest of its points; overlap is negative."""
    return of.found.openings.ravel()


@INTERFACES_IN_TIME.quantity(dims="row", unit="length")
def slip(of: InterfaceHistories) -> FloatArray:
    """Greatest of its points."""
    return of.found.slips.ravel()


@INTERFACES_IN_TIME.quantity(dims="row axis", unit="force")
def force(of: InterfaceHistories) -> FloatArray:
    """On its second body as the deck names them, the sum over its points."""
    return of.found.forces.reshape(-1, 3)
