"""Small file systems in memory, mounted where only the processes of the check see them: none outlasts them."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

CLONE_NEWNS, MS_REC, MS_PRIVATE = 0x20000, 1 << 14, 1 << 18


def keep_mounts_to_ourselves() -> None:
    """From here on this process and those that it begins have mounts of their own, which end with the last of them.

    Where the system refuses that it refuses to mount anything as well.
    """
    if sys.platform == "linux":
        library = ctypes.CDLL(None, use_errno=True)
        if library.unshare(CLONE_NEWNS) == 0 and library.mount(b"none", b"/", None, MS_REC | MS_PRIVATE, None):
            raise OSError(ctypes.get_errno(), "mounts cannot be made private")


@contextlib.contextmanager
def small_disk(folder: Path, size: int) -> Iterator[None]:
    """A file system in memory of that size [bytes]; the test is skipped where none may be mounted."""
    library = ctypes.CDLL(None, use_errno=True)
    folder.mkdir(exist_ok=True)
    options = f"size={size}".encode()
    if sys.platform != "linux" or library.mount(b"tmpfs", os.fsencode(folder), b"tmpfs", 0, options):
        pytest.skip(f"no small file system can be mounted: {os.strerror(ctypes.get_errno())}")
    try:
        yield
    finally:
        library.umount2(os.fsencode(folder), 0)
