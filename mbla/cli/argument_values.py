"""Values of options on the command line: names, numbers and what they may be, with one line of what was wanted."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

Amount = TypeVar("Amount", int, float)

MOST = 1024
"""threads or processes"""


def names(text: str) -> list[str]:
    """Names with commas between them."""
    listed = [name.strip() for name in text.split(",")]
    if not all(listed):
        raise argparse.ArgumentTypeError(f"{text!r} is not a list of names with commas between them")
    return listed


def place(text: str) -> Path:
    """A file or a folder to write to."""
    if not text:  # as where a script has a variable that is not set: not the current folder
        raise argparse.ArgumentTypeError("'' is no name of a file or a folder")
    return Path(text)


def seconds(text: str) -> float:
    """A positive number of seconds."""
    return _number(text, float, lambda value: 0 < value < float("inf"), "a positive number of seconds")


def relative(text: str) -> float:
    """A relative difference, zero or more."""
    return _number(text, float, lambda value: 0 <= value < float("inf"), "a relative difference, 0 or more")


def relative_above_zero(text: str) -> float:
    """A relative error above zero and below one."""
    return _number(text, float, lambda value: 0 < value < 1, "a relative error between 0 and 1")


def degrees(text: str) -> float:
    """An angle in degrees, within two turns."""
    return _number(text, float, lambda value: -720 <= value <= 720, "an angle from -720 to 720 degrees")


def threads(text: str) -> int:
    """A number of threads."""
    return _number(text, int, _is_count, f"a whole number of threads, 1 to {MOST}")


def shard(text: str) -> tuple[int, int]:
    """Part and number of parts, ``2/8``."""
    match = re.fullmatch(r"([0-9]{1,6})/([0-9]{1,6})", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise argparse.ArgumentTypeError(f"{text!r} is not a shard, such as 2/8: part 1 to n of n parts")
    return int(match[1]), int(match[2])


def workers(text: str) -> int:
    """A number of processes."""
    return _number(text, int, _is_count, f"a whole number of processes, 1 to {MOST}")


def points(text: str) -> int:
    """A number of points; how many may be depends on what is asked."""
    return _number(text, int, lambda value: True, "a whole number of points")


def dots(text: str) -> int:
    """Dots per inch."""
    return _number(text, int, lambda value: True, "a whole number of dots per inch")


def _is_count(value: int) -> bool:
    return 1 <= value <= MOST


def _number(text: str, kind: Callable[[str], Amount], allowed: Callable[[Amount], bool], wanted: str) -> Amount:
    try:
        value = kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}") from None
    if not allowed(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
    return value
