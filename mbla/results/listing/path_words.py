"""The load path in words: its peak, where it ended, and the steps at which modes of contact points changed."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.model.model import Model
from mbla.results.listing.text import MOST_ROWS, counted, number, sentence, small, table
from mbla.results.listing.verdict_words import load_factor_words
from mbla.results.results import CaseResult
from mbla.solution.solution import PathPoint

BELOW_PEAK = 1e-6
"""share by which the last load factor lies below the greatest one where the path is said to have a peak"""


def path_lines(model: Model, case: CaseResult) -> list[str]:
    """Peak and end of the path, and a table of the steps that matter; nothing where no path was followed."""
    path = case.solution.path
    if not path:
        return []
    peak = max(path, key=lambda point: point.load_factor)
    last = path[-1]
    highest, ended = (load_factor_words(model, case.load_case, point.load_factor) for point in (peak, last))
    says = f"Load path of {counted(len(path), 'step')}"
    if peak.load_factor - last.load_factor > BELOW_PEAK * abs(peak.load_factor):
        says += f": its peak, {highest} at step {peak.step}, is a limit point; it ended below, at {ended}."
    else:
        says += f": it rose to {ended}, without a peak before its end."
    shown = _steps_that_matter(path)
    rows = [
        [str(point.step), number(point.load_factor), str(point.open), str(point.slide), small(point.residual)]
        for point in shown
    ]
    lines = ["", *sentence(says), *table(["step", "load factor", "points open", "sliding", "residual"], rows)]
    more = len(path) - len(shown)
    return lines + (sentence(f"and {counted(more, 'step')} more; the result files hold them all") if more else [])


def _steps_that_matter(path: Sequence[PathPoint]) -> list[PathPoint]:
    """First, peak and last step, and those at which modes change, evenly thinned where they are many."""
    peak = max(range(len(path)), key=lambda i: path[i].load_factor)
    changes = [i for i in range(1, len(path)) if (path[i].open, path[i].slide) != (path[i - 1].open, path[i - 1].slide)]
    kept = {0, peak, len(path) - 1}
    room = MOST_ROWS - len(kept)
    others = [i for i in changes if i not in kept]
    if len(others) > room:
        others = [others[i * len(others) // room] for i in range(room)]
    return [path[i] for i in sorted(kept | set(others))]
