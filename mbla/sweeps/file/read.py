"""From a sweep file to checked content, by the reader of decks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.deck.expressions import is_expression
from mbla.deck.text.include import read_files
from mbla.deck.text.sources import FileKind
from mbla.deck.units import Units
from mbla.deck.validation import validate
from mbla.errors import DeckError, Fault, KeyPath, Message, ValueRefused
from mbla.process.collector import no_collection
from mbla.sweeps.file import rules as rules
from mbla.sweeps.file.content import SweepContent


@dataclass(frozen=True)
class Sweep:
    """A checked sweep file; its base deck is not read yet.

    path      : the file
    content   : what it says
    overrides : ``--set`` texts for the deck, for every point, after those of `set`
    """

    path: Path
    content: SweepContent
    overrides: tuple[str, ...]
    fault_at: Callable[[KeyPath, Message], Fault]
    """Fault for a key path such as ("parameters", "mu", "linear") with a message; finds place and value itself."""


SWEEP_FILE = FileKind(name="sweep file", begins="mbla_sweep: 1", includes=False)


@no_collection()
def read_sweep(path: Path, overrides: Sequence[str] = ()) -> Sweep:
    """Read and check a sweep file; its base deck is another step (``base.py``).

    path      : the sweep file
    overrides : ``key.path=value`` texts for the deck, for every point

    Raises DeckError: with every fault found. Raises FileError: if the file cannot be opened.
    """
    tree, reading = read_files(path, kind=SWEEP_FILE)
    if not reading.complete:  # what could not be read would be reported as missing
        raise DeckError(reading.faults)
    if "mbla" in tree.data and "mbla_sweep" not in tree.data:
        message = "this is a deck, not a sweep file: mbla run solves it; a sweep file names it as its deck"
        raise DeckError([tree.fault(("mbla",), Message("sweep-file-and-deck", message), at_key=True)])
    content, faults = validate(tree, SweepContent, _number, reading.reported, reading.damaged)
    faults += reading.faults
    if content is None or faults:
        raise DeckError(list(dict.fromkeys(faults)))
    return Sweep(path, content, tuple(overrides), tree.fault)


def _number(text: str, dimension: str) -> float:
    """Number of a text, where a sweep file takes one: a time with its unit."""
    if is_expression(text):
        raise ValueRefused(
            "sweep-values", "expressions belong to decks: write the number, or vary a parameter that the deck uses"
        )
    return Units().convert(text, dimension)
