"""Response spectra of recorded points: what stands on them feels, in the spectra of codes "floor spectra".

A step gives velocities in its middle, and between two of these the mean of the absolute acceleration, exactly: it is
the impulse of the joints and the dead load over the mass. So the velocity of a point and of the base together is taken
as linear in between, which keeps every impulse, that of impacts too. A wave of period T loses by that
1 − (sin(π h/T) / (π h/T))² of its amplitude, 3 % at ten steps: shorter periods are left out.

What stands on a point is followed as long as the structure, and no longer: a point that still moves then would go on at
its velocity. Periods that the history is too short for are left out too.
"""

from __future__ import annotations

import numpy as np

from mbla.model.motion.spectrum import DAMPING, PERIODS, spectral_accelerations
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.history import STEPS_IN_PERIOD, PointSpectra, RecordedHistories


def point_spectra(history: TimeHistory, found: RecordedHistories) -> PointSpectra | None:
    """Of the points that the deck names; None where there are none, or no such periods.

    The base is taken over the same steps, so that a point that moves as the base does has its spectrum.
    """
    periods = PERIODS[STEPS_IN_PERIOD * history.step * (1.0 - 1e-9) <= PERIODS]
    periods = periods[periods <= found.times[-1] * (1.0 + 1e-9)]
    times, n_points = found.velocity_times, len(history.points)
    if not n_points or not len(periods) or len(times) < 2:
        return None
    base = history.base_velocity(times)[:, None]
    velocities = np.concatenate([base, base + found.velocities], axis=1).reshape(len(times), -1)
    means = np.diff(velocities, axis=0) / np.diff(times)[:, None]
    spectra = spectral_accelerations(np.repeat(times, 2)[1:-1], np.repeat(means, 2, axis=0), periods)
    base_first = spectra.reshape(len(periods), 1 + n_points, 3).transpose(1, 0, 2)
    return PointSpectra(periods, DAMPING, base_first[0], base_first[1:])
