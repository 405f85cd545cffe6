"""Files changed through HDF5: malformed ones, and ones with other figures."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mbla.results.hdf5.layout import VERSION

Edit = Callable[[h5py.File, str, random.Random], None]


def datasets(file: h5py.File) -> list[str]:
    """Paths of all datasets that are no dimension scales."""
    found: list[str] = []

    def add(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and not item.is_scale:
            found.append(name)

    file.visititems(add)
    return found


# --- malformed ----------------------------------------------------------------------------------------------------


def _put(file: h5py.File, name: str, value: Any) -> None:
    del file[name]
    file[name] = value


def _removed(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]


def _renamed(file: h5py.File, name: str, generator: random.Random) -> None:
    file.move(name, name + "_")


def _reshaped(file: h5py.File, name: str, generator: random.Random) -> None:
    values = np.atleast_1d(file[name][()])
    shapes = [values[:-1], values[None], np.concatenate([values, values]), values.ravel()[:0]]
    _put(file, name, generator.choice(shapes))


def _retyped(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = file[name].shape
    kinds = [np.float32, np.int8, np.uint64, np.complex128, np.bool_, "S3", h5py.ref_dtype, h5py.string_dtype()]
    file_type = generator.choice(kinds)
    del file[name]
    file.create_dataset(name, shape=shape, dtype=file_type)


def _compound(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = file[name].shape
    _put(file, name, np.zeros(shape, dtype=[("a", "f8"), ("b", "i4")]))


def _not_finite(file: h5py.File, name: str, generator: random.Random) -> None:
    values = file[name][()]
    if values.dtype.kind != "f" or not values.size:
        return _removed(file, name, generator)
    values = np.array(values)
    values.reshape(-1)[generator.randrange(values.size)] = generator.choice([np.nan, np.inf, -np.inf])
    file[name][()] = values
    return None


def _group(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file.create_group(name)


def _circle(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file[name] = generator.choice([file["/"], h5py.SoftLink("/" + name), h5py.SoftLink("/" + name + "/" + name)])


def _soft(file: h5py.File, name: str, generator: random.Random) -> None:
    file.move(name, "elsewhere")
    file[name] = h5py.SoftLink("/elsewhere")


def _external(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file[name] = h5py.ExternalLink(generator.choice(["/dev/zero", "none.h5", "../x.h5", file.filename]), "/" + name)


def _outside(file: h5py.File, name: str, generator: random.Random) -> None:
    """The values stand in another file."""
    shape, kind = file[name].shape or (1,), file[name].dtype
    del file[name]
    if generator.random() < 0.5:
        size = int(np.prod(shape)) * kind.itemsize
        file.create_dataset(name, shape=shape, dtype=kind, external=[("/dev/zero", 0, max(size, 1))])
        return
    layout = h5py.VirtualLayout(shape=shape, dtype=kind)
    layout[...] = h5py.VirtualSource("none.h5", name, shape=shape, dtype=kind)
    file.create_virtual_dataset(name, layout)


def _huge(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = tuple(generator.choice([2**31, 2**40, 10**7]) for _ in file[name].shape) or (2**40,)
    kind = file[name].dtype
    del file[name]
    while float(np.prod([float(size) for size in shape])) * kind.itemsize > 2.0**62:
        shape = (*shape[:-1], shape[-1] // 2**10 + 1)
    file.create_dataset(name, shape=shape, dtype=kind, chunks=tuple(1024 if i == 0 else 1 for i in range(len(shape))))


def _not_utf8(file: h5py.File, name: str, generator: random.Random) -> None:
    kind = h5py.string_dtype("utf-8", 8)
    bad = generator.choice([b"\xff\xfe\x80", b"a\xc3", b"\xed\xa0\x80", b"x\x00y"])
    _put(file, name, np.full(file[name].shape, bad, dtype="S8").astype(kind))


def _attribute(file: h5py.File, name: str, generator: random.Random) -> None:
    """A root attribute that is missing or of another type or value."""
    attribute = generator.choice(["filetype", "version", "mbla_version", "created", "deck_sha256", "complete"])
    del file.attrs[attribute]
    values = [None, b"\xff", np.arange(3), "4", 3.5, h5py.Empty("f8"), -1, 2**40, "mbla", np.zeros(0)]
    value = generator.choice(values)
    if value is not None:
        file.attrs[attribute] = value


def _version(file: h5py.File, name: str, generator: random.Random) -> None:
    file.attrs["version"] = generator.choice([0, 1, VERSION - 1, VERSION + 1, 99, -1, 2**62])


def _incomplete(file: h5py.File, name: str, generator: random.Random) -> None:
    if generator.random() < 0.5:
        del file.attrs["complete"]
    else:
        file.attrs["complete"] = 0


MALFORMED: dict[str, Edit] = {
    "dataset removed": _removed,
    "dataset renamed": _renamed,
    "dataset of another shape": _reshaped,
    "dataset of another type": _retyped,
    "dataset of a compound type": _compound,
    "number not finite": _not_finite,
    "group for a dataset": _group,
    "links in a circle": _circle,
    "soft link": _soft,
    "external link": _external,
    "values in another file": _outside,
    "huge shape": _huge,
    "text that is not UTF-8": _not_utf8,
    "root attribute": _attribute,
    "layout version": _version,
    "not complete": _incomplete,
}


# --- other figures ------------------------------------------------------------------------------------------------


def _other_figure(file: h5py.File, name: str, generator: random.Random) -> None:
    """One entry, or all, of a dataset of numbers: little or much, up or down, another sign, another index."""
    values = np.array(file[name][()])
    flat = values.reshape(-1)
    places = slice(None) if generator.random() < 0.3 else generator.randrange(len(flat))
    if values.dtype.kind == "f":
        known = np.abs(flat[np.isfinite(flat)])
        size = float(known.max(initial=0.0)) or 1.0
        share = generator.choice([1e-4, 1e-3, 0.01, 0.1, 1.0, -0.01, -0.3, -2.0])
        flat[places] = np.where(np.isfinite(flat[places]), flat[places], 0.0) + share * size
    elif values.dtype.kind == "i":
        flat[places] += generator.choice([1, -1])
    else:
        flat[places] = 1 - flat[places]
    file[name][()] = values


def _other_word(file: h5py.File, name: str, generator: random.Random) -> None:
    words = ["solved", "approximate", "unbounded", "no_equilibrium", "yes", "associative", "non_associative", "convex"]
    texts = np.array(file[name][()])
    texts.reshape(-1)[generator.randrange(texts.size)] = generator.choice(words).encode()
    _put(file, name, texts.astype(h5py.string_dtype("utf-8", max(texts.dtype.itemsize, 16))))


def figures(path: Path) -> list[str]:
    """Datasets that hold numbers."""
    with h5py.File(path) as file:
        return [name for name in datasets(file) if file[name].dtype.kind in "fiu" and file[name].size]


def words(path: Path) -> list[str]:
    """Datasets that hold text."""
    with h5py.File(path) as file:
        return [name for name in datasets(file) if file[name].dtype.kind not in "fiu" and file[name].size]


def change_figure(file: h5py.File, name: str, generator: random.Random) -> None:
    """Another value in a dataset of numbers or text."""
    edit = _other_figure if file[name].dtype.kind in "fiu" else _other_word
    edit(file, name, generator)
