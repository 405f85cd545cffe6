"""The output folder of a run: all of its files appear together at the end, or none does.

Every file is written under a temporary name in the folder itself (a rename is atomic only inside one file system),
flushed to the disk and renamed into place when the run has succeeded.

A run that fails or is interrupted puts the earlier files back (what it had done is in files of other names,
:mod:`mbla.results.partial`, which the next complete result removes); signals wait while it does that, and while it
puts the new ones in place. One that is killed outright cannot; the next run in the folder does it then
(:mod:`mbla.results.disk`). Two runs of one deck into one folder exclude each other (:mod:`mbla.results.disk`).
"""

from __future__ import annotations

import atexit
import contextlib
import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any, TextIO

from mbla.errors import FileError
from mbla.process.signals import held_signals
from mbla.results.disk import (
    PREFIX,
    clear_leftovers,
    file_errors,
    flush_to_disk,
    locked,
    mark_as_new,
    missing_folders,
    remove_folders,
    remove_new,
    temporary_path,
)

RESULT_SUFFIXES = (".h5", ".lst", ".json", ".sta")
"""files STEM + suffix that make an earlier result"""
OWN_FILES = (
    r"(\.(h5|lst|json|sta|checkpoint|html|svg|pdf|png|gif|mp4)"
    r"|_[A-Za-z0-9_.@-]+\.(vtu|csv|pvd|py|html|svg|pdf|png|gif|mp4))"
)
"""what may follow the stem in the name of a file that a result lists as its own"""


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
    secondary
        The files accompany a result and are none themselves: only files of their own names are in the way.

    Raises
    ------
    FileError
        On entry: there is a result already and ``force`` is not set, another run is at work on it, or the folder cannot
        be written to. Anywhere else: what the operating system refused, with the name of the file.
    """

    def __init__(self, folder: Path, stem: str, force: bool = False, *, secondary: bool = False) -> None:
        self.folder = folder
        self.stem = stem
        self.force = force
        self.secondary = secondary
        self._names: list[str] = []
        self._live: dict[str, TextIO] = {}
        self._aside: set[str] = set()
        self._created: list[Path] = []
        self._stale: tuple[str, ...] = ()
        self._process = 0
        self._marked = False
        self.in_place = False
        self._locks = contextlib.ExitStack()

    @property
    def names(self) -> tuple[str, ...]:
        """Files of this result so far, sorted."""
        return tuple(sorted(self._names))

    def __enter__(self) -> OutputFolder:
        try:
            with held_signals():
                self._begin()
        except BaseException:
            self._discard()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if kind is not None:
            self._discard(error)
            return
        try:
            self._flush()
            with held_signals():
                self._commit()
                self._end()
        except BaseException as refused:
            self._discard(refused)
            raise

    def refuse(self, *names: str) -> None:
        """Raise FileError now where files of these names are in the way, not after the work that would make them."""
        for name in names:
            self._refuse(name)

    def path(self, name: str) -> Path:
        """Where to write the file that will be ``name``; for libraries that write files themselves.

        Raises ValueError for a name that is not plain or was given before, FileError where it may not be replaced.
        """
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
        temporary, target = self.path(name), self.folder / name
        with held_signals(), file_errors(target):
            temporary.touch()
            self._place([name])
            self._live[name] = target.open("w", encoding="utf-8", newline="\n")
        return self._live[name]

    # --- how it begins and ends ---------------------------------------------------------------------------------

    def _begin(self) -> None:
        with file_errors(self.folder):
            self._created = missing_folders(self.folder)
            self._process = os.getpid()
            atexit.register(self._discard)  # for an interruption in the very step from the block to __exit__
            self.folder.mkdir(parents=True, exist_ok=True)
        _try_writing(self.folder, self._temporary("new", "trial"))
        if not self.secondary:
            self._locks.enter_context(locked(self.folder / f"{self.stem}.h5", required=False))
        with file_errors(self.folder):
            clear_leftovers(self.folder)
        if not self.secondary:
            self._refuse_earlier_result()
            self._stale = earlier_files(self.folder, self.stem)

    def _temporary(self, kind: str, name: str) -> Path:
        return temporary_path(self.folder / name, kind)

    def _marker(self) -> Path:
        return self._temporary("open", self.stem)

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
        """Move the earlier file away; the mark is there, which says that it still is the valid one."""
        self._aside.add(name)
        with file_errors(self.folder / name):
            (self.folder / name).replace(self._temporary("earlier", name))

    def _place(self, names: list[str]) -> None:
        """Put written files under their names, the earlier ones aside; all is marked before it is done."""
        inodes = {}
        for name in names:
            with file_errors(self.folder / name):
                if not os.path.lexists(self.folder / name):
                    inodes[name] = self._temporary("new", name).stat().st_ino
        with file_errors(self.folder):
            self._marked = True
            mark_as_new(self._marker(), inodes)
        for name in names:
            if name not in inodes:
                self._set_aside(name)
        for name in names:
            with file_errors(self.folder / name):
                self._temporary("new", name).replace(self.folder / name)

    def _flush(self) -> None:
        """All contents on the disk, before any name changes."""
        for name, stream in self._live.items():
            with file_errors(self.folder / name):
                stream.close()
                flush_to_disk(self.folder / name)
        for name in self._names:
            if name not in self._live:
                self._refuse(name)
                with file_errors(self.folder / name):
                    flush_to_disk(self._temporary("new", name))

    def _commit(self) -> None:
        self._place([name for name in self._names if name not in self._live])
        partial = partial_stem(self.stem)
        left = earlier_files(self.folder, partial) if not self.secondary and is_partial(self.folder, partial) else ()
        for name in (*self._stale, *left):
            if name not in self._names and os.path.lexists(self.folder / name):
                self._set_aside(name)
        with file_errors(self.folder):
            flush_to_disk(self.folder)
            self._marker().unlink(missing_ok=True)  # from here on the new files are the valid ones
        self.in_place = True
        for name in self._aside:
            with contextlib.suppress(OSError):  # the next run removes it
                self._temporary("earlier", name).unlink(missing_ok=True)

    def _discard(self, error: BaseException | None = None) -> None:
        """Back to how it was, once; what cannot be undone must not hide the error that led here, but is noted in it.

        The rest stays marked then, and the next run in the folder puts it back.
        """
        if self._process != os.getpid():  # ended already, or a copy of the process
            return
        with held_signals():
            for stream in self._live.values():
                with contextlib.suppress(OSError, ValueError):
                    stream.close()
            for name in self._names:
                with contextlib.suppress(OSError):
                    self._temporary("new", name).unlink(missing_ok=True)
            try:
                if self._marked:
                    self._put_back()
            except OSError:
                if error is not None:
                    error.add_note(f"{self.folder}: is not as it was before; the next run into it puts that right")
            self._end()
            remove_folders(self._created)

    def _put_back(self) -> None:
        remove_new(self.folder, self._marker())
        for name in self._aside:
            with contextlib.suppress(FileNotFoundError):  # never moved
                self._temporary("earlier", name).replace(self.folder / name)
        self._marker().unlink(missing_ok=True)

    def _end(self) -> None:
        self._process = 0
        atexit.unregister(self._discard)
        self._locks.close()


def earlier_files(folder: Path, stem: str) -> tuple[str, ...]:
    """Files that an earlier result of this deck lists as its own: plain names that start with the stem, no others."""
    listed = _record(folder, stem).get("files")
    own = re.compile(re.escape(stem) + OWN_FILES)
    names = (
        [name for name in listed if isinstance(name, str) and own.fullmatch(name)] if isinstance(listed, list) else []
    )
    return tuple(name for name in names if (folder / name).is_file() and not (folder / name).is_symlink())


def partial_stem(stem: str) -> str:
    """What the files of a stopped run begin with, in the place of the stem of its deck."""
    return f"{stem}.partial"


def is_partial(folder: Path, stem: str) -> bool:
    """Whether the result of that stem is one of a stopped run."""
    return _record(folder, stem).get("complete") is False


def _record(folder: Path, stem: str) -> dict[str, Any]:
    """The JSON record of an earlier result; empty where there is none that can be read."""
    path = folder / f"{stem}.json"
    try:
        with file_errors(path):
            found = json.loads(path.read_bytes() if os.path.lexists(path) else b"")
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _try_writing(folder: Path, trial: Path) -> None:
    """Find out before the analysis, not after it, that the folder is read-only or full."""
    with file_errors(folder):
        try:
            trial.write_bytes(b"mbla")
        finally:
            with contextlib.suppress(OSError):
                trial.unlink(missing_ok=True)
