"""All files of a run, through the output folder that puts them in place together."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Protocol

from mbla.deck.content import OutputSection
from mbla.results.files import OutputFolder
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.listing.listing import find_failure, listing
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.results import CaseResult, Results
from mbla.results.series import detailed_cases, series_of
from mbla.results.vtu.mesh_files import write_mesh_files


class Files(Protocol):
    """Where files go: an output folder, or what is gathered for one."""

    stem: str

    @property
    def names(self) -> tuple[str, ...]:
        """Files so far, sorted."""
        ...

    def write_bytes(self, name: str, data: bytes) -> None:
        """Write one file."""
        ...

    def write_text(self, name: str, text: str) -> None:
        """Write one text file."""
        ...


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
        find_failure(results.assembly, case)
    described = time.perf_counter()
    every_position = output.positions == "all"
    shown = replace(results, cases=results.cases if every_position else detailed_cases(results.cases))
    if output.vtu:
        write_mesh_files(shown, out, output.frames)
    if output.plots:
        _write_pictures(results, shown.cases, out)
    seconds = {"write": time.perf_counter() - begin, "write/failure": described - begin}
    return write_record(replace(results, time=results.time | seconds), out, every_position=every_position)


def write_record(results: Results, out: Files, *, every_position: bool) -> Results:
    """Write what needs no picture and no geometry: the result file, listing, JSON, tables of curves and the like.

    Returns the results with the names of all files.
    """
    if series_of(results.cases):
        _write_table(results, out, "positions")
    if any(case.solution.further.pushover.curve for case in results.cases):
        _write_table(results, out, "curve")
    asked = [case.load_case.time_history for case in results.cases if case.solution.further.time_history.histories]
    if asked:
        _write_table(results, out, "history")
    if any(each is not None and each.interfaces for each in asked):
        _write_table(results, out, "history_interfaces")
    if any(case.solution.further.time_history.spectra for case in results.cases):
        _write_table(results, out, "spectra")
    files = sorted({*out.names, *(f"{out.stem}.{suffix}" for suffix in ("lst", "h5", "json"))})
    results = replace(results, files=tuple(files))
    out.write_text(f"{out.stem}.lst", listing(results, every_position=every_position))
    out.write_bytes(f"{out.stem}.h5", write_results_hdf5(results))
    out.write_text(f"{out.stem}.json", json_line(results_json(results)) + "\n")
    return results


def _write_table(results: Results, out: Files, name: str) -> None:
    """Positions of travelling loads, curves of pushovers, or histories of structures in time, as CSV."""
    from mbla.results.tables.formats import table_csv  # few decks ask for them
    from mbla.results.tables.tables import tables_of

    table = {"positions": "series"}.get(name, name)
    out.write_text(f"{out.stem}_{name}.csv", table_csv(tables_of(results, (table,))[table]))


def _write_pictures(results: Results, cases: Sequence[CaseResult], out: OutputFolder) -> None:
    from mbla.results.pictures.options import PictureOptions
    from mbla.results.pictures.plot import pictures_of

    for picture in pictures_of(results, cases, PictureOptions()):
        with out.writing(f"{out.stem}{picture.name}.png") as path:
            picture.write(path)
