"""What Python users call; ``import mbla`` has these names and imports the rest when one of them is used."""

from __future__ import annotations

import io
import json
import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mbla.codes.again import assessed_again
from mbla.deck import read_deck, read_deck_text
from mbla.deck.deck import Deck
from mbla.errors import FileError, LimitError, UsageError
from mbla.process.limits import limit_threads
from mbla.process.run_options import RunOptions
from mbla.results.failures import StoppedRun
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.notebook.run import Run
from mbla.results.results import Results
from mbla.results.status_file import StatusFile
from mbla.run import Progress, run_and_write, solve_deck

TEXT_NAME = "deck.yaml"
"""name of a deck that is given as text"""


def run(
    deck: str | os.PathLike[str],
    *,
    set: Mapping[str, object] | Sequence[str] = (),
    cases: str | Sequence[str] = (),
    output: str | os.PathLike[str] | None = None,
    force: bool = False,
    expected: bool = False,
    threads: int = 1,
    progress: Progress | None = None,
) -> Run:
    """Solve the load cases of a deck; nothing is printed, and nothing written unless ``output`` is given.

    Parameters
    ----------
    deck
        Path of a deck; or the text of one: a str with a line break. Files that a text names are relative to the
        current folder.
    set
        Values replaced before anything is evaluated, ``{"parameters.mu": 0.5}`` or ``["parameters.mu=0.5"]``.
    cases
        Names of the load cases to solve; all if none.
    output
        Folder for the files that ``mbla run`` writes.
    force
        Replace an earlier result there.
    expected
        Compare with the deck's ``expected`` section: differences are warnings, and count in ``exit_code``.
    threads
        Of the linear algebra libraries, if they are not loaded yet; factorisations are serial.
    progress
        Called once per iteration with the name of the load case and an ``IterationRecord``.

    Raises
    ------
    DeckError
        The deck is not valid; ``faults`` has everything that is wrong, each with its place.
    UsageError
        A load case or an option that does not exist.
    FileError
        A file cannot be read or written, or a result is there already.
    LimitError
        Out of memory.
    SolverError
        A solver broke. A case that is not solved or not verified raises nothing: its ``status`` says so.
    """
    started = time.perf_counter()
    if threads > 1:
        limit_threads(threads)
    overrides = overrides_of(set)
    names = (cases,) if isinstance(cases, str) else tuple(cases)
    folder = None if output is None else Path(output)
    options = RunOptions(folder, overrides, names, force, threads, expected)
    try:
        return Run(_solved(_read(deck, overrides), options, progress, started))
    except StoppedRun as run:
        raise run.cause from None
    except MemoryError as error:
        raise LimitError("out-of-memory", "out of memory") from error
    except OSError as error:
        raise FileError("file-system", f"{error.filename or deck}: {error.strerror or error}") from error


def read_results(path: str | os.PathLike[str]) -> Run:
    """The run of a result file (``.h5``); FileError if it cannot be read or is no result."""
    return Run(read_results_hdf5(Path(path)))


def assess(result: str | os.PathLike[str] | Run, *, set: Mapping[str, object] | Sequence[str] = ()) -> Run:
    """A result with what codes say of it; nothing is solved, and no file is changed.

    result : a result file (``.h5``), or a run
    set    : changes of ``load_cases.NAME.assessment``, and of parameters that they alone use, as ``run`` takes them

    Raises DeckError and UsageError where the deck does not allow that, FileError as ``read_results``.
    """
    run = result if isinstance(result, Run) else read_results(result)
    return Run(assessed_again(run.records, overrides_of(set)))


def _read(deck: str | os.PathLike[str], overrides: Sequence[str]) -> Deck:
    if isinstance(deck, str) and "\n" in deck:
        return read_deck_text(deck, Path(TEXT_NAME), overrides)
    path = Path(deck)
    if path.is_dir():
        raise FileError("folder-given", f"{path}: is a folder, not a deck")
    return read_deck(path, overrides)


def _solved(deck: Deck, options: RunOptions, progress: Progress | None, started: float) -> Results:
    if options.folder is not None:
        return run_and_write(deck, options, progress, started)
    return solve_deck(deck, options, StatusFile(io.StringIO(), deck.title), progress, started)


def overrides_of(values: Mapping[str, object] | Sequence[str]) -> tuple[str, ...]:
    """``key.path=value`` texts; raises UsageError where a value cannot be written as one."""
    if isinstance(values, str):
        raise UsageError("set-refused", f"set={values!r}: a mapping, or a list of key.path=value texts")
    if not isinstance(values, Mapping):
        return tuple(values)
    try:
        return tuple(f"{key}={json.dumps(value, allow_nan=False, default=_plain)}" for key, value in values.items())
    except (TypeError, ValueError) as error:
        raise UsageError("set-refused", f"set: {error}") from error


def _plain(value: Any) -> object:
    """Numbers and arrays of numpy as Python has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} is no value of a deck")
