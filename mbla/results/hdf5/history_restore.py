"""A structure in time from the content of a result file."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from mbla.results.hdf5.held import held
from mbla.results.quantities.time_history import BASE
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.history import (
    NO_HISTORY,
    HalfStep,
    Peaks,
    PointSpectra,
    RecordedHistories,
    TimeHistoryResult,
)
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows


def history_from(get: dict[str, Any]) -> TimeHistoryResult:
    """From the content below a load case; raises ValueError where that contradicts itself."""
    if "time_history/end" not in get:
        return NO_HISTORY
    own = held(TimeHistoryResult, "time_history", get) | {
        "end": HistoryEnd(get["time_history/end"]),
        "stiffness": tuple(get["time_history/stiffness"].tolist()),
    }
    return TimeHistoryResult(
        **own,
        rows=_steps(get),
        frames=_frames(get),
        histories=_histories(get),
        peaks=_of(Peaks, "peaks", get),
        spectra=_of(PointSpectra, "spectra", get),
        half=_half_step(get),
    )


def _of(kind: type, group: str, get: dict[str, Any]) -> Any:
    """A record whose fields stand in a group of a history; None where they are not there."""
    found = held(kind, f"time_history/{group}", get)
    return kind(**found) if found else None


def _steps(get: dict[str, Any]) -> StepRows | None:
    rows: StepRows | None = _of(StepRows, "steps", get)
    if rows is not None and not len(rows):
        raise ValueError("steps of a time history")
    return rows


def _frames(get: dict[str, Any]) -> Frames | None:
    if "time_history/states/times" not in get:
        return None
    start, points = get["time_history/states/set_start"], held(PointSet, "time_history/states", get)
    sets = tuple(
        PointSet(**{name: values[begin:end] for name, values in points.items()}) for begin, end in pairwise(start)
    )
    frames = Frames(**held(Frames, "time_history/states", get), sets=sets)
    if not len(frames) or not np.isin(frames.set_of_frame, np.arange(len(sets))).all():
        raise ValueError("states of a time history")
    counts = np.diff(start)[frames.set_of_frame]
    if not np.array_equal(np.diff(frames.point_start), counts):
        raise ValueError("points of a time history")
    return frames


def _histories(get: dict[str, Any]) -> RecordedHistories | None:
    if "time_history/record/times" not in get:
        return None
    base = np.stack([get[f"time_history/record/{name}"] for name in BASE], axis=1)
    return RecordedHistories(**held(RecordedHistories, "time_history/record", get), base=base)


def _half_step(get: dict[str, Any]) -> HalfStep | None:
    found = held(HalfStep, "time_history/half_step", get)
    return HalfStep(**found | {"end": HistoryEnd(found["end"])}) if found else None
