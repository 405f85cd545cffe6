"""One dataset of a result file as the layout wants it: its type, dimensions, finiteness and the indices in it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.results.hdf5.content import Value
from mbla.results.hdf5.layout import SHARED_DIMENSIONS
from mbla.results.record.quantity import Quantity

if TYPE_CHECKING:
    import h5py


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
    """One dataset, with the type, the dimensions and the range of numbers that the layout asks for."""
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
    """Indices within what they count; offsets from zero, never falling, to the end of what they divide."""

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
