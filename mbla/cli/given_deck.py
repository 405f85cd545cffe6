"""The deck that a command names, and its options as the record of a run."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from mbla.errors import FileError
from mbla.process.collector import loading
from mbla.run_options import RunOptions

if TYPE_CHECKING:
    from mbla.deck import Deck


def read_given_deck(path: Path, options: RunOptions) -> tuple[Deck, float]:
    """The deck, and the seconds it took; a faulty one is told before anything heavy is imported."""
    with loading():
        from mbla.deck import read_deck

    started = time.perf_counter()
    return read_deck(path, options.overrides), time.perf_counter() - started


def run_options(options: argparse.Namespace, *, override: bool = True) -> RunOptions:
    """Options of a run; those that stand for values of the deck become overrides unless the command means others."""
    overrides = list(options.set)
    for name in ("accuracy", "flow_rule", "time_limit") if override else ():
        value = getattr(options, name, None)
        if value is not None:
            overrides.append(f"analysis.{name}={value}")
    return RunOptions(
        folder=options.output,
        overrides=tuple(overrides),
        cases=_cases(options),
        force=options.force,
        threads=getattr(options, "threads", 1),
        expected=getattr(options, "expected", False),
    )


def _cases(options: argparse.Namespace) -> tuple[str, ...]:
    """Names of ``--case``, which some commands take once."""
    given = getattr(options, "case", None) or ()
    return (given,) if isinstance(given, str) else tuple(given)


def refuse_unfit_name(deck: Path, what: str = "deck") -> None:
    """A name that no result file can have, or that no text can hold."""
    if not deck.name or deck.is_dir():
        raise FileError("folder-given", f"{deck}: is a folder, not a {what}")
    try:
        str(deck.absolute()).encode("utf-8")
    except UnicodeEncodeError:
        raise FileError("path-not-utf-8", f"{deck}: the path is not UTF-8, results cannot name it; rename it") from None
