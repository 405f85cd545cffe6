"""Integrals of records for the verification: a record is linear between its samples, nothing before and after them.

Over a part of one stretch the integral is its length times the value in its middle, and that of a product with what is
linear in time follows from begin, middle and end (Simpson, exact). Where two samples have one time the stretch between
them has no length.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import TimeHistory

AT_ONCE = 200
"""instants whose stretches are held at a time"""


def base_changes(history: TimeHistory, begins: FloatArray, ends: FloatArray) -> FloatArray:
    """By how much the velocity of the base changes from instants to others, (n, 3)."""
    total = np.zeros((len(begins), 3))
    for motion in history.motions:
        total += integrals(motion.signal, begins, ends)[:, None] * motion.direction
    return total


def base_displacements(history: TimeHistory, times: FloatArray) -> FloatArray:
    """Displacement of the base at instants, (n, 3): the integral of acceleration times the time since."""
    total = np.zeros((len(times), 3))
    for motion in history.motions:
        total += integrals(motion.signal, np.full(len(times), -np.inf), times, since=True)[:, None] * motion.direction
    return total


def integrals(signal: Signal, begins: FloatArray, ends: FloatArray, *, since: bool = False) -> FloatArray:
    """Of a record from instants to others, (n,); with ``since`` of its product with the time left to the end."""
    first, last = signal.times[:-1], signal.times[1:]
    lengths = np.where(last > first, last - first, 1.0)
    found = np.zeros(len(begins))
    for row in range(0, len(begins), AT_ONCE):
        own = slice(row, row + AT_ONCE)
        end = ends[own, None]
        low = np.clip(begins[own, None], first, last)
        high = np.maximum(np.clip(end, first, last), low)
        values = []
        for at in (low, (low + high) / 2.0, high):
            share = (at - first) / lengths
            value = signal.values[:-1] * (1.0 - share) + signal.values[1:] * share
            values.append(value * (end - at) if since else value)
        found[own] = ((high - low) * (values[0] + 4.0 * values[1] + values[2]) / 6.0).sum(axis=1)
    return found
