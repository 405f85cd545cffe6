"""SIGINT and SIGTERM to ``mbla run``: 130 and 143, soon, one line, and files as they were or whole."""

from __future__ import annotations

import os
import random
import signal
import time
from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.faults.commands import (
    SIGNALS,
    Commands,
    Fault,
    content,
    is_one_plain_line,
    restored,
    without_partial,
    written,
)

CLAIM = (
    "SIGINT and SIGTERM to `mbla run` at any moment: exit status 130 and 143 after less than two seconds of processor "
    "time, one line, and the earlier result byte for byte, or the new one whole"
)
SOON = 2.0
"""seconds, times the load of the machine per processor where that is more than one"""
RANDOM = 100
"""moments for each signal"""


class Interrupted:
    """A deck, and its earlier result."""

    def __init__(self, commands: Commands, folder: Path) -> None:
        self.commands = commands
        self.deck = written(folder / "block.yaml")
        self.out = folder / "block.out"
        assert commands.run("run", self.deck, "--set", "parameters.mu=0.3", "-q").status == 0
        self.earlier = content(self.out)
        begun = time.monotonic()
        assert commands.run("run", self.deck, "-q", "--force").status == 0
        self.lasts = time.monotonic() - begun
        self.new = sorted(content(self.out))

    def check(self, told: object) -> None:
        """Files are as they were, or all new; nothing temporary is there, without a next run.

        The load case that was done may be left in files of its own, all or none.
        """
        now = without_partial(content(self.out))
        if now != self.earlier:
            assert sorted(now) == self.new, told
            same = [
                name for name in ("block.h5", "block.lst", "block.sta", "block.json") if now[name] == self.earlier[name]
            ]
            assert not same, (told, same)

    def soon(self) -> float:
        """Seconds in which a run must end: two on a machine that has a processor for it."""
        return SOON * max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0)))

    def at_call(self, call: str, number: int, which: signal.Signals) -> bool:
        """A signal right before a call on a file; whether it came. It is there before the call is done."""
        restored(self.out, self.earlier)
        fault = Fault(self.out.parent, call, number, signal=which)
        begun = time.monotonic()
        ended = self.commands.run("run", self.deck, "-q", "--force", fault=fault)
        if not ended.counts["came"]:
            assert ended.status == 0
            return False
        assert time.monotonic() - begun < self.soon() + 20 * self.lasts
        told = (call, number, which.name, ended.said)
        assert ended.status == SIGNALS[which], told
        assert is_one_plain_line(ended.said), told
        self.check(told)
        return True

    def at(self, moment: float, which: signal.Signals) -> bool:
        """A signal so long after the run began [s]; whether it was still at work."""
        restored(self.out, self.earlier)
        run = self.commands.begin("run", self.deck, "-q", "--force")
        time.sleep(moment)
        used, sent = run.processor_time(), time.monotonic()
        run.send(which)
        ended = run.end()
        took = time.monotonic() - sent
        worked = ended.processor_time - used
        told = (moment, which.name, ended.status, ended.said, took, worked)
        if ended.status == 0:
            return False
        assert ended.status == SIGNALS[which] or _had_not_begun(ended.status, ended.said, which), told
        assert ended.status != SIGNALS[which] or is_one_plain_line(ended.said), told
        assert worked < SOON, told
        assert took < self.soon(), told
        self.check(told)
        return True


def _had_not_begun(status: int, said: str, which: signal.Signals) -> bool:
    """The signal came before the program was there to hear it, or when it had done all and the interpreter ended."""
    return status == -which or (status == 1 and "main(command" in said and "_run" not in said.split("main(command")[1])


@pytest.fixture(scope="module")
def interrupted(commands: Commands, tmp_path_factory: pytest.TempPathFactory) -> Interrupted:
    return Interrupted(commands, tmp_path_factory.mktemp("interrupted"))


@pytest.mark.parametrize("which", SIGNALS)
@pytest.mark.parametrize(("call", "number"), [("open", 3), ("rename", 3), ("unlink", 5)])
def test_a_signal_at_a_call(
    faulty: Commands, interrupted: Interrupted, call: str, number: int, which: signal.Signals
) -> None:
    assert interrupted.at_call(call, number, which)


@pytest.mark.trust
def test_signals_at_every_call_and_at_random_moments(faulty: Commands, interrupted: Interrupted) -> None:
    at_calls = at_moments = 0
    draw = random.Random(5)
    for which in SIGNALS:
        for call in ("write", "sync", "rename", "open", "unlink"):
            number = 1
            while interrupted.at_call(call, number, which):
                number += 1
            at_calls += number - 1
        came = tries = 0
        while came < RANDOM and tries < 4 * RANDOM:
            came += interrupted.at(draw.random() * interrupted.lasts, which)
            tries += 1
        assert came >= RANDOM
        at_moments += came
    counts = {"signals at a call on a file": at_calls, "at random moments": at_moments}
    record_counts("faults-signals", 52, CLAIM, counts)
