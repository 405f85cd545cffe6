"""Result files changed after they were written, and sealed anew: what is in them is judged, not their seal."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py

from mbla.results.hdf5.seal import SEAL_BYTES, sealed


@contextlib.contextmanager
def changing(path: Path) -> Iterator[h5py.File]:
    """The file without its seal, open to be changed; sealed at the end."""
    path.write_bytes(path.read_bytes()[:-SEAL_BYTES])
    with h5py.File(path, "r+") as file:
        yield file
    path.write_bytes(sealed(path.read_bytes()))


def change(path: Path, name: str, value: Any) -> None:
    with changing(path) as file:
        file[name][...] = value


def remove(path: Path, name: str) -> None:
    with changing(path) as file:
        del file[name]


def replace_dataset(path: Path, name: str, array: Any) -> None:
    with changing(path) as file:
        del file[name]
        file[name] = array
