"""Files and folders: errors of the operating system in our words, and files that are there as a whole or not at all.

A single file beside results, such as a picture, is written under a temporary name in the same folder, flushed to the
disk and renamed into place. What killed runs left under temporary names is cleared away:

    ``.mbla-HOST-PID-new-NAME``       a file that is being written
    ``.mbla-HOST-PID-earlier-NAME``   the file that NAME replaces, until the run is complete
    ``.mbla-HOST-PID-open-STEM``      there while a run puts files in place: the earlier ones still are the valid ones

The last one has a line ``INODE NAME`` for every file that is put where there was none. A killed run cannot undo what it
began; the next one in the folder does it then, for every process of this machine that no longer exists.
"""

from __future__ import annotations

import contextlib
import os
import re
import socket
from collections.abc import Iterator, Mapping
from pathlib import Path

from mbla.errors import FileError
from mbla.process.signals import held_signals


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


PREFIX = ".mbla-"
_TEMPORARY = re.compile(
    re.escape(PREFIX) + r"(?P<host>.+)-(?P<process>\d+)-(?P<kind>new|earlier|open)(?:-(?P<name>.+))?", re.DOTALL
)


def temporary_path(path: Path, kind: str = "new") -> Path:
    """Where a file is while it is written, the earlier one while it waits (``kind`` "earlier"), or a mark ("open")."""
    return path.with_name(f"{PREFIX}{_host()}-{os.getpid()}-{kind}-{path.name}")


def mark_as_new(marker: Path, inodes: Mapping[str, int]) -> None:
    """Add names of files that are about to be put where there was none, with the inodes that they will have."""
    with marker.open("a", encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        file.writelines(f"{inode} {name}\n" for name, inode in inodes.items())


def clear_leftovers(folder: Path) -> None:
    """Undo what killed runs of this machine left: earlier files back in place if their run never became complete.

    Files that such a run put where there was none are removed, unless they were replaced by others since. Being killed
    here changes nothing: the next run does it again. Raises OSError.
    """
    found = [(path, _TEMPORARY.fullmatch(path.name)) for path in sorted(folder.glob(f"{PREFIX}*"))]
    left = [(path, match) for path, match in found if match and match["host"] == _host()]
    dead = {match["process"] for _, match in left if not _process_exists(int(match["process"]))}
    markers = [path for path, match in left if match["kind"] == "open" and match["process"] in dead]
    unfinished = {match["process"] for path, match in left if path in markers}
    for marker in markers:
        remove_new(folder, marker)
    for path, match in left:
        if match["process"] not in dead or path in markers:
            continue
        if match["kind"] == "earlier" and match["process"] in unfinished and match["name"]:
            path.replace(folder / match["name"])
        else:
            path.unlink(missing_ok=True)
    for marker in markers:  # last: until then everything can be done again
        marker.unlink(missing_ok=True)


def remove_new(folder: Path, marker: Path) -> None:
    """Remove the files that a run put where there was none, by its mark; raises OSError."""
    with contextlib.suppress(FileNotFoundError):
        for line in marker.read_text(encoding="utf-8", errors="surrogateescape").split("\n")[:-1]:
            inode, _, name = line.partition(" ")
            target = folder / name
            with contextlib.suppress(FileNotFoundError):
                if Path(name).name == name and str(target.lstat().st_ino) == inode:
                    target.unlink()


def _host() -> str:
    return re.sub(r"[^A-Za-z0-9.]", "_", socket.gethostname()) or "host"


def _process_exists(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


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
