"""The journal of a run: opened under a lock, one row added for each finished point.

The file is CSV (``pandas.read_csv(path, comment="#")``). It appears whole with its header; each row is one write, on
the disk when ``add`` returns. After a kill or a loss of power at most the last row is torn, and nobody was told of that
one; it is cut off when the journal is gone on with.
"""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType

from mbla.errors import FileError, Notice, UsageError
from mbla.process.signals import held_signals
from mbla.results.disk import file_errors, flush_to_disk, missing_folders
from mbla.results.leftovers import temporary_path
from mbla.results.lock import AT_WORK, holder, lock_path, locked
from mbla.sweeps.journal.header import BEGIN_ANEW, JournalHeader, header_text
from mbla.sweeps.journal.reading import keep, merged, read_journal
from mbla.sweeps.journal.rows import read_row, row_of
from mbla.sweeps.journal.shards import is_of_shard, journal_name, journals_in
from mbla.sweeps.plan import FAILED, Outcome, Task

_SWEEP = "sweep"
"""what is locked in the folder: alone by a whole run, together by shards"""


class Journal:
    """Context manager; inside it nobody else writes this journal, and a whole run is alone in its folder.

    finished : the outcome of every finished point by its key: what the journals of the folder held on entry, where they
               are gone on with, and what was added since; results without a value are None
    notices  : what was repaired

    Parameters
    ----------
    path
        ``journal.csv`` of a whole run, or as ``journal_name`` for a shard; its folder is made if missing.
    resume
        Go on with this journal, and take the finished points of every other one in the folder as finished, whatever
        shards they are of. Where there is none, it begins.
    force
        Begin anew: the earlier journal is replaced by the new one, and a whole run removes those of shards as well.
    retry_failed
        Points that failed are not finished; their rows stay, and the last one of a point counts.

    Raises
    ------
    UsageError
        Both ``resume`` and ``force``: one keeps what the other drops.
    FileError
        On entry: another run is at work; there is a journal and neither ``resume`` nor ``force`` is set; it is of
        another sweep or program, or has a broken row; it cannot be written.
    """

    def __init__(
        self, path: Path, header: JournalHeader, *, resume: bool, force: bool, retry_failed: bool = False
    ) -> None:
        if resume and force:
            raise UsageError("sweep-option", "--resume goes on with the journal and --force begins anew: one of them")
        self.path = path
        self.header = header
        self.finished: dict[str, Outcome] = {}
        self.notices: tuple[Notice, ...] = ()
        self._resume, self._force, self._retry = resume, force, retry_failed
        self._open = contextlib.ExitStack()
        self._one_at_a_time = threading.Lock()
        self._descriptor = -1
        self._end = 0
        self._broken = ""

    def __enter__(self) -> Journal:
        with contextlib.ExitStack() as stack:
            _make_folder(self.path.parent)
            with held_signals():
                self._take_locks(stack)
            self._begin()
            with file_errors(self.path):
                self._descriptor = os.open(self.path, os.O_RDWR | os.O_APPEND | os.O_CLOEXEC)
                stack.callback(os.close, self._descriptor)
                if self._end:
                    os.ftruncate(self._descriptor, self._end)
                    os.fsync(self._descriptor)
                self._end = os.fstat(self._descriptor).st_size
            self._open = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._open.close()

    def add(self, task: Task, outcome: Outcome) -> None:
        """Write the row of a finished point; it is on the disk when this returns.

        Raises
        ------
        FileError
            it could not be written; the journal ends with its last whole row then, or will when it is gone on with
        ValueError
            the point is finished already, or of another sweep
        """
        row = row_of(self.header, task, outcome)
        kept = read_row(self.header, row)  # before the row is written: an interruption then hardly ever comes between
        with self._one_at_a_time:
            if outcome.key in self.finished:
                raise ValueError(f"point {task.number} is finished already")
            if self._broken:
                raise FileError("journal-changed", self._broken)
            self._check_nobody_else_wrote()
            try:
                with file_errors(self.path):
                    self._write(row)
            except BaseException:
                self._cut_back()
                raise
            self._end += len(row)
            self.finished[outcome.key] = kept

    # --- how it begins ----------------------------------------------------------------------------------------------

    def _take_locks(self, stack: contextlib.ExitStack) -> None:
        folder, shard = self.path.parent, is_of_shard(self.path)
        stack.enter_context(locked(folder / _SWEEP, shared=shard, busy=lambda: _who_is_in(folder)))
        stack.enter_context(locked(self.path))
        if not shard:
            _remove_locks_of_killed_shards(folder)

    def _begin(self) -> None:
        """The file in place with a whole header, and what is finished already."""
        others = [path for path in journals_in(self.path.parent) if path != self.path]
        replaced = [self.path] if is_of_shard(self.path) else [self.path, *others]  # by a run that begins anew
        earlier = [path for path in replaced if os.path.lexists(path)]
        if self._resume:
            return self._go_on(others)
        if earlier and not self._force:
            raise FileError("sweep-exists", f"{earlier[0]}: exists already; --resume goes on with it, {BEGIN_ANEW}")
        self._create()
        for path in earlier:
            if path != self.path:
                with file_errors(path):
                    path.unlink()

    def _go_on(self, others: Iterable[Path]) -> None:
        finished: dict[str, Outcome] = {}
        if os.path.lexists(self.path):
            rows = read_journal(self.path, self.header)
            finished, self._end = rows.finished, rows.whole
            self.notices = _repaired(self.path, rows.torn)
        for outcome in merged(others, self.header).values():
            keep(finished, outcome)
        retried = {FAILED} if self._retry else set()
        self.finished = {key: outcome for key, outcome in finished.items() if outcome.state not in retried}
        if not self._end:
            self._create()

    def _create(self) -> None:
        """A journal with nothing but its header, in place of an earlier one only once it is whole."""
        temporary = temporary_path(self.path)
        try:
            with file_errors(self.path):
                temporary.write_bytes(header_text(self.header).encode("utf-8"))
                flush_to_disk(temporary)
                temporary.replace(self.path)
                flush_to_disk(self.path.parent)
        except BaseException:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
            raise

    # --- how it grows -----------------------------------------------------------------------------------------------

    def _check_nobody_else_wrote(self) -> None:
        """A journal that was removed, replaced or edited meanwhile gets no row that would be lost with it."""
        with file_errors(self.path):
            there, ours = self.path.stat(), os.fstat(self._descriptor)
        if not os.path.samestat(there, ours) or ours.st_size != self._end:
            raise FileError(
                "journal-changed", f"{self.path}: was changed by another program while this one was writing it"
            )

    def _write(self, row: bytes) -> None:
        left = memoryview(row)
        while left:  # a full disk takes a part first, and refuses the rest
            left = left[os.write(self._descriptor, left) :]
        try:
            os.fsync(self._descriptor)
        except OSError:  # what is on the disk is not known then, and asking again would not tell (fsync(2))
            self._broken = f"{self.path}: the disk did not take a row; what is in it before that is whole"
            raise

    def _cut_back(self) -> None:
        """No part of a row stays that was not reported; where that fails as well, going on with the journal does it."""
        try:
            os.ftruncate(self._descriptor, self._end)
        except OSError as error:
            self._broken = self._broken or f"{self.path}: ends with a part of a row: {error.strerror}"


def _make_folder(folder: Path) -> None:
    """The folder, with names that outlast a loss of power."""
    with file_errors(folder):
        missing = missing_folders(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for path in missing:
            flush_to_disk(path.parent)


def _remove_locks_of_killed_shards(folder: Path) -> None:
    """Nobody holds one while a whole run is alone in the folder."""
    for path in folder.glob(lock_path(folder / journal_name("*", "*")).name):
        with contextlib.suppress(OSError):  # an empty file that stays does no harm
            path.unlink()


def _who_is_in(folder: Path) -> str:
    holders = [(path, holder(path)) for path in journals_in(folder)]
    told = [f"{path}: {who} {AT_WORK}" for path, who in holders if who]
    return "\n".join(told) or f"{folder}: another sweep {AT_WORK}"


def _repaired(path: Path, torn: int) -> tuple[Notice, ...]:
    words = f"{path}: its last row was not whole and was cut off ({torn} bytes); the point is solved again"
    return (Notice("notice", "journal-repaired", words),) if torn else ()
