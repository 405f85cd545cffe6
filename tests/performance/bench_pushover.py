"""What a pushover costs, solve and contact search apart: results/pushover.csv.

::

    python -m tests.performance.bench_pushover          walls in running bond of 50, 410 and 1,041 blocks
    python -m tests.performance.bench_pushover 20       the one of 20 courses

Each wall is pushed in its plane by 20 steps, the one of 20 courses by 100; seconds of the processor, on one thread.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mbla.contacts.moved import MovedSearch
from mbla.solution.pushover.step_program import StepProgram
from tests.line import HEAD
from tests.performance.recording import record
from tests.solution.test_pushover import pushover_of

SIDES = {7: 20, 20: 100, 32: 20}
"""courses, as many units long, and steps"""


def wall(side: int, steps: int) -> str:
    """The deck of a wall."""
    return (
        f"{HEAD}joints: {{dry: {{friction: 0.65}}}}\n"
        f"blocks: [{{wall: {{material: stone, unit: [0.4, 0.2, 0.175], length: {0.4 * side}, courses: {side}}}}}]\n"
        "supports: [{ground: {z: 0}}]\n"
        f"load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}], pushover: {{step: 0.005, steps: {steps}}}}}}}\n"
    )


def timed(owner: type, name: str, into: dict[str, float]) -> Callable[[], None]:
    """Add the seconds of a method up; the way back."""
    method = getattr(owner, name)

    def measured(*args: Any, **options: Any) -> Any:
        started = time.process_time()
        found = method(*args, **options)
        into[name] = into.get(name, 0.0) + time.process_time() - started
        return found

    setattr(owner, name, measured)
    return lambda: setattr(owner, name, method)


def main(sides: list[int]) -> None:
    """A row for each wall."""
    for side in sides:
        seconds: dict[str, float] = {}
        back = [timed(StepProgram, "solved", seconds), timed(MovedSearch, "at", seconds)]
        with TemporaryDirectory() as folder:
            (path := Path(folder) / "wall.yaml").write_text(wall(side, SIDES[side]), encoding="utf-8")
            started = time.process_time()
            solution = pushover_of(path)
            whole = time.process_time() - started
        for undo in back:
            undo()
        count, curve = len(solution.curve) - 1, solution.curve
        row = {
            "structure": f"wall, planar, {side} x {side}",
            "blocks": solution.pushed.mechanisms.shape[1] if solution.pushed else 0,
        }
        row |= {"steps": count, "seconds": whole, "solve_per_step": seconds["solved"] / count}
        row |= {"contacts_per_step": seconds["at"] / (2 * count)}  # once to solve, once to verify
        record(
            "pushover", row | {"residual": max(each.residual for each in curve), "load_factor": curve[-1].load_factor}
        )


if __name__ == "__main__":
    main([int(each) for each in sys.argv[1:]] or list(SIDES))
