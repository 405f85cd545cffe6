"""The output folder of a run: all of its files appear together at the end, or none does.

Every file is written under a temporary name in the folder itself (a rename is atomic only inside one file system),
flushed to the disk and renamed into place when the run has succeeded. Temporary names are

    ``.mbla-HOST-PID-new-NAME``       a file that is being written
    ``.mbla-HOST-PID-earlier-NAME``   the file that NAME replaces, until the run is complete
    ``.mbla-HOST-PID-open``           there while earlier files are aside: they still are the valid ones

A run that fails or is interrupted puts the earlier files back. One that is killed outright cannot; the next run in the
folder does it then, for every process of this machine that no longer exists.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import socket
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import TextIO

from mbla.errors import FileError

PREFIX = ".mbla-"
RESULT_SUFFIXES = (".h5", ".lst", ".json", ".sta")
"""files STEM + suffix that make an earlier result"""
OWN_FILES = r"(\.(h5|lst|json|sta|html|svg|pdf|png|gif|mp4)|_[A-Za-z0-9_.-]+\.(vtu|pvd|py|html|svg|pdf|png|gif|mp4))"
"""what may follow the stem in the name of a file that a result lists as its own"""
_TEMPORARY = re.compile(
    re.escape(PREFIX) + r"(?P<host>.+)-(?P<process>\d+)-(?P<kind>new|earlier|open)(?:-(?P<name>.+))?"
)


class OutputFolder:
    """Context manager; the files written inside it are in place when it is left without an exception, and not before.

    Parameters
    ----------
    folder
        Created if missing, with its parents.
    stem
        Name of the deck without suffix; ``STEM.h5`` and so on make its result.
    force
        Replace an earlier result of this deck. Files which that result lists as its own and the new one does not write
        are removed; nothing else ever is.
    beside
        The files stand beside a result and are none themselves: only files of their own names are in the way.

    Raises
    ------
    FileError
        On entry: there is a result already and ``force`` is not set, or the folder cannot be written to. Anywhere
        else: what the operating system refused, with the name of the file.
    """

    def __init__(self, folder: Path, stem: str, force: bool = False, *, beside: bool = False) -> None:
        self.folder = folder
        self.stem = stem
        self.force = force
        self.beside = beside
        self._names: list[str] = []
        self._live: dict[str, TextIO] = {}
        self._aside: set[str] = set()
        self._placed: set[str] = set()
        self._created: list[Path] = []
        self._stale: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Files of this result so far, sorted."""
        return tuple(sorted(self._names))

    def __enter__(self) -> OutputFolder:
        with file_errors(self.folder):
            self._created = missing_folders(self.folder)
            self.folder.mkdir(parents=True, exist_ok=True)
            _clear_leftovers(self.folder)
        try:
            if not self.beside:
                self._refuse_earlier_result()
                self._stale = earlier_files(self.folder, self.stem)
            _try_writing(self.folder, self._temporary("new", "trial"))
        except BaseException:
            self._remove_created_folders()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if kind is None:
            try:
                self._commit()
            except BaseException:
                self._discard()
                raise
        else:
            self._discard()

    def refuse(self, *names: str) -> None:
        """Raise FileError now where files of these names are in the way, not after the work that would make them."""
        for name in names:
            self._refuse(name)

    def path(self, name: str) -> Path:
        """Where to write the file that will be ``name``; for libraries that write files themselves."""
        if not name or Path(name).name != name or name.startswith(PREFIX):
            raise ValueError(f"not a plain file name: {name!r}")
        if name in self._names:
            raise ValueError(f"{name} is written twice")
        self._refuse(name)
        self._names.append(name)
        return self._temporary("new", name)

    @contextlib.contextmanager
    def writing(self, name: str) -> Iterator[Path]:
        """``path(name)`` for a ``with`` block whose errors of the operating system name the file."""
        temporary = self.path(name)
        with file_errors(self.folder / name):
            yield temporary

    def write_bytes(self, name: str, data: bytes) -> None:
        """Write one file."""
        with self.writing(name) as path:
            path.write_bytes(data)

    def write_text(self, name: str, text: str) -> None:
        """Write one text file, UTF-8 with newlines as they are."""
        self.write_bytes(name, text.encode("utf-8"))

    def open_live(self, name: str) -> TextIO:
        """Open a text file under its final name, to be watched while it grows; the earlier one waits aside."""
        self.path(name)
        target = self.folder / name
        with file_errors(target):
            if os.path.lexists(target):
                self._set_aside(name)
            self._placed.add(name)
            stream = target.open("w", encoding="utf-8", newline="\n")
        self._live[name] = stream
        return stream

    # --- how it begins and ends ---------------------------------------------------------------------------------

    def _temporary(self, kind: str, name: str) -> Path:
        return temporary_path(self.folder / name, kind)

    def _marker(self) -> Path:
        return self.folder / f"{PREFIX}{_host()}-{os.getpid()}-open"

    def _refuse(self, name: str) -> None:
        target = self.folder / name
        if target.is_dir():
            raise FileError("folder-given", f"{target}: is a folder")
        if not self.force and os.path.lexists(target):
            raise FileError(
                "result-exists", f"{target}: exists already; --force (in Python force=True) replaces an earlier result"
            )

    def _refuse_earlier_result(self) -> None:
        for suffix in RESULT_SUFFIXES:
            self._refuse(self.stem + suffix)

    def _set_aside(self, name: str) -> None:
        """Move the earlier file away, after the mark that says it is still the valid one."""
        if not self._aside:
            self._marker().touch()
        (self.folder / name).replace(self._temporary("earlier", name))
        self._aside.add(name)

    def _commit(self) -> None:
        for name, stream in self._live.items():
            with file_errors(self.folder / name):
                stream.close()
                flush_to_disk(self.folder / name)
        written = [name for name in self._names if name not in self._live]
        for name in written:
            self._refuse(name)
            with file_errors(self.folder / name):
                flush_to_disk(self._temporary("new", name))
        replaced = {name for name in (*written, *self._stale) if os.path.lexists(self.folder / name)}
        for name in sorted(replaced - set(self._live)):
            with file_errors(self.folder / name):
                self._set_aside(name)
        for name in written:
            with file_errors(self.folder / name):
                self._placed.add(name)
                self._temporary("new", name).replace(self.folder / name)
        with file_errors(self.folder):
            flush_to_disk(self.folder)
            self._marker().unlink(missing_ok=True)  # from here on the new files are the valid ones
            for name in self._aside:
                self._temporary("earlier", name).unlink(missing_ok=True)

    def _discard(self) -> None:
        """Back to how it was; what cannot be undone must not hide the error that led here."""
        for stream in self._live.values():
            with contextlib.suppress(OSError, ValueError):
                stream.close()
        for name in self._names:
            with contextlib.suppress(OSError):
                self._temporary("new", name).unlink(missing_ok=True)
        for name in self._placed - self._aside:
            with contextlib.suppress(OSError):
                (self.folder / name).unlink(missing_ok=True)
        for name in self._aside:
            with contextlib.suppress(OSError):
                self._temporary("earlier", name).replace(self.folder / name)
        with contextlib.suppress(OSError):
            self._marker().unlink(missing_ok=True)
        self._remove_created_folders()

    def _remove_created_folders(self) -> None:
        for folder in self._created:
            with contextlib.suppress(OSError):
                folder.rmdir()


