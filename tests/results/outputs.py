"""All files of a result, written to a folder at once."""

from __future__ import annotations

from pathlib import Path

from mbla.deck.content import OutputSection
from mbla.process.run_options import RunOptions
from mbla.results.files import OutputFolder
from mbla.results.results import Results
from mbla.results.write import write_results
from mbla.run import run

EARTH_PRESSURE = Path(__file__).parents[2] / "decks" / "benchmarks" / "closed_forms" / "active_earth_pressure.yaml"


def write_outputs(results: Results, folder: Path, stem: str, force: bool, output: OutputSection) -> tuple[str, ...]:
    """Write every file of a run to a folder; the names written. Raises as ``write_results`` and ``OutputFolder`` do."""
    with OutputFolder(folder, stem, force) as out:
        write_results(results, out, output)
    return out.names


def soil_file(folder: Path) -> Path:
    """Result file of a run with soil of cells, in that folder."""
    run(EARTH_PRESSURE, RunOptions(folder, overrides=("units.force=N",), force=True))
    return folder / "active_earth_pressure.h5"
