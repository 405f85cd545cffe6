"""What commands say on standard error beside errors of their own: a line, or one that rewrites itself on a terminal."""

from __future__ import annotations

import contextlib
import sys

WIDTH = 78
"""characters of a line that rewrites itself"""


def say(text: str, status: int) -> int:
    """A line on standard error; the exit status, as it came."""
    with contextlib.suppress(OSError):  # nobody listens; the exit status still tells
        print(text, file=sys.stderr, flush=True)
    return status


def rewrite_line(text: str) -> None:
    """Show a text in the place of the one before."""
    print(f"\r{text[:WIDTH]:<{WIDTH}}", end="", file=sys.stderr, flush=True)


def clear_line(shown: object) -> None:
    """What is said next has a line of its own; nothing where nothing was to be shown (None)."""
    if shown is not None:
        print(f"\r{'':<{WIDTH}}\r", end="", file=sys.stderr, flush=True)
