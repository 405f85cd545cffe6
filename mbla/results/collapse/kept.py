"""What follows from frozen records is found once and kept as long as they live.

Listing, summary, JSON record, result file and pictures all tell the same failure, which takes seconds to find in a
large model. Records are known by identity: their arrays cannot be hashed, and nobody changes them.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


def kept(function: Callable[P, T]) -> Callable[P, T]:
    """The same function of records and whole numbers, by position, called once for the same ones.

    Its result must not hold any of them, or they would live for ever.
    """
    known: dict[tuple[object, ...], T] = {}

    @wraps(function)
    def once(*args: P.args, **kwargs: P.kwargs) -> T:
        if kwargs:
            return function(*args, **kwargs)
        key = tuple(record if isinstance(record, int) else id(record) for record in args)
        if key not in known:
            known[key] = function(*args, **kwargs)
            for record in args:
                if not isinstance(record, int):  # another may get the same identity later
                    weakref.finalize(record, known.pop, key, None).atexit = False
        return known[key]

    return once
