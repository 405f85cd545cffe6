"""What a reader of a time history must know."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.errors import Message
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.time_history.history import TimeHistoryResult

SOFT = 1e-3
"""Sag over the size of blocks from which the joints are told to be soft."""

COARSE = 20.0
"""Steps in the first period at least."""

ALIKE = 0.02
"""Share by which the greatest displacement may differ with half of the step."""

MISSED = 1e-3
"""Share of the steps that may be missed."""


def history_remarks(history: TimeHistory, structure: PushedStructure, result: TimeHistoryResult) -> tuple[Message, ...]:
    """All of them."""
    return tuple(_remarks(history, structure, result))


def _remarks(history: TimeHistory, structure: PushedStructure, result: TimeHistoryResult) -> Iterator[Message]:
    if result.sag > SOFT * structure.size:
        words = (
            f"the joints give by {result.sag:.2g} under the dead load, more than a thousandth of the size of blocks: "
        )
        yield Message("time-history-soft", words + "their stiffness is low for figures of blocks that hardly deform")
    if history.step > result.period / COARSE:
        words = f"a step of {history.step:g} s is long for the first period of {result.period:.3g} s: vibration of the "
        words += "joints is damped by the step, rocking and sliding are not"
        yield Message("time-history-coarse", words)
    rows, half, peaks = result.rows, result.half, result.peaks
    if rows is not None and rows.missed[-1] > 0:
        share = rows.missed[-1] / max(len(rows) - 1 + int(rows.small_steps[-1]), 1)
        words = f"{rows.missed[-1]} steps ({share:.2g} of all) were not solved even when halved four times: they were "
        yield Message("time-history-missed", words + "taken with the forces of the law and their momentum")
    if half is not None and peaks is not None and peaks.peak > 0.0:
        if half.end is not result.end:
            words = f"with half of the step it ends otherwise: {half.end}"
            yield Message("time-history-depends-on-step", words)
        elif abs(half.peak - peaks.peak) > ALIKE * peaks.peak:
            low, high = sorted((half.peak, peaks.peak))
            words = f"with half of the step the greatest displacement is {half.peak:.4g}: it is known as a range, "
            yield Message("time-history-depends-on-step", words + f"{low:.4g} to {high:.4g}")
