"""Progress of a sweep while it is solved, and what is printed at its end."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mbla.cli.terminal import clear_line, rewrite_line, say
from mbla.process.collector import loading

if TYPE_CHECKING:
    from mbla.sweeps.command import Finished
    from mbla.sweeps.plan import PointOutcome, Task
    from mbla.sweeps.words import SweepProgress

NAMED_FAILURES = 20
"""failed points that have a line of their own while the sweep continues; the journal has the reasons of all"""
BETWEEN_LINES = 10.0
"""seconds between lines of progress where there is no terminal"""


def solve_and_print(
    options: argparse.Namespace,
    solve: Callable[[Any], Finished],
    lines_of: Callable[[Finished], Sequence[str]] = lambda finished: finished.lines,
) -> int:
    """Report progress meanwhile, then print the JSON object where it is asked for, words, and where the files are."""
    with loading():
        from mbla.results.record.json_values import json_line

    report = None if options.quiet else _Reporter()
    try:
        finished = solve(report)
    finally:
        if report is not None:
            report.end()
    if finished.remark:
        say(f"mbla: {finished.remark}", 0)
    if options.json:
        print(json_line(finished.record), flush=True)
    if not options.quiet:
        folder, here = finished.folder, Path.cwd()
        shown = folder.relative_to(here) if folder.is_relative_to(here) else folder
        text = "\n".join([*lines_of(finished), f"  files: {shown}/"])
        print(text, file=sys.stderr if options.json else sys.stdout, flush=True)
    return finished.exit_code


class _Reporter:
    """Progress on standard error: a line that rewrites itself on a terminal, a line now and then elsewhere."""

    def __init__(self) -> None:
        self._terminal = sys.stderr.isatty()
        self._last = time.monotonic()

    def __call__(self, progress: SweepProgress, task: Task | None, outcome: PointOutcome | None) -> None:
        failed = outcome is not None and outcome.state == "failed"
        if task is not None and outcome is not None and failed and progress.failed <= NAMED_FAILURES:
            self.end()
            say(f"mbla: point {task.number} failed: {outcome.reason}", 0)
        if self._terminal:
            rewrite_line(progress.words())
        elif outcome is None:
            known = f", {progress.earlier} are in the journal" if progress.earlier else ""
            say(f"mbla: {progress.total} points to solve{known}", 0)
        elif time.monotonic() - self._last >= BETWEEN_LINES:
            self._last = time.monotonic()
            say(f"mbla: {progress.words()}", 0)

    def end(self) -> None:
        """What is said next has a line of its own."""
        clear_line(self._terminal or None)
