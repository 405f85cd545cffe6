"""What points of a sweep have in common, kept by the content of what it was made of, in bounded memory.

Contents are compared by their pickles, of which a hash is kept. A pickle says everything of what it was made of, but
the same content may be pickled in two ways (a set in another order); then a result is worked out once more, which is
all. Arrays in what is kept become read-only, so that no point can change what the next one gets: such an attempt is an
error, not a wrong number.
"""

from __future__ import annotations

import hashlib
import io
import pickle
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, TypeVar

import numpy as np
import scipy.sparse as sp

T = TypeVar("T")

MOST_BYTES = 64 * 2**20
"""Arrays of all that is kept. The structure of 1,000 blocks takes 3 MB; beyond it what was used longest ago goes."""

MOST_RESULTS = 400
"""Results kept: with small structures the records around arrays count for more than these."""


@dataclass(frozen=True)
class _Kept:
    result: Any
    size: int


@dataclass
class Memory:
    """Results by name and content, those used last; a :class:`mbla.process.sharing.Keeper`.

    found, made : how often a result was there, and how often it was not, by name
    """

    most_bytes: int = MOST_BYTES
    most_results: int = MOST_RESULTS
    found: dict[str, int] = field(default_factory=dict)
    made: dict[str, int] = field(default_factory=dict)
    size: int = 0
    _kept: OrderedDict[tuple[str, bytes], _Kept] = field(default_factory=OrderedDict)

    def __len__(self) -> int:
        return len(self._kept)

    def once(self, name: str, content: tuple[Any, ...], make: Callable[[], T], lasts: Callable[[T], bool]) -> T:
        """What ``make`` returned for that content before, or returns now."""
        key = (name, content_hash(content))
        if key in self._kept:
            self._kept.move_to_end(key)
            self.found[name] = self.found.get(name, 0) + 1
            result: T = self._kept[key].result
            return result
        self.made[name] = self.made.get(name, 0) + 1
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
        self._kept[key] = _Kept(result, size)
        self.size += size
        while self._kept and (self.size > self.most_bytes or len(self._kept) > self.most_results):
            self.size -= self._kept.popitem(last=False)[1].size  # what was used longest ago


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
    """All arrays in records, lists, mappings and sparse matrices, each once."""
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
        elif sp.issparse(item):
            rest += [part for part in vars(item).values() if isinstance(part, np.ndarray)]
        elif is_dataclass(item) and not isinstance(item, type):
            rest += [getattr(item, each.name) for each in fields(item)]
    return list(found.values())
