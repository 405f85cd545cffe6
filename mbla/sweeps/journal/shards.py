"""Shards: parts of a sweep that jobs of an array solve on their own, each with a journal of its own."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from mbla.sweeps.plan import Task

WHOLE = "journal.csv"
"""name of the journal of a run that is no shard"""
_NAME = re.compile(r"journal\.(?P<part>[1-9][0-9]*)-of-(?P<parts>[1-9][0-9]*)\.csv")


def shard_of(tasks: Sequence[Task], part: int, parts: int) -> tuple[Task, ...]:
    """Every ``parts``-th task from the ``part``-th on, counted from 1; of tasks with one key the first counts.

    Neighbours in a design take about as long as each other, so that shards made like this take about equally long.
    """
    different = list({task.key: task for task in reversed(tasks)}.values())[::-1]
    return tuple(different[part - 1 :: parts])


def journal_name(part: int | str, parts: int | str) -> str:
    """Name of the journal of a shard; with ``*`` for both a pattern of all such names."""
    return f"journal.{part}-of-{parts}.csv"


def is_of_shard(path: Path) -> bool:
    """Whether a journal has the name of one of a shard."""
    return _NAME.fullmatch(path.name) is not None


def journals_in(folder: Path) -> tuple[Path, ...]:
    """Every journal in a folder, that of whole runs first, then those of shards by number of parts and part."""
    try:
        names = [path.name for path in folder.iterdir()]
    except (FileNotFoundError, NotADirectoryError):
        return ()
    shards = sorted(
        (int(match["parts"]), int(match["part"]), match[0]) for name in names if (match := _NAME.fullmatch(name))
    )
    return tuple(folder / name for name in (*([WHOLE] if WHOLE in names else []), *(name for *_, name in shards)))
