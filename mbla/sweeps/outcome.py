"""What came of a point, as plain data: one row of the journal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mbla.sweeps.plan import Plain

DONE, FAILED = "done", "failed"


@dataclass(frozen=True)
class Outcome:
    """One finished point.

    key       : of its task
    state     : ``done`` where every load case has a verified answer, which may be that there is no load factor;
                ``failed`` otherwise
    exit_code : that ``mbla run`` of the same deck would end with; 7 beyond a limit of time or memory, 1 where the
                process of the point died twice
    reason    : in one line; empty where there is nothing to say
    results   : value of each result column by its name; None where there is none
    tries     : how often it was begun
    seconds   : by the clock, of the last try
    """

    key: str
    state: str
    exit_code: int
    reason: str
    results: Mapping[str, Plain]
    tries: int
    seconds: float
