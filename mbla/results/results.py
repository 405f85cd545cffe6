"""Everything a run found: what result files, listing and JSON are written from."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import LoadCase, Model
from mbla.solution.solution import Checks, Solution, Status


@dataclass(frozen=True)
class DeckRecord:
    """The deck as the result file keeps it: name, text of each source, overrides and hash of the effective deck."""

    name: str
    sources: tuple[tuple[str, str], ...]
    overrides: tuple[str, ...]
    sha256: str


@dataclass(frozen=True)
class CaseResult:
    """One load case with its solution, verification and final status (never better than verification allows)."""

    load_case: LoadCase
    solution: Solution
    checks: Checks
    status: Status


@dataclass(frozen=True)
class Results:
    """A whole run; ``time`` holds seconds by stage (read, contacts, solve, write)."""

    deck: DeckRecord
    model: Model
    contacts: Contacts
    cases: tuple[CaseResult, ...]
    notices: tuple[Notice, ...]
    provenance: dict[str, str]
    settings: dict[str, str]
    time: dict[str, float]
    exit_code: int
