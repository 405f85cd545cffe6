"""Values of options on the command line: names, numbers and what they may be, with one line of what was wanted."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from typing import TypeVar

Amount = TypeVar("Amount", int, float)


def names(text: str) -> list[str]:
    """Names with commas between them."""
    listed = [name.strip() for name in text.split(",")]
    if not all(listed):
        raise argparse.ArgumentTypeError(f"{text!r} is not a list of names with commas between them")
    return listed


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
    return _number(text, int, lambda value: value >= 1, "a whole number of threads, at least 1")


def shard(text: str) -> tuple[int, int]:
    """Part and number of parts, ``2/8``."""
    match = re.fullmatch(r"([0-9]{1,6})/([0-9]{1,6})", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise argparse.ArgumentTypeError(f"{text!r} is not a shard, such as 2/8: part 1 to n of n parts")
    return int(match[1]), int(match[2])


def workers(text: str) -> int:
    """A number of processes."""
    return _number(text, int, lambda value: value >= 1, "a whole number of processes, at least 1")


def _number(text: str, kind: Callable[[str], Amount], allowed: Callable[[Amount], bool], wanted: str) -> Amount:
    try:
        value = kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}") from None
    if not allowed(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
    return value
