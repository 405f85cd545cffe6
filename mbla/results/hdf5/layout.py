"""The layout of the HDF5 result file: the stored part of the record, a dataset a quantity, at its place.

A dataset is read as the layout wants it, and a complete file compared with another that should be the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from mbla.results.quantities.quantity import Quantity
from mbla.results.quantities.registry import OF_CASES, OF_MODEL, OF_RUN

if TYPE_CHECKING:
    import h5py


Value: TypeAlias = "np.typing.NDArray[np.generic] | str | Sequence[Any] | float | int | bool"
Content: TypeAlias = dict[str, Value]

FILETYPE = "mbla results"
VERSION = 10
"""raised by one with every change that an older reader would misread"""

ATTRIBUTES = {
    "filetype": f'"{FILETYPE}"',
    "version": f"version of this layout, {VERSION}; a reader checks it first",
    "mbla_version": "version of the program that ran the analysis",
    "created": "date of the run, UTC, ISO 8601; the only thing that differs between two runs of one deck and its times",
    "deck_sha256": "hash of the effective deck: sources and overrides",
    "complete": "1; 0 in a partial file",
}
"""attributes of the root group"""

SHARED_DIMENSIONS = (
    "block",
    "block_bound",
    "vertex",
    "corner",
    "face",
    "face_bound",
    "interface",
    "interface_bound",
    "point",
    "group",
    "member",
    "position",
    "joint",
    "ground",
    "axis",
    "direction",
    "component",
    "pair",
    "tie",
)
"""dimensions with their scale in the root group, where every group sees it; that of others is next to their dataset"""


def fields_of(cases: Iterable[str]) -> tuple[tuple[str, Quantity], ...]:
    """Path and quantity of every dataset that a file with these load cases may hold, in the order of writing."""
    return (*((each.path, each) for each in (*OF_RUN, *OF_MODEL)), *placed(OF_CASES, cases))


def placed(quantities: Iterable[Quantity], cases: Iterable[str]) -> list[tuple[str, Quantity]]:
    """Path and quantity of each dataset of quantities of load cases."""
    return [(each.path.replace("*", name), each) for name, each in product(cases, tuple(quantities))]


MOST = 1e152
"""of numbers that have a unit: their squares are numbers, too. Loads and strengths of a deck reach 1e100, its lengths
lie within 1e±50; load factors of programs that diverged may be of any size"""


def text_of(value: Any) -> str:
    """Text as HDF5 gives it."""
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)


def strings(dataset: h5py.Dataset) -> list[str]:
    """Text of a dataset, one or many."""
    return [text_of(value) for value in np.atleast_1d(dataset[()])]


def read_field(dataset: h5py.Dataset, path: str, field: Quantity, sizes: dict[str, int]) -> Value:
    """One dataset, with the type, the dimensions and the range of numbers that the layout asks for.

    Raises ValueError where it has others.
    """
    if dataset.ndim != len(field.dims):
        raise ValueError(f"{path} has {dataset.ndim} dimensions instead of {len(field.dims)}")
    for name, size in zip(field.dims, dataset.shape, strict=True):
        own = name if name in SHARED_DIMENSIONS else f"{path.rpartition('/')[0]}/{name}"
        expected = sizes.get(name, sizes.setdefault(own, size))
        if size != expected:
            raise ValueError(f"{path} has {size} along {name} instead of {expected}")
    if field.kind == "text":
        texts = strings(dataset)
        return texts if field.dims else texts[0]
    kinds = {"float": "f", "int": "i", "bool": "u", "byte": "u"}
    if dataset.dtype.kind != kinds[field.kind]:
        raise ValueError(f"{path} is of type {dataset.dtype}")
    array = np.asarray(dataset[()])
    if field.kind == "float" and not field.open and not np.isfinite(array).all():
        raise ValueError(f"{path} is not finite")
    if field.kind == "float" and field.unit != "1" and np.any(np.isfinite(array) & (np.abs(array) > MOST)):
        raise ValueError(f"{path} is beyond {MOST:g}")
    if field.kind == "bool" and np.any(array > 1):
        raise ValueError(f"{path} is neither 0 nor 1")
    array = array.astype({"float": np.float64, "int": np.int64, "bool": np.bool_, "byte": np.uint8}[field.kind])
    return array if field.dims else array.item()


def check_indices(path: str, field: Quantity, value: Value, sizes: dict[str, int]) -> None:
    """Indices within what they count; offsets from zero, never falling, to the end of what they divide.

    Raises ValueError for others.
    """

    def size(name: str) -> int:
        if name == "body":
            return sizes["block"] + sizes["ground"]
        return sizes[name] if name in SHARED_DIMENSIONS else sizes[f"{path.rpartition('/')[0]}/{name}"]

    if not isinstance(value, np.ndarray):
        return
    if field.index_of and value.size and (int(value.min()) < 0 or int(value.max()) >= size(field.index_of)):
        raise ValueError(f"{path} points outside {field.index_of}")
    if field.start_of and (
        not len(value) or value[0] != 0 or value[-1] != size(field.start_of) or np.any(np.diff(value) < 0)
    ):
        raise ValueError(f"{path} does not divide {field.start_of}")


AGREEMENT = 1e-6
"""Difference of figures, relative to the largest of their array and absolute for single ones, that is no disagreement:
residuals are relative, and sparse factorisations of another machine may round differently."""

LINKS = ("DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid")
"""attributes that hold places in the file"""

LONGEST_TEXT = 60
"""letters of a text that is quoted in a disagreement"""


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
