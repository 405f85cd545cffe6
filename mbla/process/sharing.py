"""What several decks that are solved one after the other have in common is worked out once.

A function whose result costs much and depends on nothing but its arguments says so (``shared``, or ``once`` around a
call). Whoever solves many decks opens something that keeps such results (``sharing``); with nothing open both work
everything out. What is kept is the very object that the function returned, for arguments of the same content: an answer
is the same, bit for bit, with and without.
"""

from __future__ import annotations

import contextlib
import pickle
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from functools import wraps
from typing import Any, ParamSpec, Protocol, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class Keeper(Protocol):
    """Keeps results by the content of what they were made of."""

    def once(self, name: str, content: tuple[Any, ...], make: Callable[[], T], lasts: Callable[[T], bool]) -> T:
        """What ``make`` returned for that content before; else what it returns now, kept where it ``lasts``.

        What it raises is not kept.
        """
        ...


_open: ContextVar[Keeper | None] = ContextVar("keeper", default=None)
"""the only state here: the keeper of the ``with sharing`` block that runs, in this thread alone; None outside of it"""


@contextlib.contextmanager
def sharing(keeper: Keeper) -> Iterator[None]:
    """Keep results in ``keeper`` during a ``with`` block."""
    token = _open.set(keeper)
    try:
        yield
    finally:
        _open.reset(token)


def once(name: str, content: tuple[Any, ...], make: Callable[[], T], lasts: Callable[[T], bool] = lambda _: True) -> T:
    """Result of ``make``, which must depend on nothing but ``content``: plain data, arrays, records of these."""
    keeper = _open.get()
    return make() if keeper is None else keeper.once(name, content, make, lasts)


def copied(name: str, content: tuple[Any, ...], make: Callable[[], T]) -> T:
    """As ``once``, for what is changed by whoever gets it: each gets a copy of its own, by way of a pickle."""
    if _open.get() is None:
        return make()
    kept = once(name, content, lambda: pickle.dumps(make(), protocol=pickle.HIGHEST_PROTOCOL))
    result: T = pickle.loads(kept)
    return result


def shared(name: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """The same function; its result is kept by the content of all its arguments."""

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def kept(*args: P.args, **kwargs: P.kwargs) -> T:
            if _open.get() is None:
                return function(*args, **kwargs)
            return once(name, (args, tuple(sorted(kwargs.items()))), lambda: function(*args, **kwargs))

        return kept

    return decorate
