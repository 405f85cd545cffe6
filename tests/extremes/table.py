"""Solve every scene and print what the program says of it; ``-o FILE`` writes it as a page.

::

    python -m tests.extremes.table [--family TEXT] [--short] [--red] [--jobs N] [-o FILE]

Every scene has a process of its own, so that one that dies or hangs is a line of the table like the others. The
exit status is 1 where a line is red.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from pathlib import Path

from mbla import __version__
from tests.extremes.outcome import LIMIT, LONG_LIMIT, Outcome, Scene, outcome_of
from tests.extremes.scenes import all_scenes

GRACE = 3.0
"""How many times the limit of the processor may pass on the clock before a process is ended."""
WORDS = 160
"""Characters of what was said that the table shows."""
HEADER = "| scene | expected | got | bounds | status | verdict | what was said |\n|---|---|---|---|---|---|---|"


def main(arguments: Sequence[str] | None = None) -> int:
    """Exit status 1 where a line is red."""
    parser = argparse.ArgumentParser(prog="python -m tests.extremes.table", description="Table of extreme scenes.")
    parser.add_argument("--family", default="", help="families whose name has this text")
    parser.add_argument("--short", action="store_true", help="without those that take long")
    parser.add_argument("--red", action="store_true", help="print red lines alone")
    parser.add_argument("-o", type=Path, default=None, help="file of the page")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at a time")
    asked = parser.parse_args(arguments)
    scenes = [scene for scene in all_scenes() if asked.family in scene.family and not (asked.short and scene.long)]
    outcomes = []
    with ThreadPoolExecutor(asked.jobs) as jobs:
        for outcome in jobs.map(apart, scenes):
            outcomes.append(outcome)
            if outcome.is_red or not asked.red:
                sys.stdout.write(f"{outcome.seconds:6.2f} s {outcome.scene.family}: {row(outcome)}\n")
                sys.stdout.flush()
    if asked.o is not None:
        asked.o.write_text(page(outcomes), encoding="utf-8")
    red = [outcome for outcome in outcomes if outcome.is_red]
    sys.stdout.write(f"{len(outcomes)} scenes, {len(red)} red\n")
    return 1 if red else 0


def apart(scene: Scene) -> Outcome:
    """The outcome of a scene in a process of its own."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["tests.extremes.scenes"])
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_send, args=(scene, sender))
    process.start()
    sender.close()
    limit = LONG_LIMIT if scene.long else LIMIT
    try:
        if receiver.poll(GRACE * limit):
            outcome: Outcome = receiver.recv()
            return outcome
        return Outcome(scene, "hang", words=f"nothing within {GRACE * limit:g} s of the clock")
    except EOFError:
        process.join()
        return Outcome(scene, "crash", words=f"the process ended with {process.exitcode}")
    finally:
        process.kill()
        process.join()


def _send(scene: Scene, sender: Connection) -> None:
    sender.send(outcome_of(scene))


def page(outcomes: Sequence[Outcome]) -> str:
    """The page: a count of verdicts, then a table for each family."""
    counts: dict[str, int] = {}
    for outcome in outcomes:
        counts[outcome.verdict] = counts.get(outcome.verdict, 0) + 1
    red = sum(outcome.is_red for outcome in outcomes)
    lines = [
        "# Numbers at their extremes",
        "",
        f"What mbla {__version__} says of {len(outcomes)} scenes with a known answer, written by",
        "`python -m tests.extremes.table`: " + ", ".join(f"{count} {name}" for name, count in counts.items()) + "; "
        f"{red or 'no'} red line{'' if red == 1 else 's'}.",
        "",
        "*right*: solved, verified and within the tolerance of the expected load factor, or, where there is none, the",
        "status or notice that is right. *diagnosed*: a status, a notice or an error names the cause instead of a",
        "result. Red are *wrong*, *silent* (no result and no cause named), *warning* (of Python), *crash* and *hang*.",
    ]
    for family in dict.fromkeys(outcome.scene.family for outcome in outcomes):
        rows = [row(outcome) for outcome in outcomes if outcome.scene.family == family]
        lines += ["", f"## {family[:1].upper()}{family[1:]}", "", HEADER, *rows]
    return "\n".join(lines) + "\n"


def row(outcome: Outcome) -> str:
    """A line of the table."""
    scene = outcome.scene
    expected = "none" if scene.expected is None else f"{scene.expected:.8g} ± {scene.tolerance:.0e}"
    bounds = f"{_figure(outcome.static)} … {_figure(outcome.kinematic)}"
    verdict = f"**{outcome.verdict}**" if outcome.is_red else outcome.verdict
    words = " ".join(outcome.words.split()).replace("|", "\\|")
    words = words if len(words) <= WORDS else words[: WORDS - 1] + "…"
    shown = "" if words == outcome.status else words
    return f"| {scene.name} | {expected} | {_figure(outcome.got)} | {bounds} | {outcome.status} | {verdict} | {shown} |"


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.8g}"


if __name__ == "__main__":
    raise SystemExit(main())
