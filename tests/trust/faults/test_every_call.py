"""Every call of ``mbla run`` on a file fails once: it says so in one line, and what was there before still is."""

from __future__ import annotations

import errno
import json
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.commands import ERRORS, Commands, Fault, content, is_one_plain_line, restored, written
from tests.trust.faults.shim import CALLS

CLAIM = (
    "Whichever call of `mbla run` on a file fails, with whatever error and for once or for good: exit status 6 and one "
    "line that names a file, the earlier result byte for byte as it was, nothing temporary left after the next run"
)


class Scene:
    """A deck, and the folder of its result; an earlier result is of other figures."""

    def __init__(self, commands: Commands, folder: Path) -> None:
        self.commands = commands
        self.deck = written(folder / "block.yaml")
        self.out = folder / "block.out"
        assert commands.run("run", self.deck, "--set", "parameters.mu=0.3", "-q").status == 0
        self.earlier = content(self.out)

    def counts(self, *more: str) -> dict[str, int]:
        """Calls of a run in which nothing fails."""
        ended = self.commands.run("run", self.deck, "-q", *more, fault=Fault(self.out.parent))
        assert ended.status == 0, ended.said
        return dict(ended.counts)

    def over_an_earlier_result(self, call: str, number: int, error: str, stays: bool) -> bool:
        """A run in which the call fails; whether the call came."""
        restored(self.out, self.earlier)
        fault = Fault(self.out.parent, call, number, getattr(errno, error), stays)
        ended = self.commands.run("run", self.deck, "-q", "--force", fault=fault)
        told = (call, number, error, stays, ended.said, sorted(content(self.out)))
        if not ended.counts["came"]:
            assert ended.status == 0, told
            return False
        if ended.status == 0:  # what is cleared away when the result is complete may stay for the next run
            assert call in ("unlink", "mkdir"), told  # the folder is there
            assert ended.said == "", told
            earlier = {name for name in content(self.out) if not name.startswith(".")}
            assert "block.h5" in earlier, told
        else:
            assert ended.status == 6, told
            assert is_one_plain_line(ended.said), told
            assert str(self.out.parent) in ended.said, told
            if not stays:
                assert {name: data for name, data in content(self.out).items() if name[0] != "."} == self.earlier, told
        before = {name: data for name, data in content(self.out).items() if name[0] != "."}
        refused = self.commands.run("run", self.deck, "-q")
        assert refused.status == 6, told
        assert "--force" in refused.said, told
        assert content(self.out) == (before if ended.status == 0 else self.earlier), told
        return True

    def where_there_was_nothing(self, call: str, number: int, error: str) -> None:
        """A run without an earlier result; the next one needs no --force, but where only clearing away has failed."""
        restored(self.out, {})
        self.out.rmdir()
        fault = Fault(self.out.parent, call, number, getattr(errno, error), stays=True)
        ended = self.commands.run("run", self.deck, "-q", fault=fault)
        told = (call, number, error, ended.said, sorted(content(self.out)))
        assert ended.status == (0 if call == "unlink" and ended.status == 0 else 6), told
        assert "Traceback" not in ended.said, told
        again = self.commands.run("run", self.deck, "-q", *(() if ended.status else ("--force",)))
        assert again.status == 0, told
        record = json.loads((self.out / "block.json").read_text(encoding="utf-8"))
        assert sorted(content(self.out)) == sorted({*record["files"]}), told


@pytest.fixture(scope="module")
def scene(faulty: Commands, tmp_path_factory: pytest.TempPathFactory) -> Scene:
    return Scene(faulty, tmp_path_factory.mktemp("scene"))


@pytest.mark.parametrize("call", CALLS)
def test_calls_that_fail(scene: Scene, call: str) -> None:
    restored(scene.out, scene.earlier)
    number = max(1, scene.counts("--force")[call] // 2)
    if call == "mkdir":
        scene.where_there_was_nothing(call, 1, "EACCES")
    else:
        assert scene.over_an_earlier_result(call, number, "ENOSPC", stays=False)


@pytest.mark.trust
def test_every_call_fails_once(scene: Scene) -> None:
    restored(scene.out, scene.earlier)
    calls = scene.counts("--force")
    done = fresh = 0
    for call in CALLS:
        for number in range(1, calls[call] + 1):
            for turn, stays in enumerate((False, True)):
                error = ERRORS[(number + turn) % len(ERRORS)]
                done += scene.over_an_earlier_result(call, number, error, stays)
    restored(scene.out, {})
    scene.out.rmdir()
    calls = scene.counts()
    for call in CALLS:
        for number in range(1, calls[call] + 1):
            scene.where_there_was_nothing(call, number, "ENOSPC")
            fresh += 1
    record_counts(
        "faults-calls",
        50,
        CLAIM,
        {"failed calls over an earlier result": done, "failed calls where there was nothing": fresh},
    )
