"""Files and folders as the operating system has them: its errors in our words, and what outlasts a loss of power."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from mbla.errors import FileError


@contextlib.contextmanager
def file_errors(path: Path) -> Iterator[None]:
    """An error of the operating system becomes a FileError that names the file, as one of a temporary name does."""
    try:
        yield
    except OSError as error:
        raise FileError("file-not-written", f"{path}: {error.strerror or error}") from error
    except FileError as error:  # of what wrote it under a temporary name
        if isinstance(error.__cause__, OSError):
            words = f"{path}: {error.__cause__.strerror or error.__cause__}"
            raise FileError("file-not-written", words) from error.__cause__
        raise


def missing_folders(folder: Path) -> list[Path]:
    """Folders that ``mkdir`` will create, innermost first."""
    return [path for path in (folder, *folder.parents) if not path.exists()]


def remove_folders(folders: list[Path]) -> None:
    """Remove folders that were made and are empty, innermost first; one that cannot be removed stays."""
    for folder in folders:
        with contextlib.suppress(OSError):
            folder.rmdir()


def flush_to_disk(path: Path) -> None:
    """What was written to a file, or the names in a folder, outlasts a loss of power from here on."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
