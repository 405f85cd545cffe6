"""What a rival answers: load factor or verdict, how far its forces fit the statement, and the time it took."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class Answer:
    """Of one run from the contacts on.

    status       : in the rival's own words
    load_factor  : None where it gives none
    residual     : largest lack of balance or excess over friction of its forces, over the mean block weight; None where
                   it is not asked
    bounds       : proved static and kinematic bound; None where the rival proves nothing
    solver       : seconds of the processor in the solver alone; None where it is measured apart
    """

    status: str
    load_factor: float | None
    residual: float | None
    bounds: tuple[float, float] | None
    solver: float | None


def timed(run: Callable[[], Value]) -> tuple[Value, float]:
    """What it returns, and the seconds of the processor that it took."""
    started = time.process_time()
    value = run()
    return value, time.process_time() - started
