"""Time to write and read the result files of large models; run by hand, appends to results/results.csv.

Cuboids in a grid, each on the one below, with made-up forces and velocities: what is measured does not look at them.

::

    python -m tests.performance.bench_results
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mbla.deck.sections.output import OutputSection
from mbla.model.model import LoadCase
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.listing.listing import listing
from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.tables.tables import Formats, export_results
from mbla.results.vtu.cells import block_cells
from mbla.results.vtu.loads import write_supports_vtu
from mbla.results.vtu.mesh_files import MESH_FILES, MeshFile
from mbla.results.vtu.vtu import write_blocks_vtu, write_frame_vtu
from mbla.results.write import write_outputs
from mbla.solution.solution import Mechanics
from tests.performance.recording import best_time, record
from tests.results.synthetic import cuboids, horizontal_contacts, tower_model, tower_results

SIZES = (1_000, 10_000)
COURSES = 10
FRAMES = 11


def grid(n_blocks: int) -> Results:
    """Stacks of COURSES cuboids, the lowest of each fixed, with one case of random forces and velocities."""
    generator = np.random.default_rng(0)
    x, z = np.divmod(np.arange(n_blocks), COURSES)
    lower = np.column_stack([1.1 * x, 0 * x, z]).astype(float)
    blocks = cuboids(lower, lower + 1, ["wall"] * n_blocks)
    above = np.flatnonzero(z > 0)
    rectangles = [(1.1 * x[b], 1.1 * x[b] + 1, 0, 1, z[b]) for b in above]
    contacts = horizontal_contacts(np.column_stack([above - 1, above]), rectangles)
    loads = generator.normal(size=(2, n_blocks, 6))
    load_case = LoadCase("push", loads[0], loads[1], ("gravity",), ("acceleration (1, 0, 0) g",))
    model = replace(tower_model(), blocks=blocks, fixed=z == 0, grounds=(), load_cases=(load_case,))
    n_points = len(contacts.points)
    mechanics = Mechanics(
        0.5,
        generator.normal(size=(n_points, 3)),
        generator.normal(size=(n_points, 3)),
        generator.normal(size=(n_blocks, 6)) * (z > 0)[:, None],
        generator.integers(0, 3, n_points),
    )
    results = tower_results()
    solution = replace(results.cases[0].solution, mechanics=mechanics, associative=mechanics)
    case = CaseResult(load_case, solution, results.cases[0].checks, results.cases[0].status)
    return replace(results, model=model, contacts=contacts, cases=(case,), notices=())


def steps(results: Results, folder: Path) -> dict[str, Callable[[], object]]:
    """What is timed, by name; every step writes to the folder."""
    model, case, polyhedra = results.model, results.cases[0], as_polyhedra(results)

    def scene() -> Scene:  # a new one each time, for it keeps what it has derived
        return scene_of(results, results.cases[0])

    image = folder / "image.h5"

    def write_image() -> None:
        image.write_bytes(write_results_hdf5(results))

    def write_one(file: MeshFile) -> None:
        file.write(folder / f"{file.kind}.vtu", scene())

    return {
        "hdf5 write": write_image,
        "hdf5 read": lambda: read_results_hdf5(image),
        "listing": lambda: listing(results),
        "json": lambda: json_line(results_json(results)),
        "cells": lambda: block_cells(model.blocks),
        "blocks.vtu, polyhedra": lambda: write_blocks_vtu(folder / "polyhedra.vtu", scene_of(polyhedra, case)),
        **{f"{file.kind}.vtu": partial(write_one, file) for file in MESH_FILES},
        "supports.vtu": lambda: write_supports_vtu(folder / "supports.vtu", model, results.contacts),
        "one frame": lambda: write_frame_vtu(folder / "frame.vtu", scene(), 0.5),
        "csv": lambda: export_results(results, folder, "wall", Formats(csv=True), force=True),
        "parquet": lambda: export_results(results, folder, "wall", Formats(parquet=True), force=True),
        f"all files, {FRAMES} frames": lambda: write_outputs(
            results, folder / "all", "wall", True, OutputSection(frames=FRAMES)
        ),
    }


def as_polyhedra(results: Results) -> Results:
    """The blocks as polyhedra although they are cuboids."""
    unknown = replace(results.model.blocks, convex=np.zeros(len(results.model.blocks), dtype=bool))
    return replace(results, model=replace(results.model, blocks=unknown))


def main() -> None:
    """Best of a few runs of each step, one row each."""
    for n_blocks in SIZES:
        results = grid(n_blocks)
        with TemporaryDirectory() as name:
            for step, action in steps(results, Path(name)).items():
                before = _bytes(Path(name))
                seconds, processor = best_time(action)
                row: dict[str, object] = {"step": step, "blocks": n_blocks, "points": len(results.contacts.points)}
                row |= {"seconds": seconds, "processor_seconds": processor}
                record("results", row | {"bytes": _bytes(Path(name)) - before})


def _bytes(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


if __name__ == "__main__":
    main()
