"""What a terminal shows while the command line works: lines that rewrite themselves, and nothing elsewhere."""

from __future__ import annotations

import os
import pty
import struct
import termios
from fcntl import ioctl

import pytest

from mbla.cli.terminal import WIDTH, clear_line, line_width, rewrite_line


@pytest.mark.parametrize(("columns", "width"), [(60, 60), (132, 132), (0, WIDTH)])
def test_a_line_is_never_wider_than_the_terminal(monkeypatch: pytest.MonkeyPatch, columns: int, width: int) -> None:
    """A line that goes on in the next one cannot be rewritten: each text would stay."""
    ours, theirs = pty.openpty()
    ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with os.fdopen(theirs, "w") as stream:
        monkeypatch.setattr("sys.stderr", stream)
        assert line_width() == width
        rewrite_line("x" * 200)
        clear_line(True)
        expected, shown = f"\r{'x' * (width - 1)}\r{'':<{width - 1}}\r", ""
        while len(shown) < len(expected):  # a terminal gives what has come by then
            shown += os.read(ours, 1000).decode()
        os.close(ours)
    assert shown == expected


def test_what_is_no_terminal_has_a_width_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr", None)
    assert line_width() == WIDTH
