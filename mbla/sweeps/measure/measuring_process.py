"""The process that measures: imports everything once, then runs each task in a copy of itself.

Started as ``python -P -m mbla.sweeps.measure.measuring_process``. Each line of JSON on standard input is a task
(``Task``). Answers go to standard output as lines of JSON: ``ready`` once, then for each
task a ``measurement`` of each load case as soon as it is done, the ``end``, and ``gone`` when nothing of the task is
left. A copy (fork) begins with the imports and nothing else, so that no task finds what one before left in memory;
where the system has none, the process ends after its first task. Standard input stays open as long as the parent
lives: its end ends everything here.
"""

from __future__ import annotations

import contextlib
import gc
import importlib
import json
import os
import pkgutil
import select
import signal
from dataclasses import asdict
from typing import IO, Any

from mbla.errors import DeckError, UnfitSolverError, UsageError
from mbla.results.failures import words_of
from mbla.sweeps.measure.measured_run import Task, measure

STAGES = ("deck", "model", "contacts", "program", "solution", "results.collapse")
LATE = ("clarabel", "qdldl", "highspy", "cvxopt", "scipy.sparse.linalg", "scipy.sparse.csgraph", "scipy.spatial")
"""libraries that the stages import when they need them"""
UNFIT = (DeckError, UsageError, UnfitSolverError)
"""errors of a setting that does not apply to the deck, rather than of its run"""
LOOK = 0.02
"""seconds between looks at whether the task is done or the parent gone"""


def main() -> None:
    """Answer tasks until standard input ends; whatever libraries print goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    import_everything()
    gc.freeze()  # what is there now need not be looked through, and copied, by every copy of this process
    _tell(answers, {"ready": True})
    while line := _line():
        task = Task(**json.loads(line))
        if not hasattr(os, "fork"):
            _answer(task, answers)
            _tell(answers, {"gone": 0})
            return
        _answer_in_a_copy(task, answers)


def _line() -> bytes:
    """The next line of standard input, byte by byte: what is read ahead would hide the end from ``select``."""
    line = b""
    while (byte := os.read(0, 1)) not in (b"", b"\n"):
        line += byte
    return line if byte else b""


def import_everything() -> None:
    """Load what the stages may need late, so that neither its time nor its memory is charged to a load case."""
    for stage in STAGES:
        package = importlib.import_module(f"mbla.{stage}")
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            importlib.import_module(module.name)
    for library in LATE:
        with contextlib.suppress(ImportError):  # some are optional
            importlib.import_module(library)


def _answer(task: Task, answers: IO[str]) -> None:
    try:
        for measurement in measure(task):
            _tell(answers, {"measurement": asdict(measurement)})
        _tell(answers, {"end": "done"})
    except Exception as error:
        _, words = words_of(error)
        end = "unfit" if isinstance(error, UNFIT) else "failed"
        _tell(answers, {"end": end, "words": " ".join(words.split())})


def _answer_in_a_copy(task: Task, answers: IO[str]) -> None:
    process = os.fork()
    if process == 0:
        try:
            _answer(task, answers)
        finally:
            os._exit(0)
    while True:
        done, code = os.waitpid(process, os.WNOHANG)
        if done:
            break
        if select.select([0], [], [], LOOK)[0]:  # nothing but the end can come before the task is gone
            os.kill(process, signal.SIGKILL)
            os._exit(1)
    _tell(answers, {"gone": os.waitstatus_to_exitcode(code)})


def _tell(answers: IO[str], record: dict[str, Any]) -> None:
    answers.write(json.dumps(record) + "\n")
    answers.flush()


if __name__ == "__main__":
    main()
