"""Result files changed after they were written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py


def change(path: Path, name: str, value: Any) -> None:
    with h5py.File(path, "r+") as file:
        file[name][...] = value


def remove(path: Path, name: str) -> None:
    with h5py.File(path, "r+") as file:
        del file[name]


def replace_dataset(path: Path, name: str, array: Any) -> None:
    with h5py.File(path, "r+") as file:
        del file[name]
        file[name] = array
