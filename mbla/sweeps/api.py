"""Sweeps for Python users: the names of :mod:`mbla.api` that run a sweep file or read its table back."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from mbla.api import overrides_of
from mbla.errors import LimitError
from mbla.sweeps.command import SweepOptions, prepare, run_sweep
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.file.read import read_sweep as read_file
from mbla.sweeps.plan import PointOutcome, Task
from mbla.sweeps.tables.sweep_json import read_sweep_table
from mbla.sweeps.tables.sweep_table import SweepTable
from mbla.sweeps.words import SweepProgress


def sweep(
    path: str | os.PathLike[str],
    *,
    set: Mapping[str, object] | Sequence[str] = (),
    output: str | os.PathLike[str] | None = None,
    jobs: int = 1,
    scheduler: str = "",
    resume: bool = False,
    retry_failed: bool = False,
    force: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> SweepTable:
    """Solve the points of a sweep file and write the files of ``mbla sweep``; nothing is printed.

    Parameters
    ----------
    path
        Of the sweep file.
    set
        Values of the deck for every point, as of ``mbla.run``.
    output
        Folder of the files; default: ``SWEEP.out`` next to the sweep file.
    jobs
        Processes of this machine.
    scheduler
        Address of a Dask scheduler whose workers solve the points, in the place of processes of this machine. At a
        ``tls://`` address the certificates are those of Dask's own configuration.
    resume, retry_failed
        Continue with the journal that is there; with ``retry_failed`` failed points are solved again.
    force
        Start over and replace earlier files.
    progress
        Called with how many points are finished, and how many there are; first before any is solved.

    Returns
    -------
    SweepTable
        All points in the order of the design; ``table["load_factor"]`` is a column. Points without a verified answer
        have no values, and ``table["state"]`` says ``failed``: that raises nothing.

    Raises
    ------
    DeckError
        The sweep file or its base deck is not valid; ``faults`` has everything that is wrong.
    UsageError
        An option that does not fit, an extra that is not installed, or workers with another mbla.
    FileError
        Files are in the way or cannot be written, another run is at work, or the scheduler is gone. What was solved is
        in the journal.
    """
    options = SweepOptions(
        folder=None if output is None else Path(output),
        engine=EngineOptions(workers=jobs, scheduler=scheduler),
        resume=resume or retry_failed,
        force=force,
        retry_failed=retry_failed,
    )

    def report(state: SweepProgress, task: Task | None, outcome: PointOutcome | None) -> None:
        if progress is not None:
            progress(state.earlier + state.done, state.earlier + state.total)

    try:
        return run_sweep(prepare(read_file(Path(path), overrides_of(set)), options), options, report).table
    except MemoryError as error:
        raise LimitError("out-of-memory", "out of memory") from error


def read_sweep(path: str | os.PathLike[str]) -> SweepTable:
    """The table of a sweep from its folder, its sweep.csv or its sweep.json; FileError if it cannot be read."""
    return read_sweep_table(Path(path))
