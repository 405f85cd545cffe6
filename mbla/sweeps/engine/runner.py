"""Solve points in this process: what the process of a worker does with each task."""

from __future__ import annotations

import io
import time
from dataclasses import replace
from pathlib import Path

from mbla.deck import read_deck
from mbla.deck.deck import Deck
from mbla.deck.sections.output import OutputSection
from mbla.process.run_options import RunOptions
from mbla.process.sharing import sharing
from mbla.results.failures import words_of
from mbla.results.files import OutputFolder
from mbla.results.records.json_record import results_json
from mbla.results.results import Results
from mbla.results.sta import StatusFile
from mbla.results.write import write_results
from mbla.run import solve_deck
from mbla.sweeps.engine.memory import Memory
from mbla.sweeps.plan import DONE, FAILED, Outcome, Plain, Plan, Task, override_texts
from mbla.sweeps.results import reason_of, result_places, values_of

FOLDER = "points"
"""in the folder of the sweep; one folder for each point in it, by its number"""


def wanted(plan: Plan, state: str) -> bool:
    """Whether the files of a point are kept; one whose deck was refused or whose process died has none."""
    return plan.keep == "all" or (plan.keep == FAILED and state == FAILED)


def keep_files(plan: Plan, task: Task, results: Results, status: str, output: OutputSection) -> None:
    """Write the files that ``mbla run`` would write.

    status : content of the status file
    output : what the deck asks for

    Raises
    ------
    FileError
        they cannot be written
    """
    stem = Path(plan.deck).stem
    with OutputFolder(Path(plan.folder) / FOLDER / str(task.number), stem, force=True) as out:
        out.write_text(f"{stem}.sta", status)
        write_results(results, out, output)


ON_REQUEST = frozenset(
    {
        *("best_iterate", "complete", "factor_unique", "greatest_load_factor", "iterations", "least_load_factor"),
        *(
            "path",
            "peak_load_factor",
            "programs",
            "range",
            "reductions",
            "remarks",
            "settings",
            "solver",
            "spread",
            "time",
        ),
    }
)
"""first keys of columns that need, or may depend on, the range of the load factor or a peak on the way to it"""


def requested_only(deck: Deck, plan: Plan) -> Deck:
    """The deck of a point, without range and peak where no column and no file shows them.

    They are further results on the state that was found (``further_results``), change no other value, and may take
    longer than the state itself.
    """
    if plan.keep != "none" or any(path.partition(".")[0] in ON_REQUEST for path in plan.results):
        return deck
    analysis = deck.analysis.model_copy(update={"range": False, "peak": False})
    return replace(deck, content=deck.content.model_copy(update={"analysis": analysis}))


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
        if not self.plan.shared:
            return self._solve(task)
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
        deck = requested_only(deck, plan)
        status = io.StringIO()
        results = solve_deck(deck, RunOptions(cases=plan.cases), StatusFile(status, deck.title), None, started)
        if wanted(plan, state_of(results.exit_code)):
            keep_files(plan, task, results, status.getvalue(), deck.content.output)
        record = results_json(results, on_demand=True)
        return results.exit_code, reason_of(record), values_of(record, self._places)


def state_of(exit_code: int) -> str:
    """State of a point whose deck would end with this exit code."""
    return DONE if exit_code in ANSWERED else FAILED
