"""What commands make of a file: run in a worker, judged by what a user sees."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

REFUSED = 6
STATUSES = (0, 4, 5, 6)
"""documented for commands on results; 5 and 4 from verify, 4 from diff"""
MOST_SECONDS = 5.0
"""of processor time until a file is refused"""
MOST_MIB = 2048

HISTORY = frozenset(
    (
        *("mbla", "deck", "title", "time", "created", "deck_sha256", "notices", "files", "provenance", "settings"),
        *("iterations", "programs", "path", "size", "reductions", "solver", "scheme", "reason", "remarks", "set"),
        *("overrides", "agrees", "disagreements", "not_verified", "seconds"),
    )
)
"""keys of the record that prove nothing and that nothing in the file proves: what was run where, and how it went"""
ROUNDING = 1e-5


@dataclass(frozen=True)
class Ended:
    """How a command ended: exit status, below zero for a signal; processor time; peak memory; what it printed."""

    status: int
    seconds: float
    mib: float
    out: str
    err: str


class Worker:
    """Commands run one after the other, none of which can take the others down."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def run(self, *arguments: str | Path) -> Ended:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps([str(argument) for argument in arguments]) + "\n")
        self._process.stdin.flush()
        return Ended(**json.loads(self._process.stdout.readline()))


@contextmanager
def worker(folder: Path, *options: str) -> Iterator[Worker]:
    """A worker whose messages go to a file in the folder; ``--drawing`` for one that is to draw."""
    with (folder / "worker.txt").open("w") as said:
        process = subprocess.Popen(
            [sys.executable, "-m", "tests.trust.corrupted.worker", *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=said,
            text=True,
            cwd=Path(__file__).parents[3],
        )
        try:
            yield Worker(process)
        finally:
            assert process.stdin is not None
            process.stdin.close()
            process.wait(timeout=60)
            assert process.stdout is not None
            process.stdout.close()


def commands(path: Path, good: Path, out: Path) -> dict[str, tuple[str | Path, ...]]:
    """Arguments of every command that reads a result file; ``good`` is another to compare with."""
    return {
        "show": ("show", path),
        "verify": ("verify", path, "--json"),
        "diff": ("diff", path, good),
        "export": ("export", path, "--csv", "-o", out / "tables", "--force"),
        "plot": ("plot", path, "-o", out / "pictures", "--kind", "mechanism", "--format", "svg"),
        "report": ("report", path, "-o", out / "report.html", "--no-3d"),
    }


def faults_of(path: Path, ended: Ended) -> list[str]:
    """What is wrong with how a command ended, whatever the file."""
    faults = []
    if ended.status not in STATUSES:
        faults.append(f"exit status {ended.status}")
    if "Traceback" in ended.err or "Warning" in ended.err:
        faults.append("traceback or warning")
    if ended.mib > MOST_MIB:
        faults.append(f"{ended.mib:.0f} MiB")
    if ended.status == REFUSED:
        if len(ended.err.splitlines()) != 1 or str(path) not in ended.err or not _is_refusal(ended.out):
            faults.append("a refusal that is not one line about the file")
        if ended.seconds > MOST_SECONDS:
            faults.append(f"refused after {ended.seconds:.1f} s")
    return [f"{fault}: {ended.err.strip()[-300:]}" for fault in faults]


def _is_refusal(out: str) -> bool:
    """Whether nothing was printed, or the object of a refusal where one was asked for."""
    return not out or json.loads(out)["exit_code"] == REFUSED


def claims(record: str) -> dict[str, Any]:
    """What ``verify --json`` says of a file but for the history of the run.

    Whether the run solved a structure as planar is history too: it may be told not to. How far contact forces are
    determined is counted in that many dimensions, and so belongs to it.
    """
    told = json.loads(record)
    dimension = told["model"].pop("dimension")
    for case in told["cases"]:
        if case["mechanism"] is not None:
            case["mechanism"]["force_freedom"] = {str(dimension): case["mechanism"].pop("force_freedom")}
    claimed: dict[str, Any] = _without_history(told)
    return claimed


def _without_history(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_history(item) for key, item in value.items() if key not in HISTORY}
    return [_without_history(item) for item in value] if isinstance(value, list) else value


def differing(one: Any, other: Any, path: str = "") -> list[str]:
    """Key paths under which two records differ by more than rounding."""
    if path.endswith("force_freedom") and one.keys() != other.keys():
        return []
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        return [place for key in one for place in differing(one[key], other[key], f"{path}.{key}")]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        rows = enumerate(zip(one, other, strict=True))
        return [place for row, (a, b) in rows for place in differing(a, b, f"{path}[{row}]")]
    if isinstance(one, float) and isinstance(other, float):
        return [] if abs(one - other) <= ROUNDING * max(1.0, abs(one)) else [f"{path}: {one} and {other}"]
    return [] if one == other else [f"{path}: {one} and {other}"]
