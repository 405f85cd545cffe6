"""What workers are asked for, as plain data: JSON in, JSON out, whatever process or machine they are in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

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
    """

    deck: str
    fingerprint: str
    fixed: tuple[str, ...]
    cases: tuple[str, ...]
    results: tuple[str, ...]
    keep: str
    folder: str
    time_limit: float | None
    memory_limit: float | None
    program: str


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
