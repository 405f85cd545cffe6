"""Commands of the program, each in a process of its own that begins with everything imported.

Such a process is made by forking one that has done nothing yet, so that time and memory are those of the command alone.
Run as a program, with the number of bytes that a command may reserve; it reads commands from standard input and writes
outcomes to standard output, as JSON lines.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO

MOST_RESERVED = 8 * 1024**3
"""bytes of addresses: enough for what libraries reserve without ever using it"""
MOST_SECONDS = 60
"""of processor time, after which the system ends the process"""
MEGABYTE = 1e6


@dataclass(frozen=True)
class Ended:
    """How a command ended.

    status  : exit status; negative for the signal that ended it
    seconds : of processor time
    memory  : MB, the most that was resident
    """

    status: int
    out: str
    err: str
    seconds: float
    memory: float


class Commands:
    """A process that runs commands."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def run(self, folder: Path, arguments: tuple[str, ...]) -> Ended:
        """Run ``mbla ARGUMENTS`` in a folder."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps({"folder": str(folder), "arguments": arguments}) + "\n")
        self._process.stdin.flush()
        return Ended(**json.loads(self._process.stdout.readline()))


@contextmanager
def commands() -> Iterator[Commands]:
    """Open such a process."""
    with subprocess.Popen(
        [sys.executable, "-m", __name__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        yield Commands(process)
        assert process.stdin is not None
        process.stdin.close()


def main() -> None:
    """Read commands, run them, write how they ended."""
    import_everything()
    for line in sys.stdin:
        asked = json.loads(line)
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            child = os.fork()
            if child == 0:
                _command(asked["folder"], asked["arguments"], out, err)
            _, status, usage = os.wait4(child, 0)
            ended = Ended(
                os.waitstatus_to_exitcode(status),
                _text(out),
                _text(err),
                usage.ru_utime + usage.ru_stime,
                usage.ru_maxrss * 1024 / MEGABYTE,
            )
        sys.stdout.write(json.dumps(asdict(ended)) + "\n")
        sys.stdout.flush()


def import_everything() -> None:
    """What the commands import when they are called."""
    import ezdxf.path
    import meshio
    import pint

    import mbla.cli
    import mbla.cli.check
    import mbla.deck
    import mbla.results.listing.listing
    import mbla.results.listing.summary
    import mbla.results.record.json_record
    import mbla.run
    import mbla.sweeps.command
    import mbla.sweeps.file.read
    from mbla.deck.content import DeckContent
    from mbla.deck.section import built
    from mbla.sweeps.file.content import SweepContent

    built(DeckContent)
    built(SweepContent)
    assert all((ezdxf, meshio, pint, mbla))


def _command(folder: str, arguments: list[str], out: IO[bytes], err: IO[bytes]) -> None:
    """Become the command; does not return."""
    status = 70
    try:
        os.chdir(folder)
        os.dup2(out.fileno(), 1)
        os.dup2(err.fileno(), 2)
        resource.setrlimit(resource.RLIMIT_AS, (MOST_RESERVED, MOST_RESERVED))
        resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))
        sys.stdout = os.fdopen(1, "w", encoding="utf-8")
        sys.stderr = os.fdopen(2, "w", encoding="utf-8")
        from mbla.cli import main as command

        try:
            status = command(arguments)
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else 1
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(status)


def _text(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read(10_000_000).decode("utf-8", "replace")


if __name__ == "__main__":
    main()
