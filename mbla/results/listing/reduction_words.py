"""What each reduction left out of a load case, as a table: what is solved after each of them."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.program.reductions.steps import ProgramSize, ReductionStep, StepState
from mbla.results.listing.text import counted, sentence, table

FOUND = {
    "glued": ("block", "in larger bodies or held"),
    "points": ("contact point", "left out"),
    "unloaded": ("block", "apart, without live load"),
    "parts": ("part", "solved apart"),
    "planar": ("part", "in its plane"),
    "mirror": ("part", "by one half"),
}
"""What a reduction counts, and what becomes of it."""


def reduction_lines(steps: Sequence[ReductionStep]) -> list[str]:
    """A row for each reduction, in the order in which they are applied; nothing where none was looked for."""
    if not steps:
        return []
    rows = [["none", "", *_sizes(steps[0].before)]]
    rows += [[step.name, found_words(step), *_sizes(step.after)] for step in steps]
    head = ["reduction", "found", "unknowns", "cones", "entries", "largest program"]
    told = (
        "Each row says what is left to solve with the live load after the reduction: velocities, friction cones (in a "
        "plane pairs of half-lines), entries of the equilibrium matrices, velocities of the largest program. "
        "Contact points inside of glued bodies are never set up, and not counted."
    )
    return [*table(head, rows, left=2), *sentence(told)]


def found_words(step: ReductionStep) -> str:
    """What a reduction found, or why nothing."""
    if step.state is not StepState.APPLIED:
        return str(step.state.value)
    what, became = FOUND[step.name]
    return f"{counted(step.found, what)} {became}"


def _sizes(size: ProgramSize) -> list[str]:
    return [str(size.unknowns), str(size.cones), str(size.entries), str(size.largest)]
