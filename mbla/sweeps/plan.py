"""What workers are asked for and what they answer, as plain data, whatever process or machine."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeAlias

from mbla.deck.text.overrides import LABEL
from mbla.sweeps.identity import program_identity

Plain: TypeAlias = "bool | int | float | str | list[Plain] | dict[str, Plain] | None"
"""what JSON holds, numbers finite"""


@dataclass(frozen=True)
class Plan:
    """What all points of a sweep have in common.

    deck         : absolute path of the base deck; workers on other machines see it under the same name
    fingerprint  : hash of the base deck's content and of the files that it names (``base.py``); a worker that reads
                   something else refuses
    fixed        : ``key.path=value`` texts that hold for every point
    cases        : names of the load cases to solve; all if empty
    results      : what of the JSON of a run becomes columns, in order
    keep         : result files of points: ``none``, ``failed``, ``all``
    folder       : absolute path of the sweep's folder; files of point 12 go to ``points/12/`` in it
    time_limit   : seconds for each point, None for none; the process is stopped then
    memory_limit : bytes that a point may take above what its process holds with the base deck, None for none
    program      : version and hash of the mbla that planned it; a worker with another one refuses
    timed        : times are compared: points share nothing, and of quick ones the shortest of three runs counts
    """

    deck: str
    fingerprint: str
    fixed: tuple[str, ...]
    cases: tuple[str, ...]
    results: tuple[str, ...]
    keep: str = "none"
    folder: str = ""
    time_limit: float | None = None
    memory_limit: float | None = None
    program: str = field(default_factory=program_identity)
    timed: bool = False


@dataclass(frozen=True)
class Task:
    """One point to be solved.

    key      : hash of the effective deck: of the base and of ``settings``; the same for the same answer
    number   : of the point in the design, from 1; names its files
    settings : values by key path of the deck, as ``--set`` takes them
    """

    key: str
    number: int
    settings: Mapping[str, Plain]


DONE, FAILED = "done", "failed"
MEGABYTE = 1e6


@dataclass(frozen=True)
class PointOutcome:
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


def override_texts(settings: Mapping[str, Plain]) -> tuple[str, ...]:
    """One text for each key path; JSON is YAML, and writes floats so that they are read back to the same bits."""
    return tuple(f"{key}={_written(value)}" for key, value in settings.items())


def _written(value: Plain) -> str:
    """JSON that YAML reads alike: it knows no pairs of surrogates, and takes U+0085 for the end of a line."""
    return json.dumps(value, allow_nan=False, ensure_ascii=False).replace("\x85", "\\u0085")


SETTING = re.compile(rf"(?<!\S){re.escape(LABEL)}:[0-9]+:[0-9]+ ")
"""place of a value that a point sets: the user did not write it; its key and value stand behind it"""


def as_named(plan: Plan, deck: str, outcome: PointOutcome) -> PointOutcome:
    """An outcome that names files as the user does, not by the folders of this machine.

    deck : the base deck as the sweep file names it
    """
    reason, named = SETTING.sub("", outcome.reason), Path(deck).parent
    shown = "" if named == Path() else f"{named}/"
    for folder, instead in ((Path(plan.folder), ""), (Path(plan.deck).parent, shown)):
        for each in (folder, folder.resolve()):
            reason = reason.replace(f"{str(each).rstrip('/')}/", instead) if each != each.parent else reason
    return replace(outcome, reason=reason)
