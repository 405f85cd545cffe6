"""Environments of their own with mbla from its wheel, in the lowest and in the newest versions that are allowed."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

from tests.decks.folder import ROOT

EXTRAS = ("pictures", "report", "tables", "dask", "cholmod", "test")
LOWEST, NEWEST = "lowest-direct", "highest"


def wheel(folder: Path) -> Path:
    """The wheel, built from the sources into a folder."""
    _uv("build", "--wheel", "--quiet", "--out-dir", folder, ROOT)
    (built,) = folder.glob("mbla-*.whl")
    return built


def environment(folder: Path, built: Path, resolution: str) -> Path:
    """A new environment with the wheel and what it and its tests ask for, and nothing else; its Python.

    What the wheel asks for is named beside it: only versions of what is named are chosen low.
    """
    _uv("venv", "--quiet", "--python", sys.executable, folder)
    python = folder / "bin" / "python"
    named = folder / "named.txt"
    wanted = [f"mbla[{','.join(EXTRAS)}] @ {built.as_uri()}", *declared()]
    named.write_text("\n".join(wanted) + "\n", encoding="utf-8")
    _uv(
        *("pip", "install", "--quiet", "--python", python, "--resolution", resolution),
        *("--only-binary", ":all:", "--requirement", named),
    )
    return python


def declared() -> list[str]:
    """Requirements as ``pyproject.toml`` has them, of mbla and of its extras."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [text for extra in EXTRAS for text in project["optional-dependencies"][extra]]
    return [text for text in (*project["dependencies"], *extras) if not text.startswith("mbla[")]


def _uv(*arguments: str | Path) -> None:
    done = subprocess.run([sys.executable, "-m", "uv", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
