"""The journal of a sweep: CSV, one row for each finished point, on the disk before it is reported as finished.

The file is read by ``pandas.read_csv(path, comment="#")``. It appears complete with its header; each row is one write,
synced when ``add`` returns. Only the last row can be torn, by a kill or a loss of power, and that one was not reported
yet: it is cut off when the journal is continued. An unsharded run is alone in its folder; shards, parts of a sweep that
jobs of an array solve on their own, have a journal each and share it.
"""

from __future__ import annotations

import contextlib
import csv
import io
import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, NamedTuple

from mbla.errors import FileError, Notice, UsageError
from mbla.process.signals import held_signals
from mbla.results.disk import AT_WORK, file_errors, flush_to_disk, holder, locked, missing_folders, write_complete
from mbla.sweeps.identity import difference
from mbla.sweeps.plan import DONE, FAILED, Plain, PointOutcome, Task
from mbla.sweeps.tables.sweep_table import READ_CELL

FORMAT = 3
"""of journals; a program with another one does not continue them"""
FIRST = ("key", "number", "state", "exit_code", "reason", "tries", "seconds")
"""columns before those of results"""
SETTINGS = "settings"
"""column after them: values by key path as JSON"""
SINGLE = "journal.csv"
"""name of the journal of a run that is no shard"""
BEGIN_ANEW = "--force starts over and drops its content, -o FOLDER writes elsewhere"
_SHARD = re.compile(r"journal\.(?P<part>[1-9][0-9]*)-of-(?P<parts>[1-9][0-9]*)\.csv")
_SWEEP = "sweep"
"""what is locked in the folder: alone by an unsharded run, together by shards"""


@dataclass(frozen=True)
class JournalHeader:
    """What all rows of a journal have in common.

    belongs : what it is of, in words: base deck, load cases, mbla and libraries; a run of anything else is refused
    columns : kind of each result column by its name, in order
    """

    belongs: Mapping[str, str]
    columns: Mapping[str, str]

    @property
    def all_columns(self) -> tuple[str, ...]:
        """Names of all columns of the file."""
        return (*FIRST, *self.columns, SETTINGS)


# --- rows -------------------------------------------------------------------------------------------------------------


def header_bytes(header: JournalHeader) -> bytes:
    """The first two lines: the header as a comment of JSON, and the names of the columns."""
    return f"# {json.dumps({'mbla_sweep_journal': FORMAT, **asdict(header)})}\n".encode() + _line(header.all_columns)


def row_bytes(header: JournalHeader, task: Task, outcome: PointOutcome) -> bytes:
    """The line of a point with its end."""
    first = (outcome.key, task.number, outcome.state, outcome.exit_code, outcome.reason, outcome.tries, outcome.seconds)
    return _line([*first, *map(outcome.results.get, header.columns), json.dumps(dict(task.settings))])


def _line(cells: Sequence[Plain]) -> bytes:
    """Cells as one line: white space in texts, also a line break, is a space."""
    stream = io.StringIO(newline="")
    plain = [" ".join(cell.split()) if isinstance(cell, str) else cell for cell in cells]
    csv.writer(stream, lineterminator="\n", quoting=csv.QUOTE_NONNUMERIC).writerow(plain)
    return stream.getvalue().encode("utf-8", "backslashreplace")


def read_row(header: JournalHeader, line: bytes) -> PointOutcome:
    """The point of a line; results that it has not are None.

    Raises ValueError, which says what is wrong, for an invalid line.
    """
    text = line.decode("utf-8").removesuffix("\n")
    if "\0" in text:
        raise ValueError("has NUL bytes")
    (cells,) = csv.reader([text], strict=True) if text else ([],)
    if len(cells) != len(header.all_columns):
        raise ValueError("has another number of columns than the journal")
    key, _, state, code, reason, tries, seconds = cells[: len(FIRST)]
    if state not in (DONE, FAILED):
        raise ValueError(f"is no row of a journal: state {state[:20]!r}")
    try:
        results = {
            name: READ_CELL[kind](cell) if cell else None
            for (name, kind), cell in zip(header.columns.items(), cells[len(FIRST) : -1], strict=True)
        }
    except KeyError as error:
        raise ValueError(f"is no row of a journal: {error}") from None
    return PointOutcome(key, state, int(code), reason, results, int(tries), float(seconds))


