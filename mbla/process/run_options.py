"""What a run is asked for in addition to its deck; imports nothing, so that the command line can read a deck first."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class RunOptions:
    """What the command line adds to a deck.

    folder    : for the results; DECK_NAME.out next to the deck if None
    overrides : key.path=value texts
    cases     : names of the load cases to solve; all if empty
    force     : replace an earlier result
    threads   : asked for, of libraries that can use several
    expected  : compare with the deck's ``expected`` section
    resume    : go on from what a run of the same deck that was stopped has left
    """

    folder: Path | None = None
    overrides: tuple[str, ...] = ()
    cases: tuple[str, ...] = ()
    force: bool = False
    threads: int = 1
    expected: bool = False
    resume: bool = False

    def folder_for(self, deck_path: Path) -> Path:
        """Where the results of a deck go."""
        return deck_path.with_suffix(".out") if self.folder is None else self.folder
