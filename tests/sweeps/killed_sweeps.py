"""Sweeps in processes that are killed: begun, watched, ended at random moments, and what they left compared."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

from mbla.cli import main
from mbla.sweeps.command import Prepared, SweepOptions, prepare, run_sweep
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.file.read import read_sweep
from mbla.sweeps.journal import journals_in
from tests.line import BLOCK
from tests.sweeps.journal.forked import Forked, forked

HOW_IT_WENT = b",tries,seconds [s]"
"""the last columns, which say how a point was solved, not what its answer is"""
GONE = 30.0
"""seconds in which processes must have ended whose parent was killed, or be there; it takes hundredths, or one"""


def written(folder: Path, points: int) -> Path:
    """A sweep file of a block that slides or overturns, and for one thickness cannot stand: done and failed points."""
    (folder / "block.yaml").write_text(BLOCK, encoding="utf-8")
    path = folder / "block_sweep.yaml"
    path.write_text(
        f"""\
mbla_sweep: 1
deck: block.yaml
parameters:
  mu: {{linear: {{from: 0.1, to: 0.9, points: {points // 2}}}}}
  c: {{values: [0, -1]}}
""",
        encoding="utf-8",
    )
    return path


@dataclass(frozen=True)
class Scene:
    """A sweep, where its files go, and how it is run."""

    path: Path
    prepared: Prepared
    options: SweepOptions

    @property
    def folder(self) -> Path:
        """Of its files."""
        return Path(self.prepared.plan.folder)

    @property
    def n_points(self) -> int:
        """That are solved."""
        return len(self.prepared.tasks)

    def goes_on(self) -> Callable[[Callable[[str], None]], None]:
        """A client that goes on with the journal and reports the key of each point, then ``finished``."""

        def work(report: Callable[[str], None]) -> None:
            options = replace(self.options, resume=True)
            told = run_sweep(self.prepared, options, lambda _, task, __: report("begun" if task is None else task.key))
            report(f"finished {told.exit_code}")

        return work


def scene(path: Path, folder: Path, engine: EngineOptions | None = None) -> Scene:
    """The sweep file's sweep with its files in the folder."""
    options = SweepOptions(folder=folder, engine=engine or EngineOptions())
    return Scene(path, prepare(read_sweep(path, ()), options), options)


def table_of(folder: Path) -> list[bytes]:
    """Lines of sweep.csv byte for byte, but for the last two columns: how often a point was begun, and its time."""
    header, *rows = (folder / "sweep.csv").read_bytes().splitlines()
    assert header.endswith(HOW_IT_WENT)
    return [line.rsplit(b",", 2)[0] for line in (header, *rows)]


def keys_in_journals(folder: Path) -> list[str]:
    """Key of each row."""
    lines = [line for path in journals_in(folder) for line in path.read_text(encoding="utf-8").splitlines()[2:]]
    return [line.split(",")[0].strip('"') for line in lines]


def descendants(pid: int) -> list[int]:
    """Processes that a process has begun, and those that they have."""
    found: list[int] = []
    with suppress(OSError):  # it has ended meanwhile
        for task in Path(f"/proc/{pid}/task").iterdir():
            for child in (task / "children").read_text(encoding="ascii").split():
                found += [int(child), *descendants(int(child))]
    return found


@contextmanager
def all_ending(pid: int) -> Iterator[None]:
    """What a process has begun when the block is entered ends by itself soon after the block, which ends it."""
    begun = descendants(pid)
    yield
    until = time.monotonic() + GONE
    while any(runs(each) for each in begun):
        assert time.monotonic() < until, "processes of a client that was killed go on"
        time.sleep(0.01)


def runs(pid: int) -> bool:
    """Whether a process runs; one that is dead and only waits to be asked for its status does not."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0] not in "ZX"
    return False


def kill_a_child(client: Forked, draw: Random) -> bool:
    """Kill one of the processes that a client has begun; whether there was one."""
    children = descendants(client.pid)
    if not children:
        return False
    with suppress(ProcessLookupError):
        os.kill(draw.choice(children), signal.SIGKILL)
    return True


def with_kills(scene: Scene, kills: int, draw: Random, wait: float, at_client: float) -> tuple[int, set[str]]:
    """Go on with a sweep until so many kills are done or it is finished; real kills, and points that were reported.

    wait      : longest time from a report to the kill [s]; most are short, as most of the time goes into points
    at_client : share of the kills that hit the client; the others one of its processes
    """
    reported: list[str] = []
    done = 0
    while done < kills and len(set(reported)) < scene.n_points:
        with forked(scene.goes_on()) as client:
            assert client.line() == "begun"
            while done < kills and len(set(reported)) < scene.n_points:
                time.sleep(draw.random() ** 3 * wait)
                if draw.random() < at_client:
                    with all_ending(client.pid):
                        client.kill()
                        reported += client.lines()
                    done += 1
                    break
                done += kill_a_child(client, draw)
                reported += [client.line() for _ in range(2)]  # its second try, and one more, go undisturbed
    return done, {line for line in reported if len(line) > 20}


def finish(scene: Scene) -> str:
    """Go on to the end as the command does, in one process; its exit status."""
    command = ["sweep", str(scene.path), "-o", str(scene.folder), "--resume", "-q"]
    with forked(lambda report: report(f"exit {main(command)}")) as client:
        return client.lines()[-1]
