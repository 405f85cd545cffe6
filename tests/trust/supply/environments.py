"""Environments of their own with mbla from its wheel, in the lowest and in the newest versions that are allowed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.decks.folder import ROOT

EXTRAS = "pictures,report,tables,dask,mkl,cholmod"
LOWEST, NEWEST = "lowest-direct", "highest"


def wheel(folder: Path) -> Path:
    """The wheel, built from the sources into a folder."""
    _uv("build", "--wheel", "--quiet", "--out-dir", folder, ROOT)
    (built,) = folder.glob("mbla-*.whl")
    return built


def environment(folder: Path, built: Path, resolution: str) -> Path:
    """An empty environment with the wheel and what it asks for, and nothing else; its Python."""
    _uv("venv", "--quiet", "--python", sys.executable, folder)
    python = folder / "bin" / "python"
    _uv(
        *("pip", "install", "--quiet", "--python", python, "--resolution", resolution),
        *("--only-binary", ":all:", f"mbla[{EXTRAS}] @ {built.as_uri()}"),
    )
    return python


def _uv(*arguments: str | Path) -> None:
    done = subprocess.run(["uv", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
