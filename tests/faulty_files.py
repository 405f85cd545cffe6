"""Faulty decks and sweep files as a table: each is a base with some of its sections replaced.

``table.yaml`` of a folder holds the texts of the bases, and below ``cases`` groups of files of one base, or of none.
A file gives the sections of the base that it replaces, and new ones, which come last; ``without NAME`` leaves one out.
«identifier» stands where a fault of that kind is found, before its first character. ``schema`` says whether the JSON
schema sees a fault, or accepts the file. Files that they name lie beside the table.
"""

from __future__ import annotations

import atexit
import re
import shutil
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from mbla.errors import Fault

MARK = re.compile(r"«([a-z0-9-]+)»")
SECTION = re.compile(r"^(?=(?:«[a-z0-9-]+»)*(\w+):)", re.MULTILINE)
LEFT_OUT = re.compile(r"^without (\w+)\n", re.MULTILINE)


@dataclass(frozen=True)
class FaultyFile:
    """A faulty text, place and identifier of each of its faults, ``16:42  [out-of-bounds]``."""

    text: str
    faults: tuple[str, ...]
    schema_accepts: bool


class FaultyFiles(NamedTuple):
    """Faulty files, written to a folder of this process beside the files that they name."""

    folder: Path
    files: dict[Path, FaultyFile]


def sections_of(text: str) -> dict[str, str]:
    """The top sections of a text by their names, each with the lines below it."""
    _, *parts = SECTION.split(text)
    return dict(zip(parts[::2], parts[1::2], strict=True))


def patched(base: str, patch: str) -> str:
    """A base with the sections of a patch."""
    left_out = LEFT_OUT.findall(patch)
    sections = sections_of(base) | sections_of(LEFT_OUT.sub("", patch))
    return "".join(text for name, text in sections.items() if name not in left_out)


def read_marks(text: str, schema_accepts: bool) -> FaultyFile:
    """A text without its marks, and what they say."""
    plain, *parts = MARK.split(text)
    faults = []
    for identifier, following in zip(parts[::2], parts[1::2], strict=True):
        line, column = plain.count("\n") + 1, len(plain) - plain.rfind("\n")
        faults.append(f"{line}:{column}  [{identifier}]")
        plain += following
    return FaultyFile(plain, tuple(faults), schema_accepts)


def table_of(folder: Path) -> Any:
    """The table of a folder as it stands there."""
    return yaml.safe_load((folder / "table.yaml").read_text(encoding="utf-8"))


def read_table(folder: Path) -> dict[str, FaultyFile]:
    """The files of a table by their names."""
    table = table_of(folder)
    found: dict[str, FaultyFile] = {}
    for group in table["cases"]:
        base = table["bases"][group["base"]] if group["base"] != "nothing" else None
        for name, patch in group["files"].items():
            assert name not in found, name
            text = patch if base is None else patched(base, patch)
            found[name] = read_marks(text, group["schema"] == "accepts")
    return dict(sorted(found.items()))


def write_faulty_files(folder: Path) -> FaultyFiles:
    """The files of a table in a folder that goes with this process."""
    target = Path(tempfile.mkdtemp(prefix=f"{folder.name}-")).resolve()
    atexit.register(shutil.rmtree, target)
    for path in folder.iterdir():
        if path.name not in ("table.yaml", "sentences.txt"):
            shutil.copy(path, target)
    files = {target / f"{name}.yaml": file for name, file in read_table(folder).items()}
    for path, file in files.items():
        path.write_text(file.text, encoding="utf-8")
    return FaultyFiles(target, files)


def place_and_kind(fault: Fault, path: Path) -> str:
    """A fault as a table expects it."""
    return f"{fault.place}  [{fault.identifier}]".removeprefix(f"{path}:")


def told_of(path: Path, faults: Iterable[Fault]) -> str:
    """Name of a faulty file and the sentences of its faults, a line each."""
    lines = [fault.line().removeprefix(f"{path}:").removeprefix(f"{path.parent}/") for fault in faults]
    return "\n".join([path.stem, *(f"  {line}" for line in lines), ""])
