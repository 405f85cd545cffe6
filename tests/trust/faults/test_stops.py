"""``mbla run`` stopped at any moment, by a kill or a signal: no torn file, the right exit status, and soon."""

from __future__ import annotations

import json
import os
import random
import signal
import time
from collections.abc import Mapping
from pathlib import Path

import pytest

from mbla.results.hdf5.result_file import read_results_hdf5
from tests.trust.counts import record_counts
from tests.trust.faults.scene import Scene, content, is_one_plain_line, without_partial
from tests.trust.processes import Commands, Ended

OF_KILLS = (
    "`mbla run` killed (SIGKILL) at random moments over an earlier result: the next command finds the earlier result "
    "byte for byte, or the new one whole, and clears the rest away"
)
OF_SIGNALS = (
    "SIGINT and SIGTERM to `mbla run` at any moment: exit status 130 and 143 after less than two seconds of processor "
    "time, one line, and the earlier result byte for byte, or the new one whole"
)
OF_PAIRS = (
    "Two runs of one deck into one folder at once: each ends with its whole result or is refused, and the files in the "
    "folder are of one run"
)
KILLS, SIGNALS_SENT, PAIRS = 500, 100, 50
"""the second for each signal"""
SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143}
"""and the exit status of a command that they end"""
SOON = 2.0
"""seconds, times the load of the machine per processor where that is more than one"""


def check_killed(scene: Scene, told: object) -> None:
    """What a killed run left is put right by the next one, which is refused as there is a result."""
    refused = scene.run()
    assert refused.status == 6, (told, refused)
    now = without_partial(content(scene.out))
    if (left := scene.out / "block.partial.h5").exists():
        assert not read_results_hdf5(left).complete, told
    if now != scene.earlier:
        check_whole(scene, now, told)
        assert all(now[name] != scene.earlier[name] for name in ("block.sta", "block.lst", "block.h5")), told


def check_whole(scene: Scene, now: Mapping[str, bytes], told: object) -> None:
    """The new result, complete: all of its files and no others, each of the same run."""
    assert sorted(now) == sorted(json.loads(now["block.json"])["files"]), told
    (case,) = read_results_hdf5(scene.out / "block.h5").cases
    assert case.solution.mechanics is not None
    assert case.solution.mechanics.load_factor == pytest.approx(0.5, abs=1e-6), told
    assert json.loads(now["block.json"])["cases"][0]["load_factor"] == case.solution.mechanics.load_factor, told


def check_interrupted(scene: Scene, ended: Ended, told: object) -> None:
    """One line; files are as they were, or all new; nothing temporary is there, without a next run.

    What was done may be left in files of its own.
    """
    assert is_one_plain_line(ended.err), told
    now = without_partial(content(scene.out))
    if now != scene.earlier:
        assert sorted(now) == sorted(scene.new), told
        same = [name for name in now if name in scene.earlier and now[name] == scene.earlier[name]]
        assert not {"block.h5", "block.lst", "block.sta", "block.json"} & set(same), (told, same)


def kill_at(scene: Scene, moment: float) -> tuple[bool, bool]:
    """A kill so long after the run began [s]; whether it was still at work, and with files half done."""
    run = scene.begin()
    time.sleep(moment)
    run.send(signal.SIGKILL)
    killed = run.end().status == -signal.SIGKILL
    half_done = any(name.startswith(".") for name in content(scene.out))
    check_killed(scene, moment)
    return killed, half_done


def signal_at(scene: Scene, moment: float, which: signal.Signals) -> bool:
    """A signal so long after the run began [s]; whether it was still at work."""
    run = scene.begin()
    time.sleep(moment)
    used, sent = run.processor_time(), time.monotonic()
    run.send(which)
    ended = run.end()
    took = time.monotonic() - sent
    told = (moment, which.name, ended, took, ended.seconds - used)
    if ended.status == 0:
        return False
    assert ended.seconds - used < SOON, told
    assert took < SOON * max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0))), told
    if not _had_not_begun(ended, which):
        assert ended.status == SIGNALS[which], told
        check_interrupted(scene, ended, told)
    return True


def _had_not_begun(ended: Ended, which: signal.Signals) -> bool:
    """The signal came before the program was there to hear it, or when it had done all and the interpreter ended."""
    outside = "main(command" in ended.err and "_run" not in ended.err.split("main(command")[1]
    return ended.status == -which or (ended.status == 1 and outside)


@pytest.mark.long
def test_a_run_killed_at_some_moment(scene: Scene) -> None:
    kill_at(scene, 0.6 * scene.lasts)


@pytest.mark.trust
def test_kills_at_random_moments(scene: Scene) -> None:
    draw = random.Random(9)
    done = half_done = tries = 0
    while done < KILLS and tries < 3 * KILLS:
        killed, half = kill_at(scene, draw.random() * scene.lasts)
        done, half_done, tries = done + killed, half_done + half, tries + 1
    assert done >= KILLS
    assert half_done > KILLS // 4  # or the moments were not those that matter
    record_counts("faults-kills", 51, OF_KILLS, {"kills": done, "of them with files half done": half_done})


@pytest.mark.long
@pytest.mark.parametrize("which", SIGNALS)
def test_a_run_that_gets_a_signal(scene: Scene, which: signal.Signals) -> None:
    signal_at(scene, 0.5 * scene.lasts, which)


@pytest.mark.trust
def test_signals_at_random_moments(scene: Scene) -> None:
    at_moments = 0
    draw = random.Random(5)
    for which in SIGNALS:
        came = tries = 0
        while came < SIGNALS_SENT and tries < 4 * SIGNALS_SENT:
            came += signal_at(scene, draw.random() * scene.lasts, which)
            tries += 1
        assert came >= SIGNALS_SENT
        at_moments += came
    record_counts("faults-signals", 52, OF_SIGNALS, {"signals at random moments": at_moments})


@pytest.mark.trust
def test_two_runs_at_once(commands: Commands, tmp_path: Path) -> None:
    draw = random.Random(3)
    scene = Scene(commands, tmp_path)
    refusals = 0
    with Commands(("mbla.run",)) as others:
        for pair in range(PAIRS):
            first = commands.begin("run", scene.deck, "-q", "--force", "--set", "parameters.mu=0.3")
            time.sleep(draw.random() * scene.lasts * (pair % 2))  # the others at the same time, to write together
            second = others.begin("run", scene.deck, "-q", "--force", "--set", "parameters.mu=0.4")
            ends = [first.end(), second.end()]
            assert {ended.status for ended in ends} in ({0}, {0, 6}), ends
            assert all(ended.status == 0 or "is at work on it" in ended.err for ended in ends), ends
            refusals += any(ended.status for ended in ends)
            _check_of_one_run(content(scene.out), {0.3: ends[0].status, 0.4: ends[1].status})
    assert refusals
    record_counts("faults-pairs", 54, OF_PAIRS, {"pairs of runs": PAIRS, "of them with one refused": refusals})


def _check_of_one_run(files: Mapping[str, bytes], statuses: Mapping[float, int]) -> None:
    """Every file is of a run that ended well: the load factor of the block is its friction."""
    record = json.loads(files["block.json"])
    assert sorted(files) == sorted(record["files"])
    factor = round(record["cases"][0]["load_factor"], 4)
    assert statuses[factor] == 0
    assert f"{factor:.6g}" in files["block.lst"].decode()
    rows = [line.split() for line in files["block.sta"].decode().splitlines() if not line.startswith("#")]
    last = [row for row in rows if row[1] == "1"][-1]  # later programs are of the range
    assert float(last[3]) == pytest.approx(factor, abs=1e-3)
