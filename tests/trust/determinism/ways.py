"""Ways of running the same commands, and what they leave: files byte for byte."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tests.decks.folder import DECKS, ROOT

LOCALE = "de_DE"
"""writes a comma where English has a point"""
FOLDERS = ("tutorials", "benchmarks")


@dataclass(frozen=True)
class Way:
    """How commands are run; as it stands the plainest.

    environment : variables beside or in the place of ours
    folder      : below which decks and results are
    threads     : of ``--threads`` and of the libraries
    backwards   : the decks are run in the opposite order
    """

    name: str
    environment: Mapping[str, str] = field(default_factory=dict)
    folder: str = "here"
    umask: int = 0o022
    threads: int = 1
    backwards: bool = False
    still: bool = True


FIRST = Way("first")


def other_ways(locale: Mapping[str, str]) -> tuple[Way, ...]:
    """Each differs from the first in one thing; ``locale`` are the variables of one with a decimal comma."""
    return (
        Way("again"),
        Way("other folder", folder="wo anders/Größe 2"),
        Way("other hash seed", {"PYTHONHASHSEED": "4711"}),
        Way("decimal comma", locale),
        Way("POSIX locale", {"LC_ALL": "POSIX"}),
        Way("other time zone", {"TZ": "Pacific/Kiritimati"}),
        Way("other umask", umask=0o077),
        Way("two threads", threads=2),
        Way("opposite order", backwards=True),
    )


PLAIN = {"PYTHONHASHSEED": "0", "LC_ALL": "C.UTF-8", "TZ": "UTC", "MPLBACKEND": "agg", "PYTHONPATH": str(ROOT)}


def comma_locale(folder: Path) -> dict[str, str] | None:
    """Variables of a locale with a decimal comma, compiled into a folder; None where the machine has no sources."""
    if shutil.which("localedef") is None:
        return None
    name = f"{LOCALE}.UTF-8"
    command = ["localedef", "-i", LOCALE, "-f", "UTF-8", str(folder / name)]
    made = subprocess.run(command, capture_output=True, check=False)
    return {"LC_ALL": name, "LOCPATH": str(folder)} if made.returncode == 0 else None


@dataclass(frozen=True)
class Left:
    """What commands left behind.

    statuses : exit statuses, in the order of the first way
    files    : by path below the folder of results
    modes    : permissions of the files
    """

    statuses: tuple[int, ...]
    files: Mapping[str, bytes]
    modes: frozenset[int]


def ran(way: Way, folder: Path, commands: Sequence[Sequence[str]]) -> Left:
    """Run commands in a process of its own, in a folder that has the decks in it and gets the results.

    commands : arguments, with paths relative to that folder
    """
    place = folder / way.name / way.folder
    place.mkdir(parents=True)
    for name in FOLDERS:
        shutil.copytree(DECKS / name, place / name)
    ordered = [_with_threads(each, way) for each in commands]
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("LC_", "LANG"))}
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), str(way.threads))
    job = {
        "still": way.still,
        "umask": way.umask,
        "commands": ordered[::-1] if way.backwards else ordered,
        "said": "said.txt",
    }
    done = subprocess.run(
        [sys.executable, "-m", "tests.trust.determinism.still"],
        input=json.dumps(job),
        env=environment | PLAIN | threads | dict(way.environment),
        cwd=place,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    statuses = json.loads(done.stdout.splitlines()[-1])
    left = [path for path in sorted((place / "out").rglob("*")) if path.is_file()]
    files = {path.relative_to(place / "out").as_posix(): path.read_bytes() for path in left}
    modes = frozenset(path.stat().st_mode & 0o777 for path in left)
    return Left(tuple(statuses[::-1] if way.backwards else statuses), files, modes)


def _with_threads(arguments: Sequence[str], way: Way) -> list[str]:
    """``mbla run`` is told its threads."""
    return [*arguments, "--threads", str(way.threads)] if arguments[0] == "run" else list(arguments)


def differences(first: Left, other: Left) -> list[str]:
    """Names of files that one of the two lacks, or that differ, and exit statuses that differ."""
    lacking = sorted(set(first.files) ^ set(other.files))
    differ = [name for name in sorted(set(first.files) & set(other.files)) if first.files[name] != other.files[name]]
    statuses = [] if first.statuses == other.statuses else [f"exit statuses {first.statuses}, {other.statuses}"]
    return [*(f"{name} is missing in one" for name in lacking), *(f"{name} differs" for name in differ), *statuses]
