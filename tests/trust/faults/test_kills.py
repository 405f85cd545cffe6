"""``mbla run`` killed outright at random moments: no torn file, and the next run puts right what it left."""

from __future__ import annotations

import json
import random
import signal
import time
from collections.abc import Mapping
from pathlib import Path

import pytest

from mbla.results.hdf5.result_file import read_results_hdf5
from tests.trust.counts import record_counts
from tests.trust.faults.commands import Commands, Fault, content, restored, written

CLAIM = (
    "`mbla run` killed (SIGKILL) at random moments over an earlier result: the next command finds the earlier result "
    "byte for byte, or the new one whole, and clears the rest away"
)
KILLS = 500


class Killed:
    """A deck, its earlier result, and what kills did to it."""

    def __init__(self, commands: Commands, folder: Path) -> None:
        self.commands = commands
        self.deck = written(folder / "block.yaml")
        self.out = folder / "block.out"
        assert commands.run("run", self.deck, "--set", "parameters.mu=0.3", "-q").status == 0
        self.earlier = content(self.out)
        begun = time.monotonic()
        assert commands.run("run", self.deck, "-q", "--force").status == 0
        self.lasts = time.monotonic() - begun
        self.whole = 0
        self.half_done = 0

    def check(self, told: object) -> None:
        """What a killed run left is put right by the next one, which is refused as there is a result."""
        left = content(self.out)
        self.half_done += any(name.startswith(".") for name in left)
        refused = self.commands.run("run", self.deck, "-q")
        assert refused.status == 6, (told, refused.said)
        now = content(self.out)
        if now == self.earlier:
            return
        self.whole += 1
        self.is_whole(now, told)

    def is_whole(self, now: Mapping[str, bytes], told: object) -> None:
        """The new result, complete: all of its files and no others, each of the same run."""
        assert sorted(now) == sorted(json.loads(now["block.json"])["files"]), told
        results = read_results_hdf5(self.out / "block.h5")
        (case,) = results.cases
        assert case.solution.mechanics is not None
        assert case.solution.mechanics.load_factor == pytest.approx(0.5, abs=1e-6), told
        assert json.loads(now["block.json"])["cases"][0]["load_factor"] == case.solution.mechanics.load_factor, told
        assert all(now[name] != self.earlier[name] for name in ("block.sta", "block.lst", "block.h5")), told

    def at(self, moment: float) -> bool:
        """A kill so long after the run began [s]; whether it was still at work."""
        restored(self.out, self.earlier)
        run = self.commands.begin("run", self.deck, "-q", "--force")
        time.sleep(moment)
        run.send(signal.SIGKILL)
        killed = run.end().status == -signal.SIGKILL
        self.check(moment)
        return killed

    def at_call(self, call: str, number: int) -> bool:
        """A kill right before a call on a file; whether it came."""
        restored(self.out, self.earlier)
        fault = Fault(self.out.parent, call, number, signal=signal.SIGKILL)
        ended = self.commands.run("run", self.deck, "-q", "--force", fault=fault)
        assert ended.status == (-signal.SIGKILL if ended.counts["came"] else 0)
        self.check((call, number))
        return bool(ended.counts["came"])


@pytest.fixture(scope="module")
def killed(commands: Commands, tmp_path_factory: pytest.TempPathFactory) -> Killed:
    return Killed(commands, tmp_path_factory.mktemp("killed"))


def test_a_run_killed_at_some_moments(killed: Killed) -> None:
    for part in (0.2, 0.6):
        killed.at(part * killed.lasts)


def test_a_run_killed_while_it_puts_files_in_place(faulty: Commands, killed: Killed) -> None:
    for number in (2, 9):
        assert killed.at_call("rename", number)


def test_a_killed_first_run_is_in_nobodys_way(faulty: Commands, killed: Killed) -> None:
    for call, number in (("sync", 2), ("rename", 5)):
        restored(killed.out, {})
        fault = Fault(killed.out.parent, call, number, signal=signal.SIGKILL)
        assert killed.commands.run("run", killed.deck, "-q", fault=fault).status == -signal.SIGKILL
        assert "block.sta" in content(killed.out)
        assert killed.commands.run("run", killed.deck, "-q").status == 0
        killed.is_whole(content(killed.out), call)


@pytest.mark.trust
def test_kills_at_random_moments(killed: Killed) -> None:
    draw = random.Random(9)
    done = sum(killed.at(draw.random() * killed.lasts) for _ in range(10))
    tries = 10
    while done < KILLS and tries < 3 * KILLS:
        done += killed.at(draw.random() * killed.lasts)
        tries += 1
    assert done >= KILLS
    half_done = killed.half_done
    assert half_done > KILLS // 4  # or the moments were not those that matter
    at_calls = 0
    if killed.commands.shim is not None:
        for call in ("write", "rename", "unlink", "sync"):
            number = 1
            while killed.at_call(call, number):
                number += 1
            at_calls += number - 1
    counts = {"kills": done, "of them with files half done": half_done, "kills at a call on a file": at_calls}
    record_counts("faults-kills", 51, CLAIM, counts)
