"""How the benchmarks record: a row for each measurement, with date, versions and machine."""

from __future__ import annotations

import csv
import os
import platform
import subprocess
import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path

RESULTS = Path(__file__).parent / "results"
PROJECT = Path(__file__).parents[2]
LIBRARIES = ("mbla", "numpy", "scipy", "clarabel", "shapely", "h5py", "meshio", "pyyaml", "pydantic")
Row = dict[str, str]
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""of the environment of a process that is measured"""

CASES = {
    "house": ("state", "what", "figure"),
    "line": ("structure", "flow_rule"),
    "lmgc90": ("scene", "point", "joints", "program", "step_ms", "amplitude"),
    "forms": ("structure", "case"),
    "time_step": ("scene",),
    "kernels": ("structure", "case"),
    "rigid_in_time": ("structure", "case", "ratio"),
    "time_history": ("scene", "step"),
    "energy_of_random_scenes": ("scene",),
    "path": ("structure",),
    "path_settings": ("setting", "way"),
    "rivals": ("structure", "rival"),
    "pushover": ("structure",),
    "pushover_random": ("structure",),
    "sweep": ("sweep", "way", "points"),
}
"""columns that tell the cases of a benchmark apart"""


def record(benchmark: str, row: Mapping[str, object]) -> None:
    """Put a row into ``results/BENCHMARK.csv`` and say it; numbers get four digits.

    It replaces the row of the same case of that day, those versions and that machine: who measures again means the
    newest.

    Raises
    ------
    ValueError
        the file has other columns: its figures are of another benchmark, and the row would land in the wrong ones
    """
    path = RESULTS / f"{benchmark}.csv"
    values = {name: f"{value:.4g}" if isinstance(value, float) else str(value) for name, value in row.items()}
    full = {"date": datetime.now(UTC).date().isoformat(), **values, "versions": versions(), "machine": machine()}
    rows = read_rows(path)
    if rows and list(rows[0]) != list(full):
        raise ValueError(f"{path}: has the columns {', '.join(rows[0])}, the row has {', '.join(full)}")
    same = (*CASES[benchmark], "date", "versions", "machine")
    kept = [other for other in rows if any(other[name] != full[name] for name in same)]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(full), lineterminator="\n")
        writer.writeheader()
        writer.writerows([*kept, full])
    sys.stdout.write("  ".join(f"{name} {value}" for name, value in values.items()) + "\n")


def read_rows(path: Path) -> list[Row]:
    """Rows of a recorded benchmark, oldest first; none where there is no file."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@cache
def versions() -> str:
    """Versions that the figures depend on; of mbla also the last commit, with + where the files differ from it."""
    libraries = [f"{name} {version(name)}" for name in LIBRARIES]
    libraries[0] += f" ({commit()})" if commit() else ""
    return " ".join([f"python {platform.python_version()}", *libraries])


def commit(checkout: Path = PROJECT) -> str:
    """Short name of the commit, with + where files differ from it; empty without version control."""
    words = ["git", "-C", str(checkout), "describe", "--always", "--dirty=+", "--abbrev=9"]
    try:
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def machine() -> str:
    """Processor and number of cores."""
    information = Path("/proc/cpuinfo")
    lines = information.read_text(encoding="utf-8").splitlines() if information.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return (
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} x {models[0] if models else platform.processor()}"
    )
