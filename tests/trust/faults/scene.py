"""A deck with an earlier result, over which a run meets with faults, and what it leaves."""

from __future__ import annotations

import shutil
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tests.line import BLOCK
from tests.trust.processes import Begun, Commands, Ended

DECK = BLOCK + "output: {vtu: true, frames: 2}\n"
PARTIAL = ("block.partial.h5", "block.partial.lst", "block.partial.json")
PARTIAL_STATUS = "block.partial.sta"
IMPORTED = (
    *("mbla.run", "mbla.check", "mbla.cli.starters", "mbla.results.listing.summary", "mbla.results.pictures.plot"),
    *("mbla.results.report.report", "mbla.results.tables.tables", "mbla.solution.verification.verify_convex"),
    *("h5py", "meshio", "clarabel"),
)


class Scene:
    """A deck and the folder of its earlier result, which is of other figures.

    new, lasts : what a run leaves in which nothing fails, and how long it takes [s]
    """

    def __init__(self, commands: Commands, folder: Path) -> None:
        self.commands = commands
        self.deck = written(folder / "block.yaml")
        self.out = folder / "block.out"
        assert self.run("--set", "parameters.mu=0.3").status == 0
        self.earlier = content(self.out)
        begun = time.monotonic()
        assert self.run("--force").status == 0
        self.lasts = time.monotonic() - begun
        self.new = content(self.out)

    def run(self, *options: str | Path, **how: Any) -> Ended:
        """``mbla run``, with limits."""
        return self.commands.run("run", self.deck, "-q", *options, **how)

    def over_the_earlier(self, *options: str | Path, **how: Any) -> Ended:
        """The same over the earlier result."""
        restored(self.out, self.earlier)
        return self.run("--force", *options, **how)

    def begin(self) -> Begun:
        """The same, begun."""
        restored(self.out, self.earlier)
        return self.commands.begin("run", self.deck, "-q", "--force")


def written(path: Path, text: str = DECK) -> Path:
    """A deck, with its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def content(folder: Path) -> dict[str, bytes]:
    """Files of a folder byte for byte, hidden ones as well; empty where there is no folder."""
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())} if folder.is_dir() else {}


def visible(folder: Path) -> dict[str, bytes]:
    """The same without temporaries and locks."""
    return {name: data for name, data in content(folder).items() if not name.startswith(".")}


def without_partial(found: dict[str, bytes]) -> dict[str, bytes]:
    """Files of a folder without those that a stopped run left: where there is its result file, there are the others."""
    assert "block.partial.h5" not in found or set(PARTIAL) <= set(found)
    return {name: data for name, data in found.items() if name not in (*PARTIAL, PARTIAL_STATUS)}


def restored(folder: Path, files: Mapping[str, bytes]) -> None:
    """The folder with these files and no others."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, data in files.items():
        (folder / name).write_bytes(data)


def is_one_plain_line(err: str) -> bool:
    """Whether an error was told in one line and without a traceback."""
    return err.count("\n") == 1 and err.startswith("mbla: ") and "Traceback" not in err
