"""Every call of a command on a file fails once: it says so in one line, and what was there before still is."""

from __future__ import annotations

import errno
import json
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.scene import Scene, content, is_one_plain_line, restored, visible, written
from tests.trust.processes import CALLS, Commands, Fault

OF_RUN = (
    "Whichever call of `mbla run` on a file fails, with whatever error and for once or for good: exit status 6 and one "
    "line that names a file, the earlier result byte for byte as it was, nothing temporary left after the next run"
)
OF_OTHERS = (
    "Whichever call on a file fails under `mbla check --vtu`, `plot`, `report`, `export`, `new` and the tables of "
    "`sweep`: exit status 6 and one line that names a file, every file as it was or whole, nothing temporary left "
    "after the next one"
)
ERRORS = ("ENOSPC", "EIO", "EACCES")
SWEEP = """\
mbla_sweep: 1
deck: block.yaml
parameters: {mu: {values: [0.2, 0.3]}}
"""


@dataclass(frozen=True)
class Writing:
    """A command that writes into ``out``.

    together : its files appear all at once or not at all
    kept     : files in ``out`` that it goes on with, and rewrites as they are
    """

    arguments: tuple[str, ...]
    together: bool = True
    kept: tuple[str, ...] = ()


COMMANDS = {
    "run": Writing(("run", "block.yaml", "-q", "--force", "-o", "out")),
    "check": Writing(("check", "block.yaml", "--vtu", "--force", "-o", "out")),
    "export": Writing(("export", "block.h5", "--csv", "--parquet", "--force", "-o", "out")),
    "plot-png": Writing(("plot", "block.h5", "--kind", "mechanism", "--size", "300x200", "-o", "out/a.png")),
    "plot-svg": Writing(("plot", "block.h5", "--size", "300x200", "--format", "svg", "-o", "out"), together=False),
    "plot-pdf": Writing(("plot", "block.h5", "--kind", "forces", "--size", "300x200", "-o", "out/a.pdf")),
    "plot-gif": Writing(("plot", "block.h5", "--animate", "gif", "--size", "300x200", "-o", "out/a.gif")),
    "report": Writing(("report", "block.h5", "--no-3d", "-o", "out/a.html")),
    "new": Writing(("new", "out/a.yaml", "--force")),
    "sweep": Writing(("sweep", "sweep.yaml", "--resume", "-q", "-o", "out"), kept=("journal.csv",)),
}


class Written:
    """A folder with a deck, a result and a sweep file, and a command that has written into ``out`` before."""

    def __init__(self, commands: Commands, folder: Path, writing: Writing) -> None:
        self.commands, self.folder, self.writing = commands, folder, writing
        written(folder / "block.yaml")
        written(folder / "sweep.yaml", SWEEP)
        assert commands.run("run", "block.yaml", "-q", "-o", ".", folder=folder).status == 0
        self.out = folder / "out"
        self.out.mkdir()
        ended = commands.run(*self.arguments)
        assert ended.status == 0, ended
        self.new = content(self.out)
        self.earlier = {name: data if name in writing.kept else b"earlier" for name, data in self.new.items()}

    @property
    def arguments(self) -> list[str]:
        """Of the command, paths in full."""
        paths = ("out", "block.yaml", "block.h5", "sweep.yaml")
        return [str(self.folder / each) if each.startswith(paths) else each for each in self.writing.arguments]

    def calls(self) -> dict[str, int]:
        """Of the command in which nothing fails."""
        restored(self.out, self.earlier)
        ended = self.commands.run(*self.arguments, fault=Fault(str(self.out)))
        assert ended.status == 0, ended
        return dict(ended.counts)

    def fails(self, call: str, number: int, error: str, stays: bool = False) -> bool:
        """The command with a call that fails; whether the call came."""
        restored(self.out, self.earlier)
        fault = Fault(str(self.out), call, number, getattr(errno, error), stays)
        ended = self.commands.run(*self.arguments, fault=fault)
        now = visible(self.out)
        told = (self.arguments[0], call, number, error, stays, ended.status, ended.err, sorted(content(self.out)))
        if not ended.counts["came"]:
            return False
        if ended.status == 0:  # the folder is there, or what is cleared away at the end stays for the next one
            assert call in ("unlink", "mkdir"), told
        else:
            assert ended.status == 6, told
            assert is_one_plain_line(ended.err.splitlines(keepends=True)[-1]), told
            assert "Traceback" not in ended.err, told
            assert str(self.folder) in ended.err, told
            if not stays:
                assert sorted(now) == sorted(self.earlier), told
                changed = [name for name in now if now[name] != self.earlier[name]]
                assert not (changed and self.writing.together), told
                assert [len(now[name]) for name in changed] == [len(self.new[name]) for name in changed], told
        assert self.commands.run(*self.arguments).status == 0, told
        assert sorted(content(self.out)) == sorted(self.new), told
        return True

    def every_call_fails(self, *, for_good: bool) -> int:
        """How many calls failed, once or also from there on."""
        done = 0
        for call, count in self.calls().items():
            for number in range(1, count + 1 if call in CALLS else 1):
                for turn, stays in enumerate((False, True) if for_good else (False,)):
                    done += self.fails(call, number, ERRORS[(number + turn) % len(ERRORS)], stays)
        return done


