"""The same deck gives the same files to the last byte, wherever, whenever and under whatever settings of the machine.

Bytes are compared with a clock that stands still: then every file must be the same to the last byte, also the HDF5
files. What differs with a clock that goes is not looked at, nor what a search finds that is told to end by the clock
(``ferris_wall_3_lowest``, ``ferris_wall_5_lowest``).
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest

from tests.decks import folder as decks
from tests.decks.folder import ROOT
from tests.trust.counts import record_counts

CLAIM = (
    "With a clock that stands still a deck gives the same files to the last byte: again, in another folder, with "
    "another hash seed, locale (decimal comma, POSIX), time zone, umask, with two threads, and beside other decks in "
    "one process; a search that is told to end by the clock is none of them"
)
AT_ONCE = 5
"""processes"""
FOLDERS = ("tutorials", "benchmarks")
DECKS = [name for name in decks.BENCHMARKS if not name.endswith("_lowest")]
FEW = ("arch_from_obj",)
PICTURES = ("arch_from_obj", "ferris_wall_3")
TABLES = ("arch_from_dxf", "beam_on_three_supports")
BESIDE = [
    *(
        ["plot", f"out/{deck}/{deck}.h5", "--kind", "mechanism", "-o", f"out/{deck}.{kind}"]
        for deck in PICTURES
        for kind in ("svg", "png")
    ),
    *(["report", f"out/{deck}/{deck}.h5", "-o", f"out/{deck}.html"] for deck in PICTURES),
    *(["export", f"out/{deck}/{deck}.h5", "--csv", "-o", f"out/{deck}_csv"] for deck in TABLES),
]
"""what is asked for beside the runs of all decks"""


def commands(names: Sequence[str]) -> list[list[str]]:
    """Arguments that run decks."""
    paths = {name: decks.BENCHMARKS[name].relative_to(decks.DECKS).as_posix() for name in names}
    return [["run", path, "-o", f"out/{name}", "-q"] for name, path in paths.items()]


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
    name = "de_DE.UTF-8"
    command = ["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / name)]
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
        shutil.copytree(decks.DECKS / name, place / name)
    ordered = [_with_threads(each, way) for each in commands]
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("LC_", "LANG"))}
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), str(way.threads))
    job = {
        "umask": way.umask,
        "commands": ordered[::-1] if way.backwards else ordered,
        "said": "said.txt",
    }
    done = subprocess.run(
        [sys.executable, "-m", "tests.trust.still"],
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


def test_a_difference_is_found() -> None:
    first = Left((0, 5), {"a.h5": b"1", "b.lst": b"2"}, frozenset({0o644}))
    assert differences(first, first) == []
    assert differences(first, replace(first, files={"a.h5": b"1", "b.lst": b"3"})) == ["b.lst differs"]
    assert differences(first, replace(first, files={"a.h5": b"1"})) == ["b.lst is missing in one"]
    assert differences(first, replace(first, statuses=(0, 0))) == ["exit statuses (0, 5), (0, 0)"]


@pytest.mark.long
def test_one_deck_with_everything_changed_at_once(tmp_path: Path) -> None:
    """All ways together: what one of them changes is not put right by another."""
    locale = comma_locale(tmp_path) or {"LC_ALL": "POSIX"}
    environment = {"PYTHONHASHSEED": "4711", "TZ": "Pacific/Kiritimati", **locale}
    changed = Way("changed", environment, "wo anders/Größe 2", umask=0o077, threads=2)
    asked = commands(FEW)
    first, other = ran(FIRST, tmp_path, asked), ran(changed, tmp_path, asked)
    assert first.statuses == (0,)
    assert {Path(name).suffix for name in first.files} == {".h5", ".lst", ".sta", ".json", ".vtu", ".pvd", ".py"}
    assert differences(first, other) == []
    assert (first.modes, other.modes) == (frozenset({0o644}), frozenset({0o600}))


@pytest.mark.trust
def test_all_decks_in_every_way(tmp_path: Path) -> None:
    locale = comma_locale(tmp_path)
    assert locale is not None, "no locale with a decimal comma: localedef and its sources are missing"
    ways, asked = (FIRST, *other_ways(locale)), [*commands(DECKS), *BESIDE]
    with ThreadPoolExecutor(AT_ONCE) as at_once:
        first, *others = at_once.map(
            lambda way: ran(way, tmp_path, asked[: len(DECKS)] if way.backwards else asked), ways
        )
    assert set(first.statuses) <= {0, 4, 5}
    compared = 0
    found: list[str] = []
    for way, other in zip(ways[1:], others, strict=True):
        expected = _of_decks_alone(first) if way.backwards else first
        found += [f"{way.name}: {difference}" for difference in differences(expected, other)]
        compared += len(expected.files)
    assert found == []
    counts = {"decks": len(DECKS), "ways": len(others), "files compared": compared, "files that differ": len(found)}
    record_counts("determinism", 80, CLAIM, counts)


def _of_decks_alone(left: Left) -> Left:
    """Without pictures, tables and reports, which need results of decks that are run before."""
    files = {name: data for name, data in left.files.items() if name.split("/")[0] in DECKS}
    return replace(left, statuses=left.statuses[: len(DECKS)], files=files)
