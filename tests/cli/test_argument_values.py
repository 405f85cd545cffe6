"""Values of options as they are written, and the words with which others are refused."""

from __future__ import annotations

import argparse
import os
import pty
import struct
import termios
from collections.abc import Callable
from fcntl import ioctl

import pytest

from mbla.cli import options as values
from mbla.cli.options import shard
from mbla.cli.terminal import WIDTH, clear_line, line_width, rewrite_line


@pytest.mark.parametrize(
    ("value", "text", "expected"),
    [
        (values.names, "a, b", ["a", "b"]),
        (values.seconds, "0.5", 0.5),
        (values.relative, "0", 0.0),
        (values.relative_above_zero, "1e-3", 1e-3),
        (values.target, "load_factor=1.5", ("load_factor", 1.5)),
        (values.target, "stands", ("stands", 0.0)),
        (values.target, "falls", ("falls", 0.0)),
        (values.target, "peak=0.05", ("peak", 0.05)),
    ],
)
def test_taken(value: Callable[[str], object], text: str, expected: object) -> None:
    assert value(text) == expected


@pytest.mark.parametrize(
    ("value", "text", "words"),
    [
        (values.names, "a,,b", "'a,,b' is not a list of names with commas between them"),
        (values.names, "", "'' is not a list of names with commas between them"),
        (values.target, "load_factor", "is not load_factor=VALUE"),
        (values.target, "load_factor=nan", "is not load_factor=VALUE"),
        (values.target, "angle=1", "is not load_factor=VALUE"),
        (values.seconds, "0", "a positive number of seconds"),
        (values.seconds, "inf", "a positive number of seconds"),
        (values.relative, "-1e-9", "a relative difference, 0 or more"),
        (values.relative, "nan", "a relative difference, 0 or more"),
        (values.relative_above_zero, "0", "a relative error between 0 and 1"),
        (values.relative_above_zero, "1", "a relative error between 0 and 1"),
        (values.relative_above_zero, "small", "a relative error between 0 and 1"),
    ],
)
def test_refused(value: Callable[[str], object], text: str, words: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError) as caught:
        value(text)
    assert words in str(caught.value)
    assert repr(text) in str(caught.value)


def test_part_and_parts() -> None:
    assert [shard(text) for text in ("1/1", "2/8", "08/8")] == [(1, 1), (2, 8), (8, 8)]


@pytest.mark.parametrize(
    "text", ["", "2", "0/8", "9/8", "1/0", "-1/8", "1/8/2", " 1/8", "1/8\n", "1_0/20", "1.0/2", "²/8"]
)
def test_what_is_none_is_refused(text: str) -> None:
    with pytest.raises(argparse.ArgumentTypeError, match="is not a shard, such as 2/8"):
        shard(text)


# What a terminal shows while the command line works: lines that rewrite themselves, and nothing elsewhere.


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
