"""Read a journal, whoever wrote it and however that ended.

Rows are written one at a time and reach the disk before the next, so only the last one can be torn: it has no end, or
after a loss of power NUL bytes in place of what had not reached the disk. Any other line that cannot be read is a
fault.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.errors import FileError
from mbla.results.disk import file_errors
from mbla.sweeps.journal.header import BEGIN_ANEW, JournalHeader, difference, header_text, read_header
from mbla.sweeps.journal.rows import read_row
from mbla.sweeps.plan import FAILED, Outcome

FAULTS_TOLD = 10
"""of broken rows; where there are more, the rest is counted"""


@dataclass(frozen=True)
class JournalRows:
    """What a journal holds.

    finished : by key; of several rows of a point the last, but a failed one never in place of one that is done
    whole    : bytes up to the end of the last whole row
    torn     : bytes after that
    """

    finished: dict[str, Outcome]
    whole: int
    torn: int


def read_journal(path: Path, header: JournalHeader) -> JournalRows:
    """Every whole row of a journal.

    Raises
    ------
    FileError
        it cannot be read, belongs to another sweep than ``header`` says, or has a broken row before the last
    """
    finished: dict[str, Outcome] = {}
    faults: list[str] = []
    with file_errors(path), path.open("rb") as stream:
        whole = _check_header(path, header, stream.readline(), stream.readline())
        for number, line in enumerate(stream, start=3):
            if not line.endswith(b"\n") or (b"\0" in line and not stream.peek(1)):
                break
            try:
                keep(finished, read_row(header, line))
            except ValueError as error:
                faults.append(f"{path}:{number}: {_words(error)}")
            whole += len(line)
        size = os.fstat(stream.fileno()).st_size
    if faults:
        raise FileError("journal-damaged", _told(faults))
    return JournalRows(finished, whole, size - whole)


def keep(finished: dict[str, Outcome], outcome: Outcome) -> None:
    """The outcome in its place: the last one of a point counts, but none that failed after one that is done."""
    earlier = finished.get(outcome.key)
    if earlier is None or outcome.state != FAILED or earlier.state == FAILED:
        finished[outcome.key] = outcome


def merged(paths: Iterable[Path], header: JournalHeader) -> dict[str, Outcome]:
    """Finished points of several journals, each once; they are left as they are, also where the last row is torn.

    Raises
    ------
    FileError
        as ``read_journal``
    """
    finished: dict[str, Outcome] = {}
    for path in paths:
        for outcome in read_journal(path, header).finished.values():
            keep(finished, outcome)
    return finished


def _check_header(path: Path, header: JournalHeader, first: bytes, second: bytes) -> int:
    """Bytes of the header. Raises FileError where it is not the wanted one."""
    try:
        if not first.endswith(b"\n"):
            raise ValueError("is no journal of a sweep")
        found = read_header(first.decode("utf-8"))
    except ValueError as error:
        words = "is no journal of a sweep" if isinstance(error, UnicodeDecodeError) else str(error)
        raise FileError("journal-damaged", f"{path}: {words}; {BEGIN_ANEW}") from error
    if words := difference(found, header):
        raise FileError("journal-of-another-sweep", f"{path}: {words}: it cannot be gone on with; {BEGIN_ANEW}")
    if second != header_text(found).encode("utf-8").partition(b"\n")[2]:
        raise FileError("journal-damaged", f"{path}:2: the names of the columns were changed; {BEGIN_ANEW}")
    return len(first) + len(second)


def _words(error: ValueError) -> str:
    said = "is not UTF-8" if isinstance(error, UnicodeDecodeError) else str(error)
    return f"this row {said}; put back the file as it was, or delete the line, so that its point is solved again"


def _told(faults: Sequence[str]) -> str:
    more = len(faults) - FAULTS_TOLD
    return "\n".join([*faults[:FAULTS_TOLD], *([f"and {more} more rows like these"] if more > 0 else [])])
