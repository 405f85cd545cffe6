"""How the benchmarks measure and record: shortest of a few runs, one row each, with date, versions and machine."""

from __future__ import annotations

import csv
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import version
from pathlib import Path
from tempfile import NamedTemporaryFile

from tests.performance.columns import columns_of

RESULTS = Path(__file__).parent / "results"
PROJECT = Path(__file__).parents[2]
REPEATS = 3
OCCASION = ("date", "versions", "machine")
LIBRARIES = ("mbla", "numpy", "scipy", "clarabel", "shapely", "h5py", "meshio", "pyyaml", "pydantic")


def best_time(run: Callable[[], object], repeats: int = REPEATS) -> tuple[float, float]:
    """Shortest of a few runs by the clock and by the processor, s; they differ where the machine is busy."""
    clock, processor = [], []
    for _ in range(repeats):
        start = time.perf_counter(), time.process_time()
        run()
        clock.append(time.perf_counter() - start[0])
        processor.append(time.process_time() - start[1])
    return min(clock), min(processor)


def record(benchmark: str, row: Mapping[str, object]) -> None:
    """Put a row into ``results/BENCHMARK.csv`` and say it; numbers get four digits.

    It replaces rows of the same case of that day, those versions and that machine: who measures again means the newest.

    Raises
    ------
    ValueError
        the file has other columns: its figures are of another benchmark, and the row would land in the wrong ones
    """
    RESULTS.mkdir(exist_ok=True)
    path = RESULTS / f"{benchmark}.csv"
    values = {name: f"{value:.4g}" if isinstance(value, float) else str(value) for name, value in row.items()}
    full = {"date": datetime.now(UTC).date().isoformat(), **values, "versions": versions(), "machine": machine()}
    header, rows = _recorded(path)
    if header and header != list(full):
        raise ValueError(f"{path}: has the columns {', '.join(header)}, the row has {', '.join(full)}")
    same = (*columns_of(benchmark, list(full)).case, *OCCASION)
    kept = [other for other in rows if any(other[name] != full[name] for name in same)]
    with NamedTemporaryFile("w", newline="", encoding="utf-8", dir=RESULTS, delete=False) as file:
        writer = csv.DictWriter(file, list(full), lineterminator="\n")
        writer.writeheader()
        writer.writerows([*kept, full])
    Path(file.name).chmod(0o644)  # a temporary file is its owner's alone
    Path(file.name).replace(path)
    sys.stdout.write("  ".join(f"{name} {value}" for name, value in values.items()) + "\n")


def _recorded(path: Path) -> tuple[list[str], list[dict[str, str]]]:
    """Header and rows of a file, none where there is none."""
    if not path.exists():
        return [], []
    with path.open(newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        return list(reader.fieldnames or []), list(reader)


@cache
def versions() -> str:
    """Versions that the figures depend on; of mbla also the last commit, with + where the files differ from it."""
    libraries = [f"{name} {version(name)}" for name in LIBRARIES]
    libraries[0] += commit()
    return " ".join([f"python {platform.python_version()}", *libraries])


def commit() -> str:
    """`` (a1b2c3d)``: the last commit that changed the package; empty outside a repository."""

    def git(*arguments: str) -> str:
        command = ["git", *arguments, "--", "mbla"]
        return subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True).stdout.strip()

    try:
        last, changed = git("log", "-1", "--format=%h"), git("status", "--porcelain")
    except (OSError, subprocess.CalledProcessError):
        return ""
    return f" ({last}{'+' if changed else ''})" if last else ""


def machine() -> str:
    """Processor and number of cores."""
    information = Path("/proc/cpuinfo")
    lines = information.read_text(encoding="utf-8").splitlines() if information.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return (
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} x {models[0] if models else platform.processor()}"
    )
