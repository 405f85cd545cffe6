"""A result file against another that should be the same, dataset by dataset with their attributes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.results.hdf5.reading import text_of

if TYPE_CHECKING:
    import h5py

AGREEMENT = 1e-6
"""Difference of figures, relative to the largest of their array and absolute for single ones, that is no disagreement:
residuals are relative, and sparse factorisations of another machine may round differently."""

LINKS = ("DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid")
"""attributes that hold places in the file"""

LONGEST_TEXT = 60
"""letters of a text that is told in a disagreement"""


def differences(found: h5py.Group, wanted: h5py.Group, path: str = "") -> Iterator[str]:
    """Where a group is not the one that is wanted, in words."""
    yield from _attributes(found, wanted, path or "/")
    for name in sorted(set(found) | set(wanted)):
        place = f"{path}/{name}" if path else name
        if name not in wanted:
            yield f"{place} does not follow from what the file holds"
        elif name not in found:
            yield f"{place} is missing"
        else:
            yield from _of_one(found[name], wanted[name], place)


def _of_one(found: h5py.HLObject, wanted: h5py.HLObject, path: str) -> Iterator[str]:
    """Of a group or a dataset."""
    if hasattr(found, "shape") != hasattr(wanted, "shape"):
        yield f"{path} is not what it should be, a group or a dataset"
    elif hasattr(wanted, "shape"):
        yield from _attributes(found, wanted, path)
        yield from _values(found[()], wanted[()], path)
    else:
        yield from differences(found, wanted, path)


def _attributes(found: h5py.HLObject, wanted: h5py.HLObject, path: str) -> Iterator[str]:
    own, right = ({name: attrs[name] for name in attrs if name not in LINKS} for attrs in (found.attrs, wanted.attrs))
    for name in sorted(own.keys() | right.keys()):
        if not (name in own and name in right and _same(own[name], right[name])):
            yield f"the attribute {name} of {path} is not as it should be"


def _values(found: Any, wanted: Any, path: str) -> Iterator[str]:
    if _same(found, wanted):
        return
    if np.ndim(found) == np.ndim(wanted) == 0:
        yield f"{path} is {_words(wanted)} recomputed, the file says {_words(found)}"
    else:
        yield f"{path} is not what follows from the rest of the file"


def _words(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    text = text_of(value)
    return (text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…") or "nothing"


def _same(one: Any, other: Any) -> bool:
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape or first.dtype.kind != second.dtype.kind:
        return False
    if first.dtype.kind != "f":
        return bool(np.array_equal(first, second))
    size = 1.0 if first.ndim == 0 else float(np.abs(second[np.isfinite(second)]).max(initial=0.0))
    relative = AGREEMENT if first.ndim == 0 else 0.0
    return bool(np.allclose(first, second, rtol=relative, atol=AGREEMENT * size, equal_nan=True))
