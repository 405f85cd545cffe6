"""A single file beside results, such as a picture or a report: there as a whole, or the earlier one still is.

It is written under a temporary name in the same folder, flushed to the disk and renamed into place. What kills leave
behind, the next command that writes to that folder clears away (:mod:`mbla.results.leftovers`).
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from mbla.errors import FileError
from mbla.process.signals import held_signals
from mbla.results.disk import file_errors, flush_to_disk, missing_folders, remove_folders
from mbla.results.leftovers import clear_leftovers, temporary_path


@contextlib.contextmanager
def writing_whole(path: Path) -> Iterator[Path]:
    """Where to write what is to be at ``path``: in place when the block ends, gone if it fails or is interrupted.

    Missing folders are made, and removed again if the block fails. An earlier file is replaced. The temporary path has
    the suffix of ``path``.

    Raises
    ------
    FileError
        The folder cannot be made, the path is a folder, or the file cannot be written; the message names ``path``.
    """
    if path.is_dir():
        raise FileError("folder-given", f"{path}: is a folder")
    temporary, created = temporary_path(path), missing_folders(path.parent)
    try:
        with file_errors(path.parent):
            path.parent.mkdir(parents=True, exist_ok=True)
            with held_signals():
                clear_leftovers(path.parent)
        with file_errors(path):
            yield temporary
            flush_to_disk(temporary)
            temporary.replace(path)
    except BaseException:
        with held_signals():
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
            remove_folders(created)
        raise


def write_whole(path: Path, data: bytes) -> None:
    """Write one file; raises as ``writing_whole`` does."""
    with writing_whole(path) as temporary:
        temporary.write_bytes(data)
