"""What commands say on standard error beside errors of their own: a line, or one that rewrites itself on a terminal."""

from __future__ import annotations

import contextlib
import os
import sys

from mbla.errors import printable

WIDTH = 80
"""characters of a line of a terminal that does not say how wide it is"""


def say(text: str, status: int) -> int:
    """Lines on standard error, with nothing in them that a terminal acts on; the exit status, as it came."""
    _write("".join(f"{printable(line)}\n" for line in text.split("\n")))
    return status


def rewrite_line(text: str) -> None:
    """Show a text in the place of the one before; of a long one the beginning, as a second line would stay behind."""
    width = line_width() - 1  # the last place of a line makes some terminals begin another
    _write(f"\r{text[:width]:<{width}}")


def clear_line(shown: object) -> None:
    """What is said next has a line of its own; nothing where nothing was to be shown (None)."""
    if shown is not None:
        _write(f"\r{'':<{line_width() - 1}}\r")


def line_width() -> int:
    """Characters of a line of the terminal that standard error is."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        return os.get_terminal_size(sys.stderr.fileno()).columns or WIDTH
    return WIDTH


def _write(text: str) -> None:
    """Nobody may listen any more: what the program does goes on, and its exit status still tells."""
    with contextlib.suppress(OSError, ValueError):
        print(text, end="", file=sys.stderr, flush=True)
