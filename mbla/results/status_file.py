"""The ``.sta`` file: one fixed-column line per iteration, written and flushed while the analysis runs.

``tail -f arch.sta`` follows it. It stands under its final name from the start; an earlier one is put aside and comes
back if the run fails (see :mod:`mbla.results.files`).
"""

from __future__ import annotations

from typing import TextIO

from mbla.errors import FileError
from mbla.solution.solution import IterationRecord
from mbla.solution.time_history.progress import TimeProgress

HEADER = (
    f"{'case':<24} {'program':>7} {'iteration':>9} {'load_factor':>15} {'gap':>10} {'primal':>10} {'dual':>10} "
    f"{'step':>8} {'seconds':>9}"
)


def status_line(case: str, record: IterationRecord) -> str:
    """One line, in the columns of ``HEADER``; numbers that there are not yet are written as ``nan``."""
    return (
        f"{case:<24} {record.program:>7d} {record.iteration:>9d} {record.load_factor:>15.8e} {record.gap:>10.2e} "
        f"{record.primal_residual:>10.2e} {record.dual_residual:>10.2e} {record.step:>8.1e} {record.seconds:>9.3f}"
    )


HISTORY_HEADER = (
    f"# {'case':<22} {'time':>12} {'step':>9} {'newton':>9} {'residual':>10} {'balance':>10} {'pressing':>8} "
    f"{'halved':>7} {'missed':>7} {'seconds':>9}"
)
"""of steps in time; newton are factorisations so far, as are halved and missed; balance is what energies lack"""

HALF = "/half"
"""behind the name of a case that is followed with half of the step"""


def history_line(case: str, step: TimeProgress) -> str:
    """One line, in the columns of ``HISTORY_HEADER``."""
    return (
        f"{case:<24} {step.time:>12.6f} {step.step:>9d} {step.factorisations:>9d} {step.residual:>10.2e} "
        f"{step.balance:>10.2e} {step.pressing:>8d} {step.halved:>7d} {step.missed:>7d} {step.seconds:>9.3f}"
    )


class StatusFile:
    """Writes the lines; ``StatusFile(out.open_live("arch.sta"), title)`` inside an OutputFolder."""

    def __init__(self, stream: TextIO, title: str) -> None:
        self._stream = stream
        self._in_time = ""
        self._write(f"# mbla status file: {title}")
        self._write(HEADER)

    def add(self, case: str, record: IterationRecord | TimeProgress) -> None:
        """Append one iteration, or one step in time; FileError if the disk refuses."""
        if isinstance(record, IterationRecord):
            self._write(status_line(case, record))
            return
        case = f"{case}{HALF}" if record.half else case
        if case != self._in_time:
            self._in_time = case
            self._write(HISTORY_HEADER)
        self._write(history_line(case, record))

    def remark(self, text: str) -> None:
        """Append a comment line, as at the end of a case."""
        self._write(f"# {text}")

    def _write(self, line: str) -> None:
        try:
            self._stream.write(" ".join(line.splitlines()) + "\n")
            self._stream.flush()
        except OSError as error:
            raise FileError("file-not-written", f"{self._stream.name}: {error.strerror or error}") from error
