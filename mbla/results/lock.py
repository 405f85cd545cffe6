"""Locks that keep two runs off one journal, or one result.

A lock is one of the operating system (flock) on a file of its own beside what it keeps: it ends with the process that
holds it, however that ends, so that none is ever left behind. The file says who holds it; it is removed at the end, and
one that a killed process left is in nobody's way.

Over NFS the lock holds between machines (Linux has it from the server since 2.6.12) unless the file system was mounted
with ``local_lock``; Lustre has locks where it was mounted with ``flock``. Where there are none a sweep is refused; a
run of one deck goes on without.
"""

from __future__ import annotations

import contextlib
import errno
import os
import socket
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from mbla.errors import FileError
from mbla.results.disk import file_errors

if sys.platform != "win32":
    import fcntl

_NONE_HERE = (errno.ENOSYS, errno.EOPNOTSUPP, errno.ENOLCK)
"""errors of file systems without locks"""
AT_WORK = "is at work on it; wait for its end or stop it"
PATIENCE = 0.3
"""seconds before a lock counts as held: a run that ends, or asks who holds it, has it for an instant"""
_PAUSE = 0.02
_WORDS = 200
"""bytes that are read of who holds a lock"""


def lock_path(path: Path) -> Path:
    """The file that is locked for this one: hidden, beside it."""
    return path.with_name(f".{path.name}.lock")


class NoLocksError(FileError):
    """The file system, or the operating system, has no locks."""


@contextlib.contextmanager
def locked(
    path: Path, *, shared: bool = False, busy: Callable[[], str] | None = None, required: bool = True
) -> Iterator[None]:
    """Hold the lock of ``path`` inside the block.

    shared   : others may hold it shared at the same time
    busy     : what is said where another process holds it; unless given, who that is
    required : whether to refuse where there are no locks; without one nothing keeps others off

    Raises
    ------
    FileError
        another process holds it, or the file system has no locks
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
    """Who holds the lock of a file alone, in words; None if nobody does."""
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
    """Remove the file where nobody else holds the lock as well, and let go."""
    with contextlib.suppress(OSError):
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if _is_at(file, descriptor):
            file.unlink()
    os.close(descriptor)
