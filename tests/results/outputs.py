"""All files of a result, written to a folder at once."""

from __future__ import annotations

from pathlib import Path

from mbla.deck.content import OutputSection
from mbla.results.files import OutputFolder
from mbla.results.results import Results
from mbla.results.write import write_results


def write_outputs(results: Results, folder: Path, stem: str, force: bool, output: OutputSection) -> tuple[str, ...]:
    """Write every file of a run to a folder; the names written. Raises as ``write_results`` and ``OutputFolder`` do."""
    with OutputFolder(folder, stem, force) as out:
        write_results(results, out, output)
    return out.names
