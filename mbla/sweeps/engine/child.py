"""The process that solves points: imports everything once, then one point after the other.

Started as ``python -P -m mbla.sweeps.engine.child``. Lines of JSON on standard input: the plan, then tasks.
Lines on standard output: ``program`` once everything is imported; ``base``, bytes held with the base deck, or
``refused`` with the words of the error; then for each task its ``outcome``, with the bytes held after it. Standard
input stays open as long as the parent lives: its end ends this process, in the middle of a point too.
"""

from __future__ import annotations

import contextlib
import ctypes
import importlib
import json
import os
import pkgutil
import platform
import queue
import signal
import sys
import threading
import traceback
from pathlib import Path
from typing import IO, Any

from mbla.errors import UsageError
from mbla.process.memory_limit import STATUS, can_limit, limited, written
from mbla.results.failures import words_of
from mbla.sweeps.engine.runner import PointRunner
from mbla.sweeps.identity import fingerprint_of, program_identity
from mbla.sweeps.plan import Plan, plan_of, record_of, task_of

STAGES = ("deck", "model", "contacts", "program", "solution", "results.collapse")
LATE = ("clarabel", "qdldl", "highspy", "cvxopt", "scipy.sparse.linalg", "scipy.sparse.csgraph", "scipy.spatial")
"""libraries that the stages import when they need them; some are optional"""
PR_SET_PDEATHSIG = 1
"""of linux/prctl.h"""


def main() -> None:
    """Answer tasks until standard input ends; whatever libraries print goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    lines: queue.Queue[str] = queue.Queue()
    threading.Thread(target=_listen, args=(lines,), daemon=True).start()
    _die_with_the_parent()
    import_everything()
    _tell(answers, {"program": program_identity()})
    plan = plan_of(json.loads(lines.get()))
    try:
        runner = prepared(plan)
    except Exception as error:
        _tell(answers, {"refused": " ".join(words_of(error)[1].split())})
        return
    most = None if plan.memory_limit is None else written() + plan.memory_limit
    _tell(answers, {"base": resident()})
    while True:
        task = task_of(json.loads(lines.get()))
        with limited(most):
            outcome = runner.run(task)
        _tell(answers, {"outcome": record_of(outcome), "held": resident()})


def import_everything() -> None:
    """Load what the stages may need late, so that neither its time nor its memory is charged to a point."""
    for stage in STAGES:
        package = importlib.import_module(f"mbla.{stage}")
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            importlib.import_module(module.name)
    for library in LATE:
        with contextlib.suppress(ImportError):
            importlib.import_module(library)


def resident() -> float:
    """Bytes that this process holds (VmRSS, proc(5)); 0 where the system does not tell."""
    try:
        lines = STATUS.read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0
    return next((1024.0 * float(line.split()[1]) for line in lines if line.startswith("VmRSS:")), 0.0)


def prepared(plan: Plan) -> PointRunner:
    """What solves the points; UsageError where program or base deck are not those of the plan.

    The deck is read for that, so what reading takes is not charged to the first point.
    """
    if plan.program != program_identity():
        raise UsageError("workers-differ", f"its mbla is {program_identity()}, the sweep was planned by {plan.program}")
    if plan.memory_limit is not None and not can_limit():
        raise UsageError(
            "memory-limit-unknown",
            f"limits.memory: {sys.platform} has no limit on the memory of a process; leave it out",
        )
    if fingerprint_of(Path(plan.deck), plan.fixed) != plan.fingerprint:
        where = f"{plan.deck} on {platform.node()}"
        raise UsageError(
            "deck-changed",
            f"{where} is not the deck that was planned: it, or a file that it names, is another or changed",
        )
    return PointRunner(plan)


def _listen(lines: queue.Queue[str]) -> None:
    """Hand on what the parent says; its end ends everything here, whatever is under way."""
    for line in sys.stdin:
        lines.put(line)
    os._exit(0)


def _die_with_the_parent() -> None:
    """Where the system can: at once, also while a library keeps every thread of Python waiting."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def _tell(answers: IO[str], record: dict[str, Any]) -> None:
    answers.write(json.dumps(record) + "\n")
    answers.flush()


if __name__ == "__main__":
    try:
        main()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    os._exit(0)  # an orderly end would wait for what the listening thread holds