class JournalRows(NamedTuple):
    """Finished points of a journal by key, bytes up to the end of its last complete row, and bytes after that."""

    finished: dict[str, PointOutcome]
    complete: int
    torn: int


def read_journal(path: Path, header: JournalHeader) -> JournalRows:
    """Every complete row of a journal.

    Raises FileError where it cannot be read, is of another sweep than ``header`` says, or has a broken row before the
    last.
    """
    finished: dict[str, PointOutcome] = {}
    with file_errors(path), path.open("rb") as stream:
        complete = _check_header(path, header, stream.readline(), stream.readline())
        for number, line in enumerate(stream, start=3):
            try:
                outcome = read_row(header, line)
            except (ValueError, csv.Error) as error:
                if not stream.peek(1):
                    break
                remedy = "put back the file as it was, or delete the line, so that its point is solved again"
                raise FileError("journal-damaged", f"{path}:{number}: this row {error}; {remedy}") from None
            if not line.endswith(b"\n"):
                break
            keep(finished, outcome)
            complete += len(line)
        return JournalRows(finished, complete, os.fstat(stream.fileno()).st_size - complete)


def keep(finished: dict[str, PointOutcome], outcome: PointOutcome) -> None:
    """The outcome in its place: the last one of a point counts, but none that failed after one that is done."""
    earlier = finished.get(outcome.key)
    if earlier is None or outcome.state != FAILED or earlier.state == FAILED:
        finished[outcome.key] = outcome


def merged(paths: Iterable[Path], header: JournalHeader) -> dict[str, PointOutcome]:
    """Finished points of several journals, each once; they are left as they are. Raises as ``read_journal``."""
    finished: dict[str, PointOutcome] = {}
    for path in paths:
        for outcome in read_journal(path, header).finished.values():
            keep(finished, outcome)
    return finished


def _check_header(path: Path, header: JournalHeader, first: bytes, second: bytes) -> int:
    """Bytes of the header. Raises FileError where it is not the wanted one."""
    try:
        record: Any = json.loads(first.decode("utf-8").removeprefix("# "))
        if record.pop("mbla_sweep_journal") != FORMAT:
            raise ValueError
        found = JournalHeader(**record)
        if second != _line(found.all_columns):
            raise ValueError
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        words = f"{path}: is no journal of a sweep of format {FORMAT}; {BEGIN_ANEW}"
        raise FileError("journal-damaged", words) from error
    ours, theirs = ({**each.belongs, "results": " ".join(each.columns)} for each in (header, found))
    if other := difference(ours, theirs):
        words = f"{path}: of another sweep ({other}): it cannot be continued; {BEGIN_ANEW}"
        raise FileError("journal-of-another-sweep", words)
    return len(first) + len(second)


# --- shards -----------------------------------------------------------------------------------------------------------


def journal_name(part: int | str, parts: int | str) -> str:
    """Name of the journal of a shard; with ``*`` for both a pattern of all such names."""
    return f"journal.{part}-of-{parts}.csv"


def journals_in(folder: Path) -> tuple[Path, ...]:
    """Every journal in a folder, that of unsharded runs first, then those of shards by number of parts and part."""
    try:
        names = [path.name for path in folder.iterdir()]
    except (FileNotFoundError, NotADirectoryError):
        return ()
    shards = sorted((int(at["parts"]), int(at["part"]), at[0]) for at in filter(None, map(_SHARD.fullmatch, names)))
    return tuple(folder / name for name in (*([SINGLE] if SINGLE in names else []), *(name for *_, name in shards)))


# --- writing ----------------------------------------------------------------------------------------------------------


