"""All files of a run, through the output folder that puts them in place together.

A run that is stopped leaves the load cases that were done, next to an earlier result and never in its place. Their
files are ``STEM.partial.h5``, ``.lst`` and ``.json`` in the folder of the results. They say that they are not complete,
what was not done, and give way to those of the next run of the deck, complete or stopped again. A run that is refused
(its deck, its options, a file) leaves nothing: it has reported why, and gets as far again.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from mbla.deck.content import OutputSection
from mbla.errors import DeckError, FileError, MblaError, Notice, UsageError
from mbla.results.failures import StoppedRun, words_of
from mbla.results.files import OutputFolder, is_partial, partial_stem
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.listing.listing import find_failure, listing
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of
from mbla.results.tables.formats import table_csv
from mbla.results.tables.tables import CURVE, SERIES, tables_of
from mbla.results.vtu.mesh_files import write_mesh_files


def write_results(results: Results, out: OutputFolder, output: OutputSection) -> Results:
    """Write every file of a run into an open output folder.

    Parameters
    ----------
    results
        ``time["write"]`` is set here, to the seconds spent on finding how the cases fail (``write/failure``), VTU files
        and pictures, and so is ``files``.
    output
        What the deck asks for: files for ParaView and the frames of their animations; the pictures that ``mbla plot``
        makes by default; whether every position of a travelling load has them, or the worst.

    Returns
    -------
    Results
        As they are in the files, with the time of writing and the names of the files.

    Raises
    ------
    FileError
        A file could not be written.
    UsageError
        Pictures are asked for and the extra that draws them is not installed.
    """
    begin = time.perf_counter()
    for case in results.cases:
        find_failure(results.model, results.contacts, case)
    described = time.perf_counter()
    every_position = output.positions == "all"
    shown = replace(results, cases=results.cases if every_position else detailed_cases(results.cases))
    if output.vtu:
        write_mesh_files(shown, out, output.frames)
    if output.plots:
        _write_pictures(results, shown.cases, out)
    if series_of(results.cases):
        out.write_text(f"{out.stem}_positions.csv", table_csv(tables_of(results, (SERIES.name,))[SERIES.name]))
    if any(case.solution.curve for case in results.cases):
        out.write_text(f"{out.stem}_curve.csv", table_csv(tables_of(results, (CURVE.name,))[CURVE.name]))
    files = sorted({*out.names, *(f"{out.stem}.{suffix}" for suffix in ("lst", "h5", "json"))})
    seconds = {"write": time.perf_counter() - begin, "write/failure": described - begin}
    results = replace(results, time=results.time | seconds, files=tuple(files))
    out.write_text(f"{out.stem}.lst", listing(results, every_position=every_position))
    out.write_bytes(f"{out.stem}.h5", write_results_hdf5(results))
    out.write_text(f"{out.stem}.json", json_line(results_json(results)) + "\n")
    return results


def _write_pictures(results: Results, cases: Sequence[CaseResult], out: OutputFolder) -> None:
    from mbla.results.pictures.options import PictureOptions
    from mbla.results.pictures.plot import pictures_of

    for picture in pictures_of(results, cases, PictureOptions()):
        with out.writing(f"{out.stem}{picture.name}.png") as path:
            picture.write(path)


NAMED = 5
"""load cases that a remark names"""


def leaves_nothing(cause: BaseException) -> bool:
    """Whether a run was refused, not stopped."""
    return isinstance(cause, (DeckError, UsageError, FileError, OSError))


def partial_results(results: Results, cause: BaseException) -> Results:
    """Results of the load cases that were done, with a warning that they are not all."""
    status, words = words_of(cause)
    left = results.not_done
    more = f" and {len(left) - NAMED} more" if len(left) > NAMED else ""
    lacking = f"not done: {', '.join(left[:NAMED])}{more}" if left else "not written: its other files"
    text = f"the run was stopped ({words}); load cases done: {_done(results)}; {lacking}"
    warning = Notice("warning", "run-stopped", text)
    return replace(results, complete=False, exit_code=status, notices=(*results.notices, warning))


def keep_partial(results: Results, out: OutputFolder, output: OutputSection) -> Results:
    """Write the files of partial results, none for ParaView and no pictures; what was written is in ``files``.

    Raises
    ------
    FileError, OSError, MemoryError
        They could not be written, or files of another deck have their names; nothing is left then.
    """
    stem = partial_stem(out.stem)
    with OutputFolder(out.folder, stem, force=is_partial(out.folder, stem)) as partial:
        return write_results(results, partial, output.model_copy(update={"vtu": False, "plots": False}))


def stopped(results: Results, cause: BaseException, out: OutputFolder, output: OutputSection) -> StoppedRun:
    """What to raise where a run was stopped; what stopped it says where the load cases that were done are.

    out : where the complete result would have gone
    """
    partial = partial_results(results, cause)
    try:
        partial = keep_partial(partial, out, output)
    except (MblaError, OSError, MemoryError) as error:
        cause.add_note(f"load cases done: {_done(results)}, which could not be written: {words_of(error)[1]}")
    else:
        cause.add_note(f"load cases done: {_done(results)}, in {out.folder / partial_stem(out.stem)}.h5")
    return StoppedRun(cause, partial)


def _done(results: Results) -> str:
    return f"{len(results.cases)} of {len(results.cases) + len(results.not_done)}"
