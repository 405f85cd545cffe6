"""Plans, tasks and outcomes as JSON has them, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from mbla.sweeps.outcome import Outcome
from mbla.sweeps.plan import Plan, Task

LISTS = ("fixed", "cases", "results")
"""fields of a plan that are tuples, which JSON has not"""


def record_of(item: Plan | Task | Outcome) -> dict[str, Any]:
    """Fields by name."""
    return asdict(item)


def plan_of(record: Mapping[str, Any]) -> Plan:
    """The plan that ``record_of`` wrote."""
    return Plan(**{**record, **{name: tuple(record[name]) for name in LISTS}})


def task_of(record: Mapping[str, Any]) -> Task:
    """The task that ``record_of`` wrote."""
    return Task(**record)


def outcome_of(record: Mapping[str, Any]) -> Outcome:
    """The outcome that ``record_of`` wrote."""
    return Outcome(**record)
