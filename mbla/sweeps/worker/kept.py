"""Result files of points, for those who want to look at them."""

from __future__ import annotations

from pathlib import Path

from mbla.deck.sections.output import OutputSection
from mbla.results.files import OutputFolder
from mbla.results.results import Results
from mbla.results.write import write_results
from mbla.sweeps.plan import FAILED, Plan, Task

FOLDER = "points"
"""in the folder of the sweep; one folder for each point in it, by its number"""


def wanted(plan: Plan, state: str) -> bool:
    """Whether the files of a point are kept; one whose deck was refused or whose process died has none."""
    return plan.keep == "all" or (plan.keep == FAILED and state == FAILED)


def keep_files(plan: Plan, task: Task, results: Results, status: str, output: OutputSection) -> None:
    """Write the files that ``mbla run`` would write.

    status : content of the status file
    output : what the deck asks for

    Raises
    ------
    FileError
        they cannot be written
    """
    stem = Path(plan.deck).stem
    with OutputFolder(Path(plan.folder) / FOLDER / str(task.number), stem, force=True) as out:
        out.write_text(f"{stem}.sta", status)
        write_results(results, out, output)