def where_there_was_nothing(scene: Scene, call: str, number: int) -> None:
    """A run without an earlier result; the next one needs no --force, but where only clearing away has failed."""
    restored(scene.out, {})
    scene.out.rmdir()
    ended = scene.run(fault=scene.fault(call, number, error=errno.ENOSPC, stays=True))
    told = (call, number, ended, sorted(content(scene.out)))
    assert ended.status == 6 or (call == "unlink" and ended.status == 0), told
    assert "Traceback" not in ended.err, told
    assert scene.run(*(() if ended.status else ("--force",))).status == 0, told
    record = json.loads((scene.out / "block.json").read_text(encoding="utf-8"))
    assert sorted(content(scene.out)) == sorted({*record["files"]}), told


@pytest.mark.long
@pytest.mark.parametrize(("name", "call", "number"), [("run", "rename", 3), ("check", "write", 2), ("new", "sync", 1)])
def test_a_call_that_fails(faulty: Commands, tmp_path: Path, name: str, call: str, number: int) -> None:
    assert Written(faulty, tmp_path, COMMANDS[name]).fails(call, number, "ENOSPC")


@pytest.mark.long
def test_a_call_that_fails_where_there_was_nothing(faulty: Commands, scene: Scene) -> None:
    where_there_was_nothing(scene, "write", 2)


@pytest.mark.trust
def test_every_call_of_a_run_fails(faulty: Commands, scene: Scene, tmp_path: Path) -> None:
    done = Written(faulty, tmp_path, COMMANDS["run"]).every_call_fails(for_good=True)
    restored(scene.out, {})
    calls = scene.run("--force", fault=scene.fault("write", 0)).counts
    fresh = [(call, number) for call in CALLS for number in range(1, calls[call] + 1)]
    for call, number in fresh:
        where_there_was_nothing(scene, call, number)
    counts = {"failed calls over an earlier result": done, "failed calls where there was nothing": len(fresh)}
    record_counts("faults-calls", 50, OF_RUN, counts)


@pytest.mark.trust
def test_every_call_of_other_commands_fails_once(faulty: Commands, tmp_path: Path) -> None:
    others = {name: writing for name, writing in COMMANDS.items() if name != "run"}
    done = {
        name: Written(faulty, tmp_path / name, each).every_call_fails(for_good=False) for name, each in others.items()
    }
    assert all(done.values())
    record_counts("faults-commands", 55, OF_OTHERS, {f"failed calls of {name}": count for name, count in done.items()})
