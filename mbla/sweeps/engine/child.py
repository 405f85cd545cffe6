"""The process that solves points: imports everything once, then one point after the other.

Started as ``python -P -m mbla.sweeps.engine.child NUMBER``, the number of its end of a pipe. The plan comes first; the
answer is empty, or says why it is refused. Then each task is answered with its outcome. The end of the pipe, when the
parent is gone, ends this process, in the middle of a point too.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import math
import os
import pkgutil
import platform
import queue
import sys
import threading
import time
import traceback
from dataclasses import replace
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from mbla.contacts.known import KnownContacts
from mbla.deck.deck import Deck, deck_of_files
from mbla.deck.sections.assessment import LIMIT_STATES
from mbla.deck.text.include import read_files
from mbla.errors import UsageError
from mbla.process.limits import can_limit, limited, written
from mbla.process.run_options import RunOptions
from mbla.results.failures import words_of
from mbla.results.files import OutputFolder
from mbla.results.record.json_record import results_json
from mbla.results.status_file import StatusFile
from mbla.results.write import write_results
from mbla.run import solve_deck
from mbla.solution.standing.standing import StressFreeStates
from mbla.sweeps.identity import fingerprint_of, program_identity
from mbla.sweeps.plan import DONE, FAILED, Plain, Plan, PointOutcome, Task, override_texts
from mbla.sweeps.results import reason_of, result_places, values_of

STAGES = ("deck", "model", "contacts", "program", "solution", "results.collapse")
LATE = ("clarabel", "qdldl", "cvxopt", "scipy.sparse.linalg", "scipy.sparse.csgraph", "scipy.spatial")
"""libraries that the stages import when they need them; some are optional"""
IDLE = 60.0
"""seconds without a task after which it ends: the client of a worker of a cluster is gone"""


def main() -> None:
    """Answer the plan and tasks until the parent is gone."""
    pipe: Connection[Any, Any] = Connection(int(sys.argv[1]))
    questions: queue.Queue[Any] = queue.Queue()
    threading.Thread(target=_listen, args=(pipe, questions), daemon=True).start()
    import_everything()
    plan: Plan = questions.get()
    try:
        runner = prepared(plan)
    except Exception as error:
        pipe.send(" ".join(words_of(error)[1].split()))
        return
    most = None if plan.memory_limit is None else written() + plan.memory_limit
    pipe.send("")
    with contextlib.suppress(queue.Empty):
        while True:
            task: Task = questions.get(timeout=IDLE)
            with limited(most):
                outcome = runner.run(task)
            pipe.send(outcome)


def _listen(pipe: Connection[Any, Any], questions: queue.Queue[Any]) -> None:
    """Pass on requests of the parent; its end ends everything here, whatever is under way."""
    with contextlib.suppress(EOFError, OSError):
        while True:
            questions.put(pipe.recv())
    os._exit(0)


def import_everything() -> None:
    """Load what the stages may need later, so that neither its time nor its memory is charged to a point."""
    for stage in STAGES:
        package = importlib.import_module(f"mbla.{stage}")
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            importlib.import_module(module.name)
    for library in LATE:
        with contextlib.suppress(ImportError):
            importlib.import_module(library)


def prepared(plan: Plan) -> PointRunner:
    """What solves the points; raises UsageError where program or base deck are not those of the plan.

    The deck is read for that, so what reading takes is not charged to the first point.
    """
    if plan.program != program_identity():
        raise UsageError("workers-differ", f"its mbla is {program_identity()}, the sweep was planned by {plan.program}")
    if plan.memory_limit is not None and not can_limit():
        words = f"limits.memory: {sys.platform} has no limit on the memory of a process; leave it out"
        raise UsageError("memory-limit-unknown", words)
    if fingerprint_of(Path(plan.deck), plan.fixed) != plan.fingerprint:
        where = f"{plan.deck} on {platform.node()}"
        words = f"{where} is not the deck that was planned: it, or a file that it names, is another or changed"
        raise UsageError("deck-changed", words)
    return PointRunner(plan)


# --- points -----------------------------------------------------------------------------------------------------------

ON_REQUEST = (
    *("assessment", "assessment_ratio", *(f"assessment_ratio_{state}" for state in LIMIT_STATES)),
    *("best_iterate", "complete", "iterations", "least_load_factor", "programs", "remarks", "settings", "solver"),
    *("time", "torsion_end", "torsion_load_factor"),
)
"""first keys of columns that need, or may depend on, the least load factor that a search finds, or a second path"""


def requested_only(deck: Deck, plan: Plan) -> Deck:
    """The deck of a point, without a search for lower load factors, and a path with torsion of uniform pressure, where
    no column and no file shows what they find.

    These are further results (``mbla.solution.parts.part``), change no other value, and take longer than the factor.
    """
    if plan.keep != "none" or any(path.partition(".")[0] in ON_REQUEST for path in plan.results):
        return deck
    analysis = deck.analysis.model_copy(update={"search": 0.0, "torsion": False})
    return replace(deck, content=deck.content.model_copy(update={"analysis": analysis}))


REPEATS, SHORT = 3, 1.0
"""runs at most of a point whose time counts, where it takes fewer seconds than that"""
ANSWERED = (0, 5)
"""exit codes with a verified answer for every case: 5 is that there is no load factor"""


def state_of(exit_code: int) -> str:
    """State of a point whose deck would end with this exit code."""
    return DONE if exit_code in ANSWERED else FAILED


class PointRunner:
    """Points of one plan, one after the other.

    The deck is taken as it was when it was first read. States of the stress-free assembly are handed on to the next
    point, as by far the most of what points of one dead load have in common, and so are its contacts.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.states, self.contacts = StressFreeStates(), KnownContacts()
        self._files = read_files(Path(plan.deck))
        self._places = result_places(plan.results, plan.cases)

    def run(self, task: Task) -> PointOutcome:
        """Solve one point; what goes wrong with it is in the outcome."""
        started = time.perf_counter()
        results: dict[str, Plain] = {}
        try:
            code, reason, results = self._shared(task)
        except Exception as error:
            code, reason = words_of(error)
        return PointOutcome(task.key, state_of(code), code, reason, results, 1, time.perf_counter() - started)

    def _shared(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        """Solve it with what earlier points left; without, where that leaves too little memory for this one."""
        if self.plan.timed:
            return self._quickest(task)
        shared = bool(self.states.known)
        try:
            return self._solve(task)
        except MemoryError:
            if not shared:
                raise
        return self._by_itself(task)

    def _quickest(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        """Solve it by itself; of a quick one the shortest of some runs."""
        found = [self._by_itself(task)]
        while len(found) < REPEATS and _seconds(found[0]) < SHORT:
            found.append(self._by_itself(task))
        return min(found, key=_seconds)

    def _by_itself(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        self.states, self.contacts = StressFreeStates(), KnownContacts()
        return self._solve(task)

    def _solve(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        plan, started = self.plan, time.perf_counter()
        overrides = (*plan.fixed, *override_texts(task.settings))
        deck = deck_of_files(Path(plan.deck), self._files, overrides, expected=False)
        deck = requested_only(deck, plan)
        status, stem = io.StringIO(), Path(plan.deck).stem
        status_file = StatusFile(status, deck.title)
        results = solve_deck(deck, RunOptions(cases=plan.cases), status_file, None, started, self.states, self.contacts)
        if plan.keep in ("all", state_of(results.exit_code)):
            with OutputFolder(Path(plan.folder) / "points" / str(task.number), stem, force=True) as out:
                out.write_text(f"{stem}.sta", status.getvalue())
                write_results(results, out, deck.content.output)
        record = results_json(results)
        return results.exit_code, reason_of(record), values_of(record, self._places)


def _seconds(solved: tuple[int, str, dict[str, Plain]]) -> float:
    """Time of all load cases of a point; infinite where there is none."""
    times = [value for name, value in solved[2].items() if name.endswith("time.total")]
    return sum(value for value in times if isinstance(value, float)) or math.inf


if __name__ == "__main__":
    try:
        main()
    except BaseException:
        traceback.print_exc()
        os._exit(1)
    os._exit(0)  # an orderly end would wait for what the listening thread holds
