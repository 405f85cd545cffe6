"""All files of a run, through the output folder that puts them in place together."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from mbla.results.files import OutputFolder
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.paraview.cells import block_cells
from mbla.results.paraview.pvd import collection_pvd, frame_times, write_frame_vtu
from mbla.results.paraview.vtu import CONTACT_FILES, write_blocks_vtu
from mbla.results.records.json_record import json_line, results_json
from mbla.results.results import CaseResult, Results
from mbla.results.words.listing import listing


def write_results(results: Results, out: OutputFolder, vtu: bool, frames: int, plots: bool) -> Results:
    """Write every file of a run into an open output folder.

    Parameters
    ----------
    results
        ``time["write"]`` is set here, to the seconds spent on the VTU files and pictures, and so is ``files``.
    vtu, frames
        Files for ParaView, and the frames of each animation.
    plots
        One picture of each load case beside them.

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
        if vtu:
            _write_mesh_files(results, case, out, frames)
        if plots:
            _write_picture(results, case, out)
    files = sorted({*out.names, *(f"{out.stem}.{suffix}" for suffix in ("lst", "h5", "json"))})
    results = replace(results, time=results.time | {"write": time.perf_counter() - begin}, files=tuple(files))
    out.write_text(f"{out.stem}.lst", listing(results))
    out.write_bytes(f"{out.stem}.h5", write_results_hdf5(results))
    out.write_text(f"{out.stem}.json", json_line(results_json(results)) + "\n")
    return results


def write_outputs(
    results: Results, folder: Path, stem: str, force: bool, vtu: bool, frames: int, plots: bool
) -> tuple[str, ...]:
    """Write every file of a run to a folder; the names written. Raises as ``write_results`` and ``OutputFolder`` do."""
    with OutputFolder(folder, stem, force) as out:
        write_results(results, out, vtu, frames, plots)
    return out.names


def _write_mesh_files(results: Results, case: CaseResult, out: OutputFolder, frames: int) -> None:
    """``STEM_CASE_blocks.vtu`` and its like, the frames, and the collection that plays them."""
    model, contacts = results.model.of_case(case.load_case), results.contacts
    stem = f"{out.stem}_{case.load_case.name}"
    cells = block_cells(model.blocks)
    with out.writing(f"{stem}_blocks.vtu") as path:
        write_blocks_vtu(path, model, contacts, case, cells)
    for kind, write in CONTACT_FILES if len(contacts) else ():
        with out.writing(f"{stem}_{kind}.vtu") as path:
            write(path, model, contacts, case)
    times = frame_times(frames) if _moves(case) else [0.0]
    names = [f"{stem}_frame_{i:03d}.vtu" for i in range(len(times))]
    for name, moment in zip(names, times, strict=True):
        with out.writing(name) as path:
            write_frame_vtu(path, model, case, moment, cells)
    out.write_text(f"{stem}.pvd", collection_pvd(names, times))


def _moves(case: CaseResult) -> bool:
    return case.solution.mechanics is not None or case.solution.certificate is not None


def _write_picture(results: Results, case: CaseResult, out: OutputFolder) -> None:
    from mbla.results.pictures.plot import plot_mechanism

    with out.writing(f"{out.stem}_{case.load_case.name}.png") as path:
        plot_mechanism(results, case, path)
