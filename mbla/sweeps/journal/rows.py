"""One row of a journal: a finished point as a line with a check sum, and back.

The check sum (CRC-32 of the line's bytes before it) tells a row that was changed outside, by a spreadsheet that rounds
numbers for one, or that the disk returns wrongly.
"""

from __future__ import annotations

import json
from zlib import crc32

from mbla.sweeps.journal.cells import cell_of, quoted, split_cells, values_of_cells
from mbla.sweeps.journal.header import FIRST, LAST, JournalHeader
from mbla.sweeps.plan import DONE, FAILED, Outcome, Plain, Task

_CHECK = 8
"""digits of the check sum"""


def row_of(header: JournalHeader, task: Task, outcome: Outcome) -> bytes:
    """The line of a point with its end.

    Raises
    ------
    ValueError
        the outcome is of another task, or has a result without a column
    """
    if task.key != outcome.key or not outcome.results.keys() <= set(header.columns):
        raise ValueError(f"the outcome of point {task.number} is not one of this sweep")
    first: list[Plain] = [outcome.key, task.number, outcome.state, outcome.exit_code, outcome.reason]
    first += [outcome.tries, float(outcome.seconds)]
    results = [outcome.results.get(name) for name in header.columns]
    cells = [cell_of(value) for value in (*first, *results)]
    cells.append(quoted(json.dumps(dict(task.settings))))
    body = ",".join(cells).encode("utf-8") + b","
    return body + b'"%08x"\n' % crc32(body)


def read_row(header: JournalHeader, line: bytes) -> Outcome:
    """The point of a line, with its end or without it; results that it has not are None.

    Raises
    ------
    ValueError
        the line is not one that ``row_of`` wrote; the message says what is wrong with it
    """
    line = line.removesuffix(b"\n")
    body, check = line[: -_CHECK - 2], line[-_CHECK - 2 :]
    if check != b'"%08x"' % crc32(body):
        raise ValueError("does not match its check sum, it was changed or damaged")
    cells = split_cells(body.decode("utf-8"))
    if len(cells) != len(FIRST) + len(header.columns) + len(LAST):
        raise ValueError("has another number of columns than the journal")
    values = values_of_cells(cells[: -len(LAST)])
    key, number, state, code, reason, tries, seconds = values[: len(FIRST)]
    texts = isinstance(key, str) and isinstance(reason, str)
    if not texts or not all(isinstance(value, int) for value in (number, code, tries)):
        raise ValueError("is no row of a journal")
    if state not in (DONE, FAILED) or not isinstance(seconds, float):
        raise ValueError("is no row of a journal")
    results = dict(zip(header.columns, values[len(FIRST) :], strict=True))
    return Outcome(key, str(state), code, reason, results, tries, seconds)  # type: ignore[arg-type]
