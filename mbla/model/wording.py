"""Counts and names in the words of notices and faults."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mbla.arrays import FloatArray, IntArray

NAMED = 5
"""blocks that a message names before it only counts them"""


PLURALS = {"vertex": "vertices", "near miss": "near misses", "rigid body": "rigid bodies"}


def counted(count: int, noun: str) -> str:
    """``1 face``, ``3 faces``.

    >>> counted(1, "face"), counted(3, "vertex")
    ('1 face', '3 vertices')
    """
    return f"{count} {noun if count == 1 else PLURALS.get(noun, f'{noun}s')}"


def with_count(count: int, noun: str, words: str) -> str:
    """``1 face was left out``, ``3 faces were left out``."""
    return f"{counted(count, noun)} {'was' if count == 1 else 'were'} {words}"


def named(blocks: IntArray, name: Callable[[int], str]) -> str:
    """The first names of blocks, (n,), and how many more: ``a[0], a[4] and 7 more``."""
    names = ", ".join(name(int(block)) for block in blocks[:NAMED])
    return f"{names} and {len(blocks) - NAMED} more" if len(blocks) > NAMED else names


def vector(values: Sequence[float] | FloatArray) -> str:
    """``(0, 0, -9.81)``."""
    return f"({', '.join(f'{value:.6g}' for value in values)})"