@dataclass
class Journal:
    """A journal that is being written.

    finished   : by key the outcome of every point of the journals that are continued, and of those added since
    notices    : what was repaired
    descriptor : of the open file
    """

    path: Path
    header: JournalHeader
    finished: dict[str, PointOutcome]
    notices: tuple[Notice, ...]
    descriptor: int

    def add(self, task: Task, outcome: PointOutcome) -> None:
        """Write the row of a finished point; it is on the disk when this returns.

        Raises FileError where it could not be written; the journal ends with its last complete row then, or will when
        it is continued.
        """
        row = row_bytes(self.header, task, outcome)
        kept = read_row(self.header, row)  # before the row is written: an interruption then hardly ever comes between
        end = os.fstat(self.descriptor).st_size
        try:
            with file_errors(self.path):
                left = memoryview(row)
                while left:  # a full disk takes a part first, and refuses the rest
                    left = left[os.write(self.descriptor, left) :]
                os.fsync(self.descriptor)
        except BaseException:
            with contextlib.suppress(OSError):  # the rest of the row is cut off when the journal is continued
                os.ftruncate(self.descriptor, end)
            raise
        self.finished[outcome.key] = kept


@contextlib.contextmanager
def open_journal(
    path: Path, header: JournalHeader, *, resume: bool, force: bool, retry_failed: bool = False
) -> Iterator[Journal]:
    """The journal in a ``with`` block, which no other process writes, and an unsharded run is alone in its folder.

    path         : ``journal.csv`` of an unsharded run, else as ``journal_name``; its folder is made if missing
    resume       : continue it where it is there; points that any journal of the folder has are finished
    force        : begin anew: the earlier journal is replaced, and an unsharded run removes those of shards as well
    retry_failed : points that failed are not finished; their rows stay, and the last one of a point counts

    Raises UsageError for both ``resume`` and ``force``, FileError where another run is at work, a journal is in the
    way, is of another sweep or program, has a broken row, or cannot be written.
    """
    if resume and force:
        raise UsageError("sweep-option", "--resume continues the journal and --force starts over: one of them")
    folder, shard = path.parent, _SHARD.fullmatch(path.name) is not None
    with contextlib.ExitStack() as stack:
        _hold(stack, path, shared=shard)
        others = [each for each in journals_in(folder) if each != path]
        earlier = [each for each in (path, *(() if shard else others)) if os.path.lexists(each)]
        if earlier and not resume and not force:
            raise FileError("sweep-exists", f"{earlier[0]}: exists already; --resume continues it, {BEGIN_ANEW}")
        own = read_journal(path, header) if resume and path in earlier else None
        finished = {} if own is None else own.finished
        for outcome in merged(others if resume else (), header).values():
            keep(finished, outcome)
        if own is None:
            _begin(path, header, () if resume else earlier)
        with file_errors(path):
            descriptor = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CLOEXEC)
            stack.callback(os.close, descriptor)
            if own is not None:
                os.ftruncate(descriptor, own.complete)
                os.fsync(descriptor)
        if retry_failed:
            finished = {key: outcome for key, outcome in finished.items() if outcome.state != FAILED}
        torn = 0 if own is None else own.torn
        words = f"{path}: its last row was incomplete and was cut off ({torn} bytes); the point is solved again"
        notices = (Notice("notice", "journal-repaired", words),) if torn else ()
        yield Journal(path, header, finished, notices, descriptor)


def _begin(path: Path, header: JournalHeader, earlier: Sequence[Path]) -> None:
    """An empty journal, in place of earlier ones only once its header is complete."""
    write_complete(path, header_bytes(header))
    with file_errors(path.parent):
        flush_to_disk(path.parent)
    for each in earlier:
        if each != path:
            with file_errors(each):
                each.unlink()


def _hold(stack: contextlib.ExitStack, path: Path, *, shared: bool) -> None:
    """The folder of a journal, with names that outlast a loss of power, and the journal; held until the stack ends."""
    folder = path.parent
    with file_errors(folder):
        missing = missing_folders(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for each in missing:
            flush_to_disk(each.parent)
    with held_signals():
        stack.enter_context(locked(folder / _SWEEP, shared=shared, busy=lambda: _who_is_in(folder)))
        stack.enter_context(locked(path))


def _who_is_in(folder: Path) -> str:
    busy = [f"{path}: {who} {AT_WORK}" for path in journals_in(folder) if (who := holder(path))]
    return "\n".join(busy) or f"{folder}: another sweep {AT_WORK}"
