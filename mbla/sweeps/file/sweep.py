"""A sweep file as the later steps get it: checked content, and the place of every value for their own messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mbla.deck.tree import KeyPath
from mbla.errors import Fault, Message
from mbla.sweeps.file.content import SweepContent


@dataclass(frozen=True)
class Sweep:
    """A checked sweep file; its base deck is not read yet.

    path      : the file
    content   : what it says
    text      : as read
    sha256    : of the text, 64 hex digits
    overrides : ``--set`` texts for the deck, for every point, after those of `set`
    """

    path: Path
    content: SweepContent
    text: str
    sha256: str
    overrides: tuple[str, ...]
    fault_at: Callable[[KeyPath, Message], Fault]
    """Fault for a key path such as ("parameters", "mu", "linear") with a message; finds place and value itself."""
