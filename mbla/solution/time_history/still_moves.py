"""Whether a structure still moves far where its time history ends: then nothing is known of whether it falls later."""

from __future__ import annotations

from mbla.model.model import Model
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd

FAR = 1e-3
"""of the size of the block that moves most: what moves less than that stands"""
KINETIC = 1e-3
"""of the greatest kinetic energy of the history, at its end: three hundredths of the greatest velocity"""
TURNING = 0.1
"""of the peak, by which displacements at the end still vary: where a block turns back it has no kinetic energy"""
PUSHED_ON = 1e-3
"""of the peak, by which displacements at the end vary where the peak is reached in the last step: that goes on slowly,
as beyond an unstable equilibrium, while what has come to rest does not"""
STILL_MOVES = "it still moves at its end: whether it falls later is not known"


def still_moves(model: Model, found: TimeHistoryResult) -> bool:
    """Whether it ends by its duration, nothing has fallen, and what moved far has not come to rest.

    Far is more than ``FAR`` of the size of the block that moves most. It has not come to rest where at the last row the
    kinetic energy is above ``KINETIC`` of the greatest, where displacements in the last tenth vary by more than
    ``TURNING`` of the peak, or where the peak is reached in the last step and they vary by more than ``PUSHED_ON``.
    """
    rows, peaks = found.rows, found.peaks
    if found.end is not HistoryEnd.DURATION or rows is None or peaks is None or len(rows) < 2:
        return False
    if peaks.first_to_fall >= 0 or not peaks.peak > FAR * float(model.blocks.sizes[peaks.block]):
        return False
    varies = float(peaks.wanders.max()) / peaks.peak
    goes_on = peaks.peak_time > rows.times[-2] and varies > PUSHED_ON
    return bool(goes_on or varies > TURNING or rows.kinetic[-1] > KINETIC * rows.kinetic.max())
