"""What a run that was stopped has left, to go on from: load cases that were done, and a time history that was at work.

``STEM.partial.h5`` holds the load cases, ``STEM.partial.checkpoint`` the time history as far as it came with the state
from where it goes on. Both are of one deck, with its overrides, and of one version of the program: else the figures
would not be those of a run that was not stopped.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from mbla import __version__
from mbla.deck import Deck
from mbla.errors import FileError, UsageError
from mbla.results.files import is_partial, partial_stem
from mbla.results.hdf5.stored_record import restored, stored
from mbla.results.provenance import deck_record
from mbla.results.results import CaseResult, Results

if TYPE_CHECKING:
    from mbla.solution.time_history.checkpoint import Unfinished

SUFFIX = ".checkpoint"
"""of the file of a time history that was at work"""


@dataclass(frozen=True)
class Resumed:
    """What is done already.

    done       : load cases by name
    unfinished : time histories that were at work, by the names of their load cases: one at most
    """

    done: dict[str, CaseResult]
    unfinished: dict[str, Unfinished]


NOTHING_DONE = Resumed({}, {})


def checkpoint_file(results: Results) -> bytes | None:
    """The file of the time history that is at work; None where none is."""
    from mbla.results.hdf5.result_file import write_checkpoint_hdf5  # late: few runs have one

    for case in results.cases:
        if case.checkpoint is not None:
            about = _about(results.deck.sha256) | {"case": case.load_case.name}
            return write_checkpoint_hdf5(stored(case.checkpoint), about)
    return None


def _about(sha256: str) -> dict[str, str]:
    return {"mbla_version": __version__, "deck_sha256": sha256}


def resumed(deck: Deck, folder: Path) -> Resumed:
    """What a run of the deck has left in a folder.

    Raises UsageError where there is nothing, or of another deck or program, FileError where it is damaged.
    """
    from mbla.results.hdf5.result_file import read_checkpoint_hdf5, read_results_hdf5

    stem = partial_stem(deck.path.stem)
    path, at_work = folder / f"{stem}.h5", folder / f"{stem}{SUFFIX}"
    if not is_partial(folder, stem) or not path.is_file():
        words = f"{path}: is not there: no run of the deck was stopped here, or a later one has come to its end"
        raise UsageError("nothing-to-resume", f"{words}; run it without --resume")
    left = read_results_hdf5(path)
    _same(path, left.provenance.get("mbla", ""), left.deck.sha256, deck)
    done = {case.load_case.name: case for case in left.cases if case.load_case.name not in left.not_done}
    if not at_work.is_file():
        return Resumed(done, {})
    record, about = read_checkpoint_hdf5(at_work)
    _same(at_work, about.get("mbla_version", ""), about.get("deck_sha256", ""), deck)
    from mbla.solution.time_history.checkpoint import Unfinished

    try:
        found = restored(Unfinished, record)
    except (ValueError, TypeError, KeyError, IndexError, json.JSONDecodeError) as error:
        raise FileError("damaged-result-file", f"{at_work}: damaged: {error}") from error
    return Resumed(done, {about.get("case", ""): found})


def _same(path: Path, version: str, sha256: str, deck: Deck) -> None:
    """UsageError where a file is of another program or deck."""
    if version != __version__:
        words = f"{path}: is of mbla {version or 'of unknown version'}, this is {__version__}"
        raise UsageError("resume-of-another", f"{words}: run the deck without --resume")
    if sha256 != deck_record(deck).sha256:
        words = f"{path}: is of another deck, or of other values of --set and other options"
        raise UsageError("resume-of-another", f"{words}: give the same, or run it without --resume")
