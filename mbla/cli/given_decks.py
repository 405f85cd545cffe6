"""What commands that take a deck share: its options, reading it, one deck after the other."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from mbla.cli.terminal import clear_line, failed
from mbla.errors import FileError
from mbla.process.collector import loading
from mbla.process.run_options import RunOptions
from mbla.results.failures import ENDINGS

if TYPE_CHECKING:
    from mbla.deck import Deck
    from mbla.run import Progress

WORST_FIRST = (1, 6, 7, 3, 4, 5)
FIRST_OF_SIGNALS = 128


def read_given_deck(path: Path, options: RunOptions) -> tuple[Deck, float]:
    """The deck, and the seconds it took; a faulty one is reported before anything heavy is imported."""
    with loading():
        from mbla.deck import read_deck

    started = time.perf_counter()
    return read_deck(path, options.overrides), time.perf_counter() - started


def read_one_deck(path: Path, options: RunOptions) -> Deck:
    """The deck of a command that takes one; raises FileError for a name that no result file can have."""
    refuse_unfit_name(path)
    return read_given_deck(path, options)[0]


def run_options(options: argparse.Namespace, *, override: bool = True) -> RunOptions:
    """Options of a run; those that stand for values of the deck become overrides unless the command means others."""
    overrides = list(options.set)
    for name in ("accuracy", "flow_rule", "time_limit") if override else ():
        value = getattr(options, name, None)
        if value is not None:
            overrides.append(f"analysis.{name}={value}")
    cases = getattr(options, "case", None) or ()  # some commands take one
    return RunOptions(
        folder=options.output,
        overrides=tuple(overrides),
        cases=(cases,) if isinstance(cases, str) else tuple(cases),
        force=options.force,
        threads=getattr(options, "threads", 1),
        expected=getattr(options, "expected", False),
        resume=getattr(options, "resume", False),
    )


def refuse_unfit_name(deck: Path, what: str = "deck") -> None:
    """Raises FileError for a name that no result file can have, or that no text can hold."""
    if not deck.name or deck.is_dir():
        raise FileError("folder-given", f"{deck}: is a folder, not a {what}")
    try:
        str(deck.absolute()).encode("utf-8")
    except UnicodeEncodeError:
        raise FileError("path-not-utf-8", f"{deck}: the path is not UTF-8, results cannot name it; rename it") from None


def each_deck(options: argparse.Namespace, one: Callable[[Path], int], progress: Progress | None) -> int:
    """Run one deck after the other; a deck that fails does not stop the next, a signal does."""
    codes = []
    for deck in options.decks:
        try:
            refuse_unfit_name(deck)
            codes.append(one(deck))
        except BrokenPipeError:
            raise
        except ENDINGS as error:
            clear_line(progress)
            codes.append(failed(error, {"deck": deck}, options.json))
        if codes[-1] >= FIRST_OF_SIGNALS:
            return codes[-1]
    return next((code for code in WORST_FIRST if code in codes), codes[0] if len(set(codes)) == 1 else max(codes))
