"""What the files of studies have in common: pictures where they can be drawn, and what an interruption leaves."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mbla.errors import UsageError
from mbla.results.files import OutputFolder
from mbla.results.pictures.page import matplotlib_parts

PICTURES = ("png", "svg")
INTERRUPTION = "interrupted: here is what was found until then"
LEFT = "the files of the earlier study are left as they are"
"""of a study that was interrupted"""


def without_pictures() -> str:
    """Why there can be no pictures; empty where there can."""
    try:
        matplotlib_parts()
    except UsageError as error:
        return f"no pictures: {error}"
    return ""


def record_text(record: Mapping[str, Any]) -> str:
    """A record as its file has it."""
    return json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def written(out: OutputFolder, names: Sequence[str], interrupted: bool, write: Callable[[], list[str]]) -> list[str]:
    """Write the files of a study, of an interrupted one unless earlier files are there; what is to be said of it.

    names : of files that a study always has
    """
    if not interrupted:
        return write()
    if any((out.folder / name).exists() for name in names):
        return [INTERRUPTION, LEFT]
    return [INTERRUPTION, *write()]
