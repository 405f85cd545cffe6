"""What stands above the rows of a journal: which sweep of which program it belongs to, and the names of its columns."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from mbla.sweeps.identity import difference as other_versions
from mbla.sweeps.journal.cells import quoted

FORMAT = 1
"""of journals; a program with another one does not go on with them"""
FIRST = ("key", "number", "state", "exit_code", "reason", "tries", "seconds")
"""columns before those of results"""
LAST = ("settings", "check")
"""columns after them: values by key path as JSON, and the check sum of the row"""
BEGIN_ANEW = "--force begins anew and drops what it holds, -o FOLDER writes elsewhere"


@dataclass(frozen=True)
class JournalHeader:
    """What all rows of a journal have in common.

    program     : version and hash of the mbla that solves the points
    fingerprint : hash of the base deck's content
    columns     : names of the result columns, in order
    title       : of the sweep, for human readers
    cases       : load cases that are solved; all if empty
    libraries   : versions of those on which the digits of answers depend, by name
    """

    program: str
    fingerprint: str
    columns: tuple[str, ...]
    title: str = ""
    cases: tuple[str, ...] = ()
    libraries: Mapping[str, str] = field(default_factory=dict)

    @property
    def all_columns(self) -> tuple[str, ...]:
        """Names of all columns of the file."""
        return (*FIRST, *self.columns, *LAST)


def header_text(header: JournalHeader) -> str:
    """The first two lines: the header as a comment of JSON, and the names of the columns."""
    names = ",".join(quoted(name) if set(name) & set('",#') else name for name in header.all_columns)
    return f"# {json.dumps({'mbla_sweep_journal': FORMAT, **asdict(header)})}\n{names}\n"


def read_header(line: str) -> JournalHeader:
    """The header from the first line of a journal.

    Raises
    ------
    ValueError
        it is no header of this format; the message says what it is instead
    """
    try:
        record: Any = json.loads(line.removeprefix("# ")) if line.startswith("# {") else None
    except ValueError:
        record = None
    if not isinstance(record, dict) or "mbla_sweep_journal" not in record:
        raise ValueError("is no journal of a sweep")
    if record["mbla_sweep_journal"] != FORMAT:
        raise ValueError(f"is a journal of format {record['mbla_sweep_journal']}; this mbla has format {FORMAT}")
    try:
        lists = {name: tuple(map(str, record[name])) for name in ("columns", "cases")}
        program, fingerprint, title = (str(record[name]) for name in ("program", "fingerprint", "title"))
        libraries = {str(name): str(version) for name, version in record["libraries"].items()}
    except (KeyError, TypeError, AttributeError):
        raise ValueError("is no whole journal of a sweep") from None
    return JournalHeader(program, fingerprint, lists["columns"], title, lists["cases"], libraries)


def difference(found: JournalHeader, wanted: JournalHeader) -> str:
    """What keeps a sweep from going on with a journal, in words; empty where nothing does."""
    words: list[str] = []
    if found.program != wanted.program:
        words.append(f"was written by mbla {found.program}, this is {wanted.program}")
    if other := other_versions(wanted.libraries, found.libraries):
        words.append(f"was written with other libraries ({other})")
    if found.fingerprint != wanted.fingerprint:
        words.append("is of another base deck, or of one that has changed since")
    if found.cases != wanted.cases:
        words.append(f"is of {_cases(found.cases)}, not of {_cases(wanted.cases)}")
    if found.columns != wanted.columns:
        words.append(_other_columns(found.columns, wanted.columns))
    return "; ".join(words)


def _cases(names: Sequence[str]) -> str:
    return f"load case {', '.join(names)}" if names else "all load cases"


def _other_columns(found: Sequence[str], wanted: Sequence[str]) -> str:
    missing = [name for name in wanted if name not in found]
    more = [name for name in found if name not in wanted]
    words = [f"has no result {', '.join(missing)}"] if missing else []
    words += [f"has also {', '.join(more)}"] if more else []
    return ", ".join(words) or "has its results in another order"
