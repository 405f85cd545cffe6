"""Every call on a file fails once under the commands beside ``mbla run`` that write: each file is the earlier one or
whole."""

from __future__ import annotations

import errno
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.commands import ERRORS, Commands, Fault, content, is_one_plain_line, restored, written
from tests.trust.faults.shim import CALLS

CLAIM = (
    "Whichever call on a file fails under `mbla check --vtu`, `plot`, `report`, `export`, `new` and the tables of "
    "`sweep`: exit status 6 and one line that names a file, every file as it was or whole, nothing temporary left "
    "after the next one"
)
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


class Scene:
    """A folder with a deck, a result and a sweep file, and a command that has written into ``out`` before."""

    def __init__(self, commands: Commands, folder: Path, writing: Writing) -> None:
        self.commands, self.folder, self.writing = commands, folder, writing
        deck = written(folder / "block.yaml")
        written(folder / "sweep.yaml", SWEEP)
        assert commands.run("run", deck, "-q", "-o", folder).status == 0
        self.out = folder / "out"
        self.out.mkdir()
        self.arguments = [self._placed(argument) for argument in writing.arguments]
        ended = commands.run(*self.arguments)
        assert ended.status == 0, ended.said
        self.new = content(self.out)
        self.earlier = {name: data if name in writing.kept else b"earlier" for name, data in self.new.items()}

    def _placed(self, argument: str) -> str:
        is_path = argument.startswith("out") or argument in ("block.yaml", "block.h5", "sweep.yaml")
        return str(self.folder / argument) if is_path else argument

    def counts(self) -> dict[str, int]:
        """Calls of the command in which nothing fails."""
        restored(self.out, self.earlier)
        ended = self.commands.run(*self.arguments, fault=Fault(self.out))
        assert ended.status == 0, ended.said
        return dict(ended.counts)

    def fails(self, call: str, number: int, error: str) -> bool:
        """The command with a call that fails; whether the call came."""
        restored(self.out, self.earlier)
        ended = self.commands.run(*self.arguments, fault=Fault(self.out, call, number, getattr(errno, error)))
        now = {name: data for name, data in content(self.out).items() if not name.startswith(".")}
        told = (self.arguments[0], call, number, error, ended.status, ended.said, sorted(content(self.out)))
        if not ended.counts["came"]:
            return False
        if ended.status == 0:
            assert call in ("unlink", "mkdir"), told  # the folder is there
        else:
            assert ended.status == 6, told
            assert is_one_plain_line(ended.said.splitlines(keepends=True)[-1]), told
            assert "Traceback" not in ended.said, told
            assert str(self.folder) in ended.said, told
            assert sorted(now) == sorted(self.earlier), told
            changed = [name for name in now if now[name] != self.earlier[name]]
            assert not (changed and self.writing.together), told
            for name in changed:
                assert len(now[name]) == len(self.new[name]), told
        assert self.commands.run(*self.arguments).status == 0, told
        assert sorted(content(self.out)) == sorted(self.new), told
        return True


@pytest.mark.parametrize("name", ["check", "new", "plot-pdf"])
def test_a_write_that_fails(faulty: Commands, tmp_path: Path, name: str) -> None:
    assert Scene(faulty, tmp_path, COMMANDS[name]).fails("write", 2 if name == "check" else 1, "ENOSPC")


@pytest.mark.trust
def test_every_call_of_other_commands_fails_once(faulty: Commands, tmp_path: Path) -> None:
    done = dict.fromkeys(COMMANDS, 0)
    for name, writing in COMMANDS.items():
        scene = Scene(faulty, tmp_path / name, writing)
        calls = scene.counts()
        for call in CALLS:
            for number in range(1, calls[call] + 1):
                done[name] += scene.fails(call, number, ERRORS[number % len(ERRORS)])
    assert all(done.values())
    record_counts("faults-commands", 55, CLAIM, {f"failed calls of {name}": count for name, count in done.items()})
