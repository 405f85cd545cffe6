"""Everything a run found: what result files, listing and JSON are written from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.errors import Message, Notice
from mbla.model.model import LoadCase, Model
from mbla.results.assessment import Assessment
from mbla.solution.further.further import Further
from mbla.solution.solution import Checks, Solution, Status

if TYPE_CHECKING:
    from mbla.solution.time_history.checkpoint import Unfinished


def now() -> str:
    """Date and time in UTC to the second, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")


@dataclass(frozen=True)
class DeckRecord:
    """The deck as the result file keeps it: everything that it is made of.

    name      : of the main file
    sources   : name and text of the main file and of those that it includes; names from the folder of the main file
    overrides : ``key.path=value`` texts
    sha256    : hash of the effective deck, its texts and overrides
    files     : name and content of the meshes and tables that it names
    """

    name: str
    sources: tuple[tuple[str, str], ...]
    overrides: tuple[str, ...]
    sha256: str
    files: tuple[tuple[str, bytes], ...] = ()


@dataclass(frozen=True)
class CaseResult:
    """One load case with its solution, verification and final status (never better than verification allows).

    assessment : what a code says of it; None where none is asked
    checkpoint : of one that is at work in time, from where it can go on; in no result file
    """

    load_case: LoadCase
    solution: Solution
    checks: Checks
    status: Status
    assessment: Assessment | None = None
    checkpoint: Unfinished | None = field(default=None, compare=False)

    def with_further(self, further: Further, remarks: Sequence[Message]) -> CaseResult:
        """The same case with further results beside its answer, and what these have to say."""
        return replace(self, solution=self.solution.with_further(further, remarks))

    @property
    def by_path(self) -> bool:
        """Whether the state shown is one of the path of elastic joints."""
        return not math.isnan(self.checks.elastic_residual)


@dataclass(frozen=True)
class PathAgain:
    """A path of elastic joints that a verification followed anew, beside a figure of the file.

    case          : name of the load case
    ratio         : shear over normal stiffness of the joints on it
    load_factor   : the greatest on it; nan: it does not show, inf: nothing gives way
    ratio_in_file, in_file : that of the joints, and the load factor that the file has for them
    off           : difference of the load factors, or of the reactions that they stand for, over that
    allowed       : the most of it with which they agree
    agrees        : whether the path confirms the figure
    """

    case: str
    ratio: float
    load_factor: float
    ratio_in_file: float
    in_file: float
    off: float
    allowed: float
    agrees: bool


@dataclass(frozen=True)
class PushoverAgain:
    """A pushover that a verification followed anew, beside that of the file.

    case    : name of the load case
    steps, steps_in_file : of both
    end     : why the one followed anew ends
    off, at : greatest difference of load factors, over the greatest of them, and the displacement there, m
    allowed : the most of it with which they agree
    others  : what else differs: its end, its energies, its errors, where it jumps, the blocks that fall
    agrees  : whether the one followed anew confirms the other
    """

    case: str
    steps: int
    steps_in_file: int
    end: str
    off: float
    at: float
    allowed: float
    others: tuple[str, ...]
    agrees: bool


@dataclass(frozen=True)
class Results:
    """A complete run.

    provenance : versions and platform by name; ``mbla`` is the version of the program (see ``collect_provenance``)
    settings   : the analysis settings in effect, by name
    time       : seconds by stage (read, contacts, soil, solve, write); parts of a stage as ``solve/standing``
    exit_code  : exit status of the run
    created    : date of the run, UTC, ISO 8601
    files      : names of the files that were written for it, in its folder
    complete   : whether the run completed
    not_done   : requested load cases that it did not reach
    unconfirmed : of a verification: what its deck asks for and it lacks, or states, and nothing in it shows; in words
    paths_again : of a verification: paths that it followed anew; None where it was not asked to
    pushovers_again : of a verification: pushovers that it followed anew, likewise
    """

    deck: DeckRecord
    assembly: Assembly
    cases: tuple[CaseResult, ...]
    notices: tuple[Notice, ...]
    provenance: dict[str, str]
    settings: dict[str, str]
    time: dict[str, float]
    exit_code: int
    created: str = field(default_factory=now)
    files: tuple[str, ...] = ()
    complete: bool = True
    not_done: tuple[str, ...] = ()
    unconfirmed: tuple[str, ...] = ()
    paths_again: tuple[PathAgain, ...] | None = None
    pushovers_again: tuple[PushoverAgain, ...] | None = None

    @property
    def model(self) -> Model:
        """With the load cases as they were solved."""
        return self.assembly.model

    @property
    def contacts(self) -> Contacts:
        """As found."""
        return self.assembly.contacts

    def case(self, name: str) -> CaseResult:
        """The case of that name; raises KeyError if there is none."""
        for case in self.cases:
            if case.load_case.name == name:
                return case
        raise KeyError(name)

    @property
    def without_result(self) -> tuple[str, ...]:
        """Names of load cases of the deck that have none."""
        known = {case.load_case.name for case in self.cases}
        return tuple(case.name for case in self.model.load_cases if case.name not in known)
