"""What load cases of a deck, or several decks that are solved one after the other, have in common is worked out once.

A function whose result costs much and depends on nothing but its arguments says so (``shared``, or ``once`` around a
call). Whoever solves several opens a memory for such results (``sharing``); with none open both work everything out.
What is kept is the very object that the function returned, for arguments of the same content: an answer is the same,
bit for bit, with and without.

Contents are compared by their pickles, of which a hash is kept. A pickle says everything of what it was made of, but
the same content may be pickled in two ways (a set in another order); then a result is worked out once more, which is
all. Arrays in what is kept become read-only, so that no point can change what the next one gets: such an attempt is an
error, not a wrong number.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import pickle
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from dataclasses import dataclass, field, fields, is_dataclass
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

if TYPE_CHECKING:
    import numpy as np

P = ParamSpec("P")
T = TypeVar("T")

MOST_BYTES = 64 * 2**20
"""Arrays of all that is kept. The structure of 1,000 blocks takes 3 MB; beyond it what was used longest ago goes."""
MOST_RESULTS = 400
"""Results kept: with small structures the records around arrays count for more than these."""


@dataclass
class Memory:
    """Results by name and content, those used last.

    found : how often a result was there, by name
    size  : bytes of what is kept
    """

    most_bytes: int = MOST_BYTES
    most_results: int = MOST_RESULTS
    found: Counter[str] = field(default_factory=Counter)
    size: int = 0
    _kept: OrderedDict[tuple[str, bytes], tuple[Any, int]] = field(default_factory=OrderedDict)

    def __len__(self) -> int:
        return len(self._kept)

    def once(self, name: str, content: tuple[Any, ...], make: Callable[[], T], lasts: Callable[[T], bool]) -> T:
        """What ``make`` returned for that content before; else what it returns now, kept where it ``lasts``.

        What it raises is not kept.
        """
        key = (name, content_hash(content))
        if key in self._kept:
            self._kept.move_to_end(key)
            self.found[name] += 1
            known: T = self._kept[key][0]
            return known
        result = make()
        if lasts(result):
            self._keep(key, result)
        return result

    def _keep(self, key: tuple[str, bytes], result: Any) -> None:
        arrays = arrays_in(result)
        size = len(result) if isinstance(result, bytes) else sum(array.nbytes for array in arrays)
        if size > self.most_bytes:
            return
        for array in arrays:
            array.flags.writeable = False
        self._kept[key] = result, size
        self.size += size
        while self._kept and (self.size > self.most_bytes or len(self._kept) > self.most_results):
            self.size -= self._kept.popitem(last=False)[1][1]  # what was used longest ago


_open: ContextVar[Memory | None] = ContextVar("memory", default=None)
"""the only state here: the memory of the ``with sharing`` block that runs, in this thread alone; None outside of it"""


@contextlib.contextmanager
def sharing(memory: Memory) -> Iterator[None]:
    """Keep results in ``memory`` during a ``with`` block; within another block, in the memory of that one."""
    outer = _open.get()
    token = _open.set(memory if outer is None else outer)
    try:
        yield
    finally:
        _open.reset(token)


def once(name: str, content: tuple[Any, ...], make: Callable[[], T], lasts: Callable[[T], bool] = lambda _: True) -> T:
    """Result of ``make``, which must depend on nothing but ``content``: plain data, arrays, records of these."""
    memory = _open.get()
    return make() if memory is None else memory.once(name, content, make, lasts)


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
            return once(name, (args, tuple(sorted(kwargs.items()))), lambda: function(*args, **kwargs))

        return kept

    return decorate


class _Pickler(pickle.Pickler):
    """Without the references within a pickle, which depend on which equal objects are one."""

    def __init__(self, file: io.BytesIO) -> None:
        super().__init__(file, protocol=5)
        self.fast = True


def content_hash(content: Any) -> bytes:
    """Hash of plain data, arrays and records of them; raises where there is something else in it, such as a function.

    Two contents that differ in one bit of one number differ.
    """
    file = io.BytesIO()
    _Pickler(file).dump(content)
    return hashlib.blake2b(file.getbuffer(), digest_size=20).digest()


def arrays_in(value: Any) -> list[np.ndarray[Any, Any]]:
    """All arrays, of any shape, in records, lists, mappings and sparse matrices, each once."""
    import numpy as np  # decks are read without it

    found: dict[int, np.ndarray[Any, Any]] = {}
    seen: dict[int, Any] = {}
    rest = [value]
    while rest:
        item = rest.pop()
        if id(item) in seen:
            continue
        seen[id(item)] = item
        if isinstance(item, np.ndarray):
            found[id(item)] = item
        elif isinstance(item, (list, tuple, set, frozenset)):
            rest += item
        elif isinstance(item, dict):
            rest += item.values()
        elif is_dataclass(item) and not isinstance(item, type):
            rest += [getattr(item, each.name) for each in fields(item)]
        elif type(item).__module__.startswith("scipy.sparse"):
            rest += vars(item).values()
    return list(found.values())
