"""Memory over a sweep of points of one block, watched from outside.

Friction, width and direction of the push are varied, so that geometry, contacts and cone program are all built anew.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import yaml

from mbla.sweeps.engine.supervised import PACKAGES
from tests.line import BLOCK
from tests.sweeps.killed_sweeps import descendants

POINTS = 10_000
PART = 10
"""the memory in the first and in the last of so many parts of the points is compared"""
SAMPLES = 0.05
"""seconds between two looks"""
WIDTHS, DIRECTIONS = 20, 20
MEGABYTE = 1e6


@dataclass
class Watched:
    """Resident memory [MB] over a sweep.

    rows    : (n_samples,) points finished
    command : (n_samples,)
    points  : (n_samples,) of the greatest process of points; 0 before there is one
    begun   : processes of points that were seen
    """

    rows: list[int] = field(default_factory=list)
    command: list[float] = field(default_factory=list)
    points: list[float] = field(default_factory=list)
    begun: set[int] = field(default_factory=set)

    def most(self, memory: Sequence[float], first: float, last: float) -> float:
        """Most that was held while the share of finished points was between the two."""
        share = np.array(self.rows) / max(self.rows)
        return float(np.array(memory)[(share > first) & (share <= last)].max())

    def first(self, memory: Sequence[float]) -> float:
        """Most that was held in the first part of the points."""
        return self.most(memory, 0.0, 1.0 / PART)

    def last(self, memory: Sequence[float]) -> float:
        """Most that was held in the last part of the points."""
        return self.most(memory, 1.0 - 1.0 / PART, 1.0 - 1e-9)

    @property
    def kilobytes_per_point(self) -> float:
        """Growth of the command over the points between."""
        between = max(self.rows) * (1.0 - 1.0 / PART)
        return 1e3 * (self.last(self.command) - self.first(self.command)) / between


def written(folder: Path, points: int, widths: int = WIDTHS, directions_around: int = DIRECTIONS) -> Path:
    """The sweep file, its deck beside it."""
    (folder / "block.yaml").write_text(BLOCK, encoding="utf-8")
    angles = 2 * np.pi * np.arange(directions_around) / directions_around
    directions = [[float(np.cos(angle)), float(np.sin(angle)), 0.0] for angle in angles]
    parameters = {
        "b": {"linear": {"from": 0.5, "to": 1.5, "points": widths}},
        "direction": {"key": "load_cases.push.live.0.acceleration", "values": directions},
        "mu": {"linear": {"from": 0.1, "to": 0.9, "points": points // (widths * directions_around)}},
    }
    path = folder / "block_sweep.yaml"
    path.write_text(yaml.safe_dump({"mbla_sweep": 1, "deck": "block.yaml", "parameters": parameters}), encoding="utf-8")
    return path


def watched(folder: Path, points: int, workers: int) -> Watched:
    """Run the sweep and watch it; AssertionError where a point failed."""
    path = written(folder, points)
    command = [sys.executable, "-P", "-m", "mbla", "sweep", str(path), "-q", "-j", str(workers)]
    found = Watched()
    with subprocess.Popen(command, env=os.environ | {"PYTHONPATH": str(PACKAGES)}) as process:
        journal, read, rows = path.with_suffix(".out") / "journal.csv", 0, -2  # two lines of header
        while process.poll() is None:
            time.sleep(SAMPLES)
            with suppress(FileNotFoundError), journal.open("rb") as file:
                file.seek(read)
                new = file.read()
                read, rows = read + len(new), rows + new.count(b"\n")
            children = descendants(process.pid)
            found.rows.append(max(rows, 0))
            found.command.append(resident(process.pid))
            found.points.append(max(map(resident, children), default=0.0))
            found.begun.update(filter(solves_points, children))
        assert process.returncode == 0, f"exit status {process.returncode}"
    return found


def solves_points(pid: int) -> bool:
    """Whether a process was begun for points, by a command that gives each a group of its own: no helper of one."""
    with suppress(OSError):
        command = Path(f"/proc/{pid}/cmdline").read_bytes()
        return b"mbla.sweeps.engine.child" in command and os.getpgid(pid) == pid
    return False


def resident(pid: int) -> float:
    """Memory that a process holds [MB]; 0 where it has ended."""
    with suppress(OSError):
        pages = int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / MEGABYTE
    return 0.0
