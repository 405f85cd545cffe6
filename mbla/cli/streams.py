"""Standard output and standard error: what is printed always arrives, or fails quietly."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path


def prepare_streams(*, json_lines: bool) -> None:
    """No name or title may fail to be printed; JSON is UTF-8 whatever the terminal speaks."""
    if sys.stdout is None:  # closed by who started us, as services do: nobody wants to read
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
