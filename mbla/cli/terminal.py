"""What commands say on standard error: what went wrong, a line, or one that rewrites itself on a terminal.

What is printed always arrives, or fails quietly.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path

from mbla.errors import DeckError, MblaError, printable
from mbla.results.failures import failure_record, lines_of, words_of

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
    """There may be no reader any more: the program continues, and its exit status still says how it ended."""
    with contextlib.suppress(OSError, ValueError):
        print(text, end="", file=sys.stderr, flush=True)


def failed(error: BaseException, about: Mapping[str, Path], as_json: bool) -> int:
    """Say what went wrong in one line per fault, and as a JSON object where that is wanted; the exit status."""
    status, _ = words_of(error)
    text = "\n".join(lines_of(error))
    if status == MblaError.exit_status and os.environ.get("MBLA_TRACEBACK"):
        traceback.print_exception(error)
    if as_json:
        print(json.dumps(failure_record(error, about)), flush=True)
    return say(text if isinstance(error, DeckError) else f"mbla: {text}", status)


def prepare_streams(*, json_lines: bool) -> None:
    """No name or title may fail to be printed; JSON is UTF-8 whatever the terminal speaks."""
    if sys.stdout is None:  # closed by the parent process, as services do: there is no reader
        drop_output()
    if sys.stderr is None:
        sys.stderr = Path(os.devnull).open("w")  # noqa: SIM115 - as standard output
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            utf8 = json_lines and stream is sys.stdout
            stream.reconfigure(encoding="utf-8" if utf8 else None, errors="backslashreplace")


def drop_output() -> None:
    """Standard output cannot be written: keep the interpreter from trying again at its end."""
    sys.stdout = Path(os.devnull).open("w")  # noqa: SIM115 - for the interpreter's own flush at exit
