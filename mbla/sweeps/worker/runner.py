"""Solve points in this process: what the process of a worker does with each task."""

from __future__ import annotations

import io
import time
from pathlib import Path

from mbla.deck import read_deck
from mbla.process.sharing import sharing
from mbla.results.failures import words_of
from mbla.results.records.json_record import results_json
from mbla.results.sta import StatusFile
from mbla.run import solve_deck, title_of
from mbla.run_options import RunOptions
from mbla.sweeps.plan import DONE, FAILED, Outcome, Plain, Plan, Task, override_texts
from mbla.sweeps.results import reason_of, result_places, values_of
from mbla.sweeps.worker.asked import with_what_is_asked
from mbla.sweeps.worker.kept import keep_files, wanted
from mbla.sweeps.worker.memory import Memory

ANSWERED = (0, 5)
"""exit codes with a verified answer for every case: 5 is that there is no load factor"""


class PointRunner:
    """Points of one plan, one after the other.

    What points have in common is worked out once: ``memory``. Files that the deck names are taken as they were when
    they were first read.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.memory = Memory()
        self._places = result_places(plan.results, plan.cases)

    def run(self, task: Task) -> Outcome:
        """Solve one point; what goes wrong with it is in the outcome."""
        started = time.perf_counter()
        results: dict[str, Plain] = {}
        try:
            code, reason, results = self._shared(task)
        except Exception as error:
            code, reason = words_of(error)
        return Outcome(task.key, state_of(code), code, reason, results, 1, time.perf_counter() - started)

    def _shared(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        """Solve it with what earlier points left; without, where that leaves too little memory for this one."""
        try:
            with sharing(self.memory):
                return self._solve(task)
        except MemoryError:
            if not len(self.memory):
                raise
        self.memory = Memory()
        with sharing(self.memory):
            return self._solve(task)

    def _solve(self, task: Task) -> tuple[int, str, dict[str, Plain]]:
        plan, started = self.plan, time.perf_counter()
        deck = read_deck(Path(plan.deck), (*plan.fixed, *override_texts(task.settings)), expected=False)
        deck = with_what_is_asked(deck, plan)
        status = io.StringIO()
        results = solve_deck(deck, RunOptions(cases=plan.cases), StatusFile(status, title_of(deck)), None, started)
        if wanted(plan, state_of(results.exit_code)):
            keep_files(plan, task, results, status.getvalue(), deck.content.output)
        record = results_json(results, on_demand=True)
        return results.exit_code, reason_of(record), values_of(record, self._places)


def state_of(exit_code: int) -> str:
    """State of a point whose deck would end with this exit code."""
    return DONE if exit_code in ANSWERED else FAILED
