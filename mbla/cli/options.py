"""Options that several commands share, and the values that options take, with one line of what was wanted.

A command is a parser with an ``action``, which gets the options and returns the exit status, and ``about``: by the keys
of a JSON object of failure, the options with the files that a command with one object for everything is about.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

Amount = TypeVar("Amount", int, float)

MOST = 1024
"""threads or processes"""


def names(text: str) -> list[str]:
    """Names with commas between them; raises ArgumentTypeError where one is empty."""
    listed = [name.strip() for name in text.split(",")]
    if not all(listed):
        raise argparse.ArgumentTypeError(f"{text!r} is not a list of names with commas between them")
    return listed


def place(text: str) -> Path:
    """A file or a folder to write to; raises ArgumentTypeError for an empty text."""
    if not text:  # as where a script has a variable that is not set: not the current folder
        raise argparse.ArgumentTypeError("'' is no name of a file or a folder")
    return Path(text)


def shard(text: str) -> tuple[int, int]:
    """Part and number of parts, ``2/8``; raises ArgumentTypeError for anything else."""
    match = re.fullmatch(r"([0-9]{1,6})/([0-9]{1,6})", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise argparse.ArgumentTypeError(f"{text!r} is not a shard, such as 2/8: part 1 to n of n parts")
    return int(match[1]), int(match[2])


def target(text: str) -> tuple[str, float]:
    """What a result should be, ``load_factor=1.0``, ``peak=0.1``, ``stands`` or ``falls``.

    Raises ArgumentTypeError for anything else.
    """
    name, equals, value = text.partition("=")
    if text in ("stands", "falls"):
        return text, 0.0
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if name not in ("load_factor", "least_load_factor", "peak") or not equals or not abs(number) < float("inf"):
        wanted = "load_factor=VALUE, least_load_factor=VALUE, stands, falls or peak=VALUE"
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
    return name, number


def _number(kind: Callable[[str], Amount], allowed: Callable[[Amount], bool], wanted: str) -> Callable[[str], Amount]:
    """What reads a number; it raises ArgumentTypeError for one that is not allowed."""

    def read(text: str) -> Amount:
        try:
            value = kind(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}") from None
        if not allowed(value):
            raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
        return value

    return read


seconds = _number(float, lambda value: 0 < value < float("inf"), "a positive number of seconds")
relative = _number(float, lambda value: 0 <= value < float("inf"), "a relative difference, 0 or more")
relative_above_zero = _number(float, lambda value: 0 < value < 1, "a relative error between 0 and 1")
degrees = _number(float, lambda value: -720 <= value <= 720, "an angle from -720 to 720 degrees")
threads = _number(int, lambda value: 1 <= value <= MOST, f"an integer number of threads, 1 to {MOST}")
workers = _number(int, lambda value: 1 <= value <= MOST, f"an integer number of processes, 1 to {MOST}")
points = _number(int, lambda value: True, "an integer number of points")
"""how many may be depends on what is asked"""
dots = _number(int, lambda value: True, "an integer number of dots per inch")


# --- options that commands share ------------------------------------------------------------------------------------


def add_deck_options(
    command: argparse.ArgumentParser, extent: str = "", what: str = "deck", default: str = "DECK.out"
) -> None:
    """Where files go, values of the deck, ``--force`` and ``--json``."""
    command.add_argument("-o", "--output", type=place, metavar="DIR", help=f"folder of the results (default {default})")
    words = f"change a value of the deck{extent and ' '}{extent} (repeatable); items of lists by number, from 0"
    command.add_argument("--set", action="append", default=[], metavar="KEY.PATH=VALUE", help=words)
    command.add_argument("--force", action="store_true", help="replace an earlier result")
    words = f"one JSON object per {what} on standard output, nothing else"
    command.add_argument("--json", action="store_true", help=words)


def add_analysis_options(command: argparse.ArgumentParser) -> None:
    """Options in the place of values of ``analysis``."""
    command.add_argument("--accuracy", choices=["draft", "standard", "reference"], help="instead of analysis.accuracy")
    words = "instead of analysis.flow_rule"
    command.add_argument("--flow-rule", choices=["associative", "non_associative", "dilatancy", "livesley"], help=words)


def add_quiet(command: Any) -> None:
    """No words but errors; of a command, or of a group of options that exclude each other."""
    command.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors")


def add_jobs(command: argparse.ArgumentParser) -> None:
    """Processes for the points of a sweep."""
    words = "processes of this machine (default 1)"
    command.add_argument("-j", "--jobs", type=workers, default=1, metavar="N", help=words)


def add_result_and_output(command: Any, what: str) -> None:
    """A result file, and where what is made of it goes."""
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("-o", "--output", type=place, metavar="FILE|DIR", help=f"{what} (default: that of the result)")


def add_page_options(command: Any) -> None:
    """Size and format of pictures."""
    command.add_argument("--size", default="1600x1000", metavar="WxH", help="pixels of a PNG at 100 dpi")
    command.add_argument("--dpi", type=dots, default=100, help="dots per inch of a PNG (default 100)")
    words = "format of pictures in a folder (default png)"
    command.add_argument("--format", choices=["png", "svg", "pdf"], default="png", help=words)


def result_command(
    commands: Any, name: str, action: Callable[[argparse.Namespace], int], text: str
) -> argparse.ArgumentParser:
    """A command that says what a result file holds."""
    command: argparse.ArgumentParser = commands.add_parser(name, help=text)
    command.set_defaults(action=action, about={"result": "result"})
    command.add_argument("result", type=Path, metavar="RESULT.h5")
    command.add_argument("--json", action="store_true", help="one JSON object on standard output")
    return command
