"""What is fuzzed: reading a file of some kind, the model and the contacts, as ``mbla check`` does; solving nothing."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mbla.cli.check import check
from mbla.deck import read_deck
from mbla.deck.content import DeckContent
from mbla.deck.section import built
from mbla.errors import DeckError
from mbla.model.blocks import amounts
from mbla.process.run_options import RunOptions
from mbla.sweeps.command import SweepOptions, prepare
from mbla.sweeps.file.content import SweepContent
from mbla.sweeps.file.read import read_sweep
from tests.limited import limited
from tests.line import WALL
from tests.trust.hostile.samples import MESHES, NAMED_DECK

KINDS = ("deck", "sweep", *MESHES)
"""kinds of files: decks, sweep files, and geometry files by their extension"""
LONGEST = 5.0
"""seconds of processor time that reading a file may take"""
FEW_BLOCKS = 300
"""what the program allows here in the place of millions: whatever it lets through is then small"""


class Broken(AssertionError):
    """The program answered, but not as it promises."""


def build_types() -> None:
    """What reading a first deck and a first sweep file builds, once for all that are read."""
    built(DeckContent)
    built(SweepContent)


def prepare_folder(folder: Path) -> None:
    """Put the files there that decks and sweep files of the samples name."""
    (folder / "deck.yaml").write_text(WALL, encoding="utf-8")
    (folder / "stone.obj").write_bytes(MESHES["obj"])


def give(kind: str, content: bytes, folder: Path) -> str:
    """Let the program read a file; how it ended: ``accepted`` or ``DeckError``.

    Raises
    ------
    Hang
        if that takes longer than ``LONGEST``
    Exception
        anything else that the program raises: what is in a file is a fault of the deck, whatever it is
    """
    path = folder / f"given.{'yaml' if kind in ('deck', 'sweep') else kind}"
    path.write_bytes(content)
    named = path
    if kind not in ("deck", "sweep"):
        named = folder / "names.yaml"
        named.write_text(NAMED_DECK.format(file=path.name, more=", extrude: 1" if kind == "dxf" else ""))
    try:
        with small_amounts(), limited(LONGEST):
            if kind == "sweep":
                prepare(read_sweep(named), SweepOptions())
            else:
                check(read_deck(named), RunOptions(), False, time.perf_counter())
    except DeckError as error:
        _check_lines(error)
        return type(error).__name__
    return "accepted"


def _check_lines(error: DeckError) -> None:
    """One printable line for each fault, with its place."""
    if not error.faults:
        raise Broken("a deck is refused without a fault")
    for fault in error.faults:
        text = str(fault)
        if not text.isprintable() or len(text) > 2000:
            raise Broken(f"a fault is not one printable line: {text[:3000]!r}")
        if fault.place.line < 1 or fault.place.column < 1:
            raise Broken(f"a fault has no place: {text}")


@contextmanager
def small_amounts() -> Iterator[None]:
    """Let the program refuse small amounts of blocks already, by the limit that is its own."""
    usual = amounts.MOST
    amounts.MOST = FEW_BLOCKS
    try:
        yield
    finally:
        amounts.MOST = usual
