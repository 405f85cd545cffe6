"""The parent's part: tasks go to a process that measures, answers come back, and it is stopped where time is over."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from types import TracebackType

from mbla.sweeps.engine.line_process import LineProcess
from mbla.sweeps.measure.measured_run import Task
from mbla.sweeps.measure.measurement import Measurement

COMMAND = (sys.executable, "-P", "-m", "mbla.sweeps.measure.measuring_process")


@dataclass(frozen=True)
class ChildRun:
    """What came of a task.

    end   : ``done``; ``failed``, or ``unfit`` where the setting does not apply to the deck, with ``words`` of the
            error; ``stopped`` as its time was over; ``died`` without an answer, with ``words``
    """

    measurements: tuple[Measurement, ...]
    end: str
    words: str = ""


class MeasuringProcess:
    """Context manager; the process is started when first needed, and gone with its copies when the block is left."""

    def __init__(self, command: tuple[str, ...] = COMMAND) -> None:
        self._process = LineProcess(command)

    def __enter__(self) -> MeasuringProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._process.stop()

    def run(
        self,
        task: Task,
        until: float | None = None,
        seconds: float | None = None,
        report: Callable[[Measurement], None] | None = None,
    ) -> ChildRun:
        """Measure one task.

        until   : time.monotonic() at which it is stopped
        seconds : after which it is stopped, not counting the start of the process
        report  : called with each measurement as it comes
        """
        found: list[Measurement] = []
        last: ChildRun | None = None
        process = self._process
        try:
            if not self._ready(until):
                return ChildRun(tuple(found), "died", process.death())
            ends = [time.monotonic() + seconds] if seconds is not None else []
            until = min([*ends, *([] if until is None else [until])], default=None)
            process.send(asdict(task))
            while (record := process.next(until)) is not None:
                if "gone" in record:
                    return last or ChildRun(tuple(found), "died", process.words_of(record["gone"]))
                if "end" in record:
                    last = ChildRun(tuple(found), record["end"], record.get("words", ""))
                    continue
                found.append(Measurement(**record["measurement"]))
                if report is not None:
                    report(found[-1])
            return ChildRun(tuple(found), "died", process.death())
        except TimeoutError:
            process.stop()
            return ChildRun(tuple(found), "stopped")

    def _ready(self, until: float | None) -> bool:
        """Whether it is there with everything imported."""
        if self._process.runs():
            return True
        self._process.start()
        return self._process.next(until) is not None
