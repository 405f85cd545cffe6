"""The sweep files of tests/invalid_sweeps, as tests/faulty_decks.py has the decks.

``python -m tests.faulty_sweeps --update`` writes their sentences anew.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

from mbla.errors import DeckError
from mbla.sweeps.base import read_base
from mbla.sweeps.file.read import read_sweep
from tests.faulty_files import told_of, write_faulty_files

SENTENCES = Path(__file__).parent / "invalid_sweeps" / "sentences.txt"
FOLDER, SWEEPS = write_faulty_files(SENTENCES.parent)


@cache
def refusal_of(path: Path) -> DeckError:
    """The error of a faulty sweep file."""
    try:
        read_base(read_sweep(path))
    except DeckError as error:
        return error
    raise AssertionError(f"{path.name} is not refused")


def sentences() -> str:
    """What is said of each sweep file."""
    return "\n".join(told_of(path, refusal_of(path).faults) for path in SWEEPS)


if __name__ == "__main__" and sys.argv[1:] == ["--update"]:
    SENTENCES.write_text(sentences(), encoding="utf-8")
