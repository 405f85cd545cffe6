"""Decks that are hostile as files: what is no regular file, what leads out of its folder, what includes itself."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable
from pathlib import Path

from tests.line import BLOCK
from tests.trust.hostile.case import NOT_READ, Case, Write, deck
from tests.trust.hostile.samples import MESHES, NAMED_DECK


def including(names: str) -> str:
    """A deck that includes files, given as a list of YAML without its brackets."""
    return f"{BLOCK}include: [{names}]\n"


def _made(make: Callable[[Path], object], deck_text: str = "") -> Write:
    """Something that is made beside a deck, or in its place."""

    def write(folder: Path) -> None:
        make(folder)
        if deck_text:
            (folder / "deck.yaml").write_text(deck_text, encoding="utf-8")

    return write


def _link(name: str, target: str) -> Callable[[Path], None]:
    return lambda folder: (folder / name).symlink_to(target)


def _outside(name: str) -> Callable[[Path], None]:
    """A link to a file outside the folder that exists."""

    def make(folder: Path) -> None:
        (folder.parent / "secret.yaml").write_text(BLOCK, encoding="utf-8")
        (folder.parent / "secret.obj").write_bytes(MESHES["obj"])
        (folder / name).symlink_to(f"../secret{Path(name).suffix}")

    return make


def _folder_outside(folder: Path) -> None:
    (folder.parent / "secret.yaml").write_text(BLOCK, encoding="utf-8")
    (folder / "below").symlink_to("..")


def _loop(folder: Path) -> None:
    (folder / "deck.yaml").symlink_to("other.yaml")
    (folder / "other.yaml").symlink_to("deck.yaml")


def _fifo(name: str) -> Callable[[Path], None]:
    return lambda folder: os.mkfifo(folder / name)


def _socket(folder: Path) -> None:
    here = Path.cwd()
    os.chdir(folder)  # addresses of sockets are short
    try:
        with socket.socket(socket.AF_UNIX) as end:
            end.bind("deck.yaml")
    finally:
        os.chdir(here)


def _chain(folder: Path) -> None:
    """1,000 files, each of which includes the next."""
    for number in range(1000):
        (folder / f"f{number}.yaml").write_text(f"mbla: 1\ninclude: [f{number + 1}.yaml]\n", encoding="utf-8")


def _links_in_a_row(folder: Path) -> None:
    for number in range(100):
        (folder / f"l{number}.yaml").symlink_to(f"l{number + 1}.yaml")


def _mesh(name: str) -> str:
    return NAMED_DECK.format(file=name, more="")


FILES = [
    Case("a folder", _made(lambda folder: (folder / "deck.yaml").mkdir()), status=NOT_READ),
    Case("a pipe", _made(_fifo("deck.yaml")), status=NOT_READ),
    Case("a socket", _made(_socket), status=NOT_READ),
    Case("no file", _made(lambda folder: None), status=NOT_READ),
    Case("/dev/zero", _made(lambda folder: None), ("run", "/dev/zero"), NOT_READ),
    Case("standard input", _made(lambda folder: None), ("run", "/dev/stdin"), NOT_READ),
    Case("/proc/self/environ", _made(lambda folder: None), ("run", "/proc/self/environ")),
    Case("a link to /dev/zero", _made(_link("deck.yaml", "/dev/zero")), status=NOT_READ),
    Case("links in a circle", _made(_loop), status=NOT_READ),
    Case("a name of 10 kB", _made(lambda folder: None), ("run", "x" * 10_000), NOT_READ),
    Case("a name with escape sequences", _made(lambda folder: None), ("run", "\x1b[2J.yaml"), NOT_READ),
]

FOREIGN = {
    "at the root": "/etc/passwd",
    "up": "../secret.yaml",
    "far up": "../" * 200 + "etc/passwd",
    "as an address": "https://example.org/deck.yaml",
    "with backslashes": "..\\\\..\\\\secret.yaml",
    "with a NUL": "a\\0.yaml",
    "of 10 kB": "x" * 10_000 + ".yaml",
    "with escape sequences": "\\e[2J.yaml",
}

INCLUSIONS = [
    *(deck(f"including a name {name}", including(f'"{text}"')) for name, text in FOREIGN.items()),
    deck("including itself", including("deck.yaml")),
    deck("including in a circle", including("a.yaml"), a__yaml="include: [b.yaml]\n", b__yaml="include: [a.yaml]\n"),
    Case("including 1,000 files in a row", _made(_chain, including("f0.yaml"))),
    deck("including 100,000 names", including(", ".join(f"x{n}.yaml" for n in range(100_000)))),
    Case("including a pipe", _made(_fifo("a.yaml"), including("a.yaml"))),
    Case("including a link to outside", _made(_outside("a.yaml"), including("a.yaml"))),
    Case("including by a linked folder", _made(_folder_outside, including("below/secret.yaml"))),
    Case("including a link to /dev/zero", _made(_link("a.yaml", "/dev/zero"), including("a.yaml"))),
    Case("including 100 links in a row", _made(_links_in_a_row, including("l0.yaml"))),
]

SIDE_FILES = [
    *(deck(f"a mesh with a name {name}", _mesh(f'"{text.replace("yaml", "obj")}"')) for name, text in FOREIGN.items()),
    Case("a mesh that is a pipe", _made(_fifo("a.obj"), _mesh("a.obj"))),
    Case("a mesh linked to outside", _made(_outside("a.obj"), _mesh("a.obj"))),
    Case("a mesh linked to /dev/zero", _made(_link("a.obj", "/dev/zero"), _mesh("a.obj"))),
    deck("a mesh that is the deck", _mesh("deck.yaml")),
    Case(
        "a table that is a pipe",
        _made(_fifo("a.csv"), BLOCK.replace("joint: dry}", "joint: dry, table: a.csv}")),
    ),
    deck("frames without end", BLOCK + "output: {frames: 1000000000000}\n"),
]

CASES = [*FILES, *INCLUSIONS, *SIDE_FILES]
"""All of them."""
