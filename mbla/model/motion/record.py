"""Values over time in a file: columns of text with times, or a record of PEER."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.model.tables import TableRefused
from mbla.model.wording import counted

LONGEST, LARGEST = 1e7, 1e30
"""s, and in any unit, of what can be computed with: three months"""


@dataclass(frozen=True)
class Record:
    """Values over time as a file has them.

    times  : (n,) s, from 0, none before the one that it follows; n at least 2
    values : (n, k) in the unit of the file
    unit   : that its header names, of PEER alone; empty
    """

    file: str
    times: FloatArray
    values: FloatArray
    unit: str = ""

    @property
    def steps(self) -> FloatArray:
        """Between times that differ, (m,) s."""
        steps = np.diff(self.times)
        return np.asarray(steps[steps > 0.0])

    @property
    def jumps(self) -> int:
        """Times that are there twice, with another value."""
        again = np.diff(self.times) <= 0.0
        return int((again & (np.diff(self.values, axis=0) != 0.0).any(axis=1)).sum())


def refused(*faults: str) -> TableRefused:
    """The file cannot be used, for these reasons with its name and their lines."""
    return TableRefused(*(Message("record-refused", fault) for fault in faults))


def checked(path: Path, times: FloatArray, values: FloatArray, lines: Sequence[int], unit: str = "") -> Record:
    """The record, its times from 0; ``lines`` (n,) in which they stand.

    Raises TableRefused for fewer than two samples, times that fall or stay the same, and values that are all zero.
    """
    name = path.name
    if len(times) < 2:
        raise refused(f"{name}: has {counted(len(times), 'row')} with numbers: a line takes two at least")
    falls = np.flatnonzero(np.diff(times) < 0.0)
    if len(falls):
        row = int(falls[0])
        words = f"{name}:{lines[row + 1]}: the time {times[row + 1]:g} comes after {times[row]:g}: times must not fall"
        raise refused(words + (f"; {len(falls) - 1} more do" if len(falls) > 1 else ""))
    if not times[-1] > times[0]:
        raise refused(f"{name}: every time is {times[0]:g}: name the column of times first")
    if times[-1] - times[0] > LONGEST:
        raise refused(f"{name}: lasts {times[-1] - times[0]:.2g} s: times are in seconds")
    if np.abs(values).max() > LARGEST:
        raise refused(f"{name}: its values reach {np.abs(values).max():.1e}, which no unit makes a motion or a force")
    if not values.any():
        raise refused(f"{name}: every value is 0: nothing moves; name the column of values")
    return Record(name, times - times[0], values, unit)
