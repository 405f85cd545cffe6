"""What a run has done so far, on the disk while it goes on: ``STEM.partial.h5``, ``.lst`` and ``.json``.

A structure that is followed in time leaves ``STEM.partial.checkpoint`` as well, from where it can go on.

They stand in the folder of the results, next to an earlier result and never in its place, and say that they are not
complete and what is not done. Each is written under a temporary name and renamed over the one before, so that a run
that is killed at any moment leaves the last whole ones. They are written when a load case is done, and while a pushover
or a time history goes on, but only where much more time has passed than writing takes. A run that is stopped (a signal,
too little memory, a defect) writes them once more, with its ``.sta``. They give way to the files of the next complete
run of the deck, and of the next partial one.

A run that is refused (its deck, its options) leaves nothing: it has reported why, and gets as far again.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
from contextvars import Context
from dataclasses import replace

from mbla.deck.content import OutputSection
from mbla.errors import DeckError, FileError, MblaError, Notice, UsageError
from mbla.results.disk import file_errors, missing_folders, remove_folders, write_complete
from mbla.results.failures import StoppedRun, words_of
from mbla.results.files import OutputFolder, earlier_files, is_partial, partial_stem
from mbla.results.results import Results
from mbla.results.resumed import SUFFIX, checkpoint_file
from mbla.results.write import write_record

SHARE = 20.0
"""time that passes before partial results are written again, over that which it took to write them"""
FIRST, LAST = 0.5, 5.0
"""seconds of solving before they are written first, and where no load case is left but for the files of all"""
STOPPED = "the run was stopped"
"""how the remark on a stopped run begins"""
NAMED = 5
"""load cases that a remark names"""
KILLED = (137, "killed, or still at work")
"""exit status of a process that was killed, and what is said of a run while it goes on"""


class Partial:
    """The load cases of a run that are done, and the one that it works at; what there is of them goes to the disk."""

    def __init__(self, out: OutputFolder, output: OutputSection) -> None:
        self._folder, self._stem, self._stem_of_run = out.folder, partial_stem(out.stem), out.stem
        self._made = missing_folders(out.folder)
        self._every_position = output.positions == "all"
        self._done: Results | None = None
        self._at_work: Callable[[], Results] | None = None
        self._status = b""
        self._new = self._written = self._refused = False
        self._since, self._wait = time.perf_counter(), FIRST

    def done(self, results: Results) -> None:
        """Results before any load case is solved, or with one load case more."""
        if self._done is None:
            self._since = time.perf_counter()
        self._done, self._at_work, self._new = results, None, bool(results.cases)
        self.keep()

    def at_work(self, results: Callable[[], Results]) -> None:
        """How to make results with what there is of a load case that is not done."""
        self._at_work = results

    def keep(self) -> None:
        """Write what is new where enough time has passed; that it cannot be written is no reason to end a run."""
        begun = time.perf_counter()
        if self._done is None or self._refused or not (self._new or self._at_work):
            return
        if begun - self._since < (self._wait if self._done.not_done else max(self._wait, LAST)):
            return
        try:
            Context().run(self._write, *KILLED)  # neither in the memory of load cases nor in their times
        except (MblaError, OSError, MemoryError):
            self._refused = True
        self._new, self._since = False, time.perf_counter()
        self._wait = max(FIRST, SHARE * (self._since - begun))

    def keep_status(self) -> None:
        """Keep the ``.sta`` of the run, which ends without its files."""
        with contextlib.suppress(OSError):
            self._status = (self._folder / f"{self._stem_of_run}.sta").read_bytes()

    def stopped(self, cause: BaseException) -> StoppedRun | None:
        """What to raise where a run was stopped; None: the cause itself. It says where the load cases done are."""
        if isinstance(cause, (DeckError, UsageError)):
            self._remove()
            return None
        if isinstance(cause, (FileError, OSError)):  # as a full disk: nothing is written any more
            if self._done is not None and self._written:
                cause.add_note(self._where(self._done))
            return None
        if self._done is None:
            cause.add_note("no load case was done")
            return None
        try:
            results = self._write(*words_of(cause))
        except (MblaError, OSError, MemoryError) as error:
            cause.add_note(f"load cases done: {_count(self._done)}, which could not be written: {words_of(error)[1]}")
            results = partial_results(self._done, *words_of(cause))
        else:
            cause.add_note(self._where(results))
        return StoppedRun(cause, results)

    def _where(self, results: Results) -> str:
        return f"load cases done: {_count(results)}, in {self._folder / self._stem}.h5"

    def _write(self, status: int, words: str) -> Results:
        """Put the files of what there is in place of those before; the results as they are in them."""
        assert self._done is not None  # else there is nothing to write
        earlier = self._earlier()
        results = partial_results(self._done if self._at_work is None else self._at_work(), status, words)
        files = _Files(self._stem)
        if self._status:
            files.write_bytes(f"{self._stem}.sta", self._status)
        if (checkpoint := checkpoint_file(results)) is not None:
            files.write_bytes(f"{self._stem}{SUFFIX}", checkpoint)
        results = write_record(results, files, every_position=self._every_position)
        for name in set(earlier) - set(files.content):
            with file_errors(self._folder / name):
                (self._folder / name).unlink(missing_ok=True)
        # by its JSON record the next run knows them for its own; the file that needs no other comes last
        for name in sorted(files.content, key=lambda name: (not name.endswith(".json"), name.endswith(".h5"))):
            write_complete(self._folder / name, files.content[name])
        self._written = True
        return results

    def _earlier(self) -> tuple[str, ...]:
        """Files of partial results before these; raises FileError where another deck has a result of that name."""
        if is_partial(self._folder, self._stem):
            return earlier_files(self._folder, self._stem)
        OutputFolder(self._folder, self._stem).refuse(*(f"{self._stem}.{suffix}" for suffix in ("h5", "lst", "json")))
        return ()

    def _remove(self) -> None:
        if self._written and is_partial(self._folder, self._stem):
            for name in earlier_files(self._folder, self._stem):
                with contextlib.suppress(OSError):
                    (self._folder / name).unlink(missing_ok=True)
            remove_folders(self._made)


class _Files:
    """Files in memory: all are made before any of them is put in place."""

    def __init__(self, stem: str) -> None:
        self.stem = stem
        self.content: dict[str, bytes] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """Their names, sorted."""
        return tuple(sorted(self.content))

    def write_bytes(self, name: str, data: bytes) -> None:
        """One file."""
        self.content[name] = data

    def write_text(self, name: str, text: str) -> None:
        """One text file, UTF-8."""
        self.content[name] = text.encode("utf-8")


def partial_results(results: Results, status: int, words: str) -> Results:
    """Results of what was done, with a warning that it is not all.

    status, words : exit status of the run, and what ended it
    """
    warning = Notice("warning", "run-stopped", f"{STOPPED} ({words}){what_was_done(results)}")
    return replace(results, complete=False, exit_code=status, notices=(*results.notices, warning))


def what_was_done(results: Results) -> str:
    """Of a stopped run, the end of the remark on it: how many load cases were done, and which were not."""
    left = list(results.not_done)
    if left and left[0] in {case.load_case.name for case in results.cases}:
        further = results.case(left[0]).solution.further
        rows = further.time_history.rows
        came = f"pushover came to step {len(further.pushover.curve) - 1}"
        left[0] += f" (its {came if rows is None else f'time history came to {rows.times[-1]:.4g} s'})"
    more = f" and {len(left) - NAMED} more" if len(left) > NAMED else ""
    lacking = f"not done: {', '.join(left[:NAMED])}{more}" if left else "not written: its other files"
    return f"; load cases done: {_count(results)}; {lacking}"


def _count(results: Results) -> str:
    asked = {case.load_case.name for case in results.cases} | set(results.not_done)
    return f"{len(asked) - len(results.not_done)} of {len(asked)}"
