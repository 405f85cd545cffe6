"""Files and folders: errors of the operating system in plain words, and files that are there completely or not at all.

A single file next to results, such as a picture, is written under a temporary name in the same folder, flushed to the
disk and renamed into place. What killed runs left under temporary names is cleared away:

    ``.mbla-HOST-PID-new-NAME``       a file that is being written
    ``.mbla-HOST-PID-earlier-NAME``   the file that NAME replaces, until the run is complete
    ``.mbla-HOST-PID-open-STEM``      there while a run puts files in place: the earlier ones still are the valid ones

The last one has a line ``INODE NAME`` for every file that is put where there was none. A killed run cannot undo what it
began; the next one in the folder does it then, for every process of this machine that no longer exists.


A lock keeps two runs off one journal, or one result. It is one of the operating system (flock) on a file of its own
next to what it keeps: it ends with the process that holds it, however that ends, so that none is ever left behind. The
file says who holds it; it is removed at the end, and one that a killed process left does no harm.

Over NFS the lock holds between machines (Linux has it from the server since 2.6.12) unless the file system was mounted
with ``local_lock``; Lustre has locks where it was mounted with ``flock``. Where there are none a sweep is refused; a
run of one deck continues without.
"""

from __future__ import annotations

import contextlib
import errno
import os
import re
import socket
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from mbla.errors import FileError
from mbla.process.signals import held_signals

if sys.platform != "win32":
    import fcntl


@contextlib.contextmanager
def file_errors(path: Path) -> Iterator[None]:
    """Raises FileError that names the file for an error of the operating system within it.

    Also for one that names a temporary file.
    """
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
def writing_complete(path: Path) -> Iterator[Path]:
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


def write_complete(path: Path, data: bytes) -> None:
    """Write one file; raises as ``writing_complete`` does."""
    with writing_complete(path) as temporary:
        temporary.write_bytes(data)


# --- Locks ----------------------------------------------------------------------------------------------------------


_NONE_HERE = (errno.ENOSYS, errno.EOPNOTSUPP, errno.ENOLCK)
"""errors of file systems without locks"""
AT_WORK = "is at work on it; wait for its end or stop it"
PATIENCE = 0.3
"""seconds before a lock counts as held: a run that ends, or asks who holds it, has it for an instant"""
_PAUSE = 0.02
_WORDS = 200
"""bytes that are read of who holds a lock"""


def lock_path(path: Path) -> Path:
    """The file that is locked for this one: hidden, next to it."""
    return path.with_name(f".{path.name}.lock")


class NoLocksError(FileError):
    """The file system, or the operating system, has no locks."""


@contextlib.contextmanager
def locked(
    path: Path, *, shared: bool = False, busy: Callable[[], str] | None = None, required: bool = True
) -> Iterator[None]:
    """Hold the lock of ``path`` inside the block.

    shared   : others may hold it shared at the same time
    busy     : message where another process holds it; default: who that is
    required : whether to refuse where there are no locks; without one nothing keeps others off

    Raises FileError where another process holds it, or the file system has no locks.
    """
    file = lock_path(path)
    try:
        descriptor = _taken(path, file, shared, busy)
    except NoLocksError:
        if required:
            raise
        yield
        return
    try:
        if not shared:
            with file_errors(file):
                os.ftruncate(descriptor, 0)
                os.pwrite(descriptor, f"process {os.getpid()} on {socket.gethostname()}".encode(), 0)
        yield
    finally:
        _leave(file, descriptor)


def holder(path: Path) -> str | None:
    """Who holds the lock of a file alone, in words; None if no process does."""
    file = lock_path(path)
    try:
        descriptor = os.open(file, os.O_RDWR | os.O_CLOEXEC)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return os.pread(descriptor, _WORDS, 0).decode("utf-8", errors="replace") or "another process"
    finally:
        os.close(descriptor)
    return None


def _taken(path: Path, file: Path, shared: bool, busy: Callable[[], str] | None) -> int:
    """Descriptor of the locked file; again where the one before removed the file in between."""
    if sys.platform == "win32":
        raise _no_locks(path)
    kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
    until = time.monotonic() + PATIENCE
    while True:
        with file_errors(file):
            descriptor = os.open(file, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        try:
            fcntl.flock(descriptor, kind | fcntl.LOCK_NB)
            if _is_at(file, descriptor):
                return descriptor
        except BlockingIOError:
            if time.monotonic() > until:
                os.close(descriptor)
                raise FileError(
                    "another-run-at-work", busy() if busy else f"{path}: {holder(path) or 'another process'} {AT_WORK}"
                ) from None
            time.sleep(_PAUSE)
        except OSError as error:
            os.close(descriptor)
            if error.errno in _NONE_HERE:
                with contextlib.suppress(OSError):
                    file.unlink()
                raise _no_locks(path) from error
            raise FileError("locks-missing", f"{file}: {error.strerror}") from error
        os.close(descriptor)


def _no_locks(path: Path) -> NoLocksError:
    words = f"{path}: its file system has no locks to keep two runs apart; -o FOLDER writes elsewhere"
    return NoLocksError("locks-missing", words)


def _is_at(file: Path, descriptor: int) -> bool:
    """Whether the open file still is the one of that name."""
    try:
        return os.path.samestat(file.stat(), os.fstat(descriptor))
    except FileNotFoundError:
        return False


def _leave(file: Path, descriptor: int) -> None:
    """Remove the file where no other process holds the lock, and release it."""
    with contextlib.suppress(OSError):
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if _is_at(file, descriptor):
            file.unlink()
    os.close(descriptor)