def earlier_files(folder: Path, stem: str) -> tuple[str, ...]:
    """Files that an earlier result of this deck lists as its own: plain names that start with the stem, no others."""
    try:
        listed = json.loads((folder / f"{stem}.json").read_text(encoding="utf-8"))["files"]
    except (OSError, ValueError, KeyError, TypeError):
        return ()
    own = re.compile(re.escape(stem) + OWN_FILES)
    names = (
        [name for name in listed if isinstance(name, str) and own.fullmatch(name)] if isinstance(listed, list) else []
    )
    return tuple(name for name in names if (folder / name).is_file() and not (folder / name).is_symlink())


@contextlib.contextmanager
def file_errors(path: Path) -> Iterator[None]:
    """An error of the operating system becomes a FileError that names the file, as one of a temporary name does."""
    try:
        yield
    except OSError as error:
        raise FileError("file-not-written", f"{path}: {error.strerror or error}") from error
    except FileError as error:  # of what wrote it under a temporary name
        if isinstance(error.__cause__, OSError):
            raise FileError(
                "file-not-written", f"{path}: {error.__cause__.strerror or error.__cause__}"
            ) from error.__cause__
        raise


def temporary_path(path: Path, kind: str = "new") -> Path:
    """Where a file is while it is written, or the earlier one while it waits (``kind`` "earlier")."""
    return path.with_name(f"{PREFIX}{_host()}-{os.getpid()}-{kind}-{path.name}")


def _host() -> str:
    return re.sub(r"[^A-Za-z0-9.]", "_", socket.gethostname()) or "host"


def missing_folders(folder: Path) -> list[Path]:
    """Folders that ``mkdir`` will create, innermost first."""
    return [path for path in (folder, *folder.parents) if not path.exists()]


def _try_writing(folder: Path, trial: Path) -> None:
    """Find out before the analysis, not after it, that the folder is read-only or full."""
    with file_errors(folder):
        trial.write_bytes(b"mbla")
        trial.unlink()


def flush_to_disk(path: Path) -> None:
    """What was written to a file, or the names in a folder, outlasts a loss of power from here on."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _process_exists(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


def _clear_leftovers(folder: Path) -> None:
    """Undo what killed runs of this machine left: earlier files back in place if their run never became complete."""
    found = [(path, _TEMPORARY.fullmatch(path.name)) for path in sorted(folder.glob(f"{PREFIX}*"))]
    left = [(path, match) for path, match in found if match and match["host"] == _host()]
    dead = {match["process"] for _, match in left if not _process_exists(int(match["process"]))}
    unfinished = {match["process"] for _, match in left if match["kind"] == "open"} & dead
    for path, match in left:
        if match["process"] not in dead or match["kind"] == "open":
            continue
        if match["kind"] == "earlier" and match["process"] in unfinished and match["name"]:
            path.replace(folder / match["name"])
        else:
            path.unlink(missing_ok=True)
    for process in unfinished:  # last, so that being killed here changes nothing
        (folder / f"{PREFIX}{_host()}-{process}-open").unlink(missing_ok=True)
