"""Run the rungs one after the other, each in a process of its own, within a budget."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.results.failures import SIGNALS, words_of
from mbla.sweeps.measure.measured_run import Task
from mbla.sweeps.measure.measurement import Measurement
from mbla.sweeps.measure.measuring import ChildRun, MeasuringProcess
from mbla.sweeps.tradeoff.rung import Rung

Report = Callable[[int, int, str, str], None]
"""called with number of the rung from 1, number of rungs, name of the rung, and load case done (empty: it begins)"""
LEAST_TIME = 0.5
"""seconds of a budget below which no further process is started: it would not get past its imports"""


@dataclass(frozen=True)
class Limits:
    """Seconds for all rungs together and for each of them; None: no limit. Threads of each."""

    budget: float | None = None
    each: float | None = None
    threads: int = 1


@dataclass(frozen=True)
class RungRun:
    """What became of a rung.

    end     : ``done``; ``unfit``: does not apply; ``failed``; ``died``; ``stopped``: ran out of its time; ``not run``;
              ``interrupted``, ``terminated``: a signal came, then or before
    words   : why, for every end but ``done``
    expired : the budget of all rungs ended it, or left no time to begin it
    """

    rung: Rung
    measurements: tuple[Measurement, ...]
    end: str
    words: str = ""
    expired: bool = False


def run_ladder(
    deck: Path, fixed: Sequence[str], cases: Sequence[str], rungs: Sequence[Rung], limits: Limits, report: Report | None
) -> list[RungRun]:
    """One run for each rung, in their order; a signal ends them, and is told of each left.

    Raises KeyboardInterrupt or Terminated where nothing was measured before it.
    """
    until = None if limits.budget is None else time.monotonic() + limits.budget
    runs: list[RungRun] = []
    with MeasuringProcess() as process:
        try:
            for number, rung in enumerate(rungs, 1):
                setting = rung.setting
                task = Task(str(deck.resolve()), tuple(fixed), setting.overrides, setting.freed, tuple(cases))

                def done(case: str, number: int = number, name: str = rung.name) -> None:
                    if report is not None:
                        report(number, len(rungs), name, case)

                planar = any(_is_planar(run) for run in runs)
                runs.append(_run(process, rung, task, until, limits, done, planar=planar))
        except tuple(SIGNALS) as error:
            if not any(run.measurements for run in runs):
                raise
            left, (_, end) = rungs[len(runs) :], words_of(error)
            runs += [RungRun(rung, (), end, f"{end} before its end") for rung in left[:1]]
            runs += [RungRun(rung, (), end, f"not run: {end} before") for rung in left[1:]]
    return runs


def _run(
    process: MeasuringProcess,
    rung: Rung,
    task: Task,
    until: float | None,
    limits: Limits,
    done: Callable[[str], None],
    *,
    planar: bool,
) -> RungRun:
    """One rung, until a time.monotonic(); ``planar`` where one before it showed the structure to be that."""
    unfit = rung.unfit or (rung.spatial if planar else "")
    if unfit:
        return RungRun(rung, (), "unfit", unfit)
    if until is not None and until - time.monotonic() < LEAST_TIME:
        return RungRun(rung, (), "not run", "the time limit was over", expired=True)
    done("")
    run = process.run(task, until, limits.each, lambda measurement: done(measurement.case))
    return _told(rung, run, until is not None and time.monotonic() >= until, limits)


def _told(rung: Rung, run: ChildRun, expired: bool, limits: Limits) -> RungRun:
    if run.end == "stopped":
        words = "stopped at the end of the time limit" if expired else f"stopped after {limits.each:g} s"
        return RungRun(rung, run.measurements, "stopped", words, expired)
    return RungRun(rung, run.measurements, run.end, run.words)


def _is_planar(run: RungRun) -> bool:
    return (
        run.end == "done" and not run.rung.model and {measurement.dimension for measurement in run.measurements} == {2}
    )
