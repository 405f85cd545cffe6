"""The court: what a change of the solver stage does to figures, statuses and times, over everything there is.

::

    python -m tests.performance.court run BEFORE            all sets, into results/court/BEFORE.csv
    python -m tests.performance.court run BEFORE decks walls --limit 600
    python -m tests.performance.court compare BEFORE AFTER  what differs, a table of counts and of cases
    python -m tests.performance.court table BEFORE AFTER    every load case of a deck without dilatancy, in Markdown

Sets: ``decks`` (every deck by its own flow rule), ``rules`` (associative and without dilatancy), ``walls`` (20 to 100
courses, in the plane and in space), ``corpora`` (random assemblies of tests/trust), ``experiments`` (dry-stone walls
that were pushed). A run of a set goes on where the file ends, so that it may be stopped. Each deck runs in a process of
its own on one thread; seconds are of the processor, for all that the solver stage does. Associative figures must agree
to 1e-9, statuses must be the same; other figures are printed where they differ by more than 1e-6.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import partial
from pathlib import Path
from typing import Any

from tests.decks.folder import DECKS, PATHS
from tests.performance.recording import ONE_THREAD, PROJECT, RESULTS
from tests.trust.certificates.assemblies import assembly

COURT = RESULTS / "court"
LIMIT = 300
"""seconds of the processor for one deck"""
SEEDS = range(1000)
WALLS = (20, 40, 60, 100)
SAME_BOUND, SAME = 1e-9, 1e-6
"""relative differences up to which associative figures, and others, count as equal"""

Deck = tuple[str, Path | dict[str, object], tuple[str, ...]]
"""name, path or content, overrides"""


@dataclass(frozen=True)
class Verdict:
    """One load case."""

    set: str
    deck: str
    case: str
    status: str
    load_factor: float
    least: float
    associative: float
    standing: str
    seconds: float
    reason: str
    end: str

    @property
    def key(self) -> tuple[str, str, str]:
        """What tells it apart."""
        return self.set, self.deck, self.case


def decks() -> Iterator[Deck]:
    """Every deck, by its own flow rule."""
    for path in PATHS:
        yield str(path.relative_to(DECKS).with_suffix("")), path, ()


def rules() -> Iterator[Deck]:
    """Every deck with associative flow and without dilatancy."""
    for name, path, _ in decks():
        for rule in ("associative", "non_associative"):
            yield f"{name} {rule}", path, (f"analysis.flow_rule={rule}",)


def walls() -> Iterator[Deck]:
    """Walls in running bond, pushed in their plane, without dilatancy."""
    for plane in ("plane", "space"):
        for n in WALLS if plane == "plane" else WALLS[:2]:
            switches = () if plane == "plane" else ("analysis.reductions=false",)
            size = (f"parameters.m={n}", f"parameters.n={n}", "analysis.flow_rule=non_associative")
            yield f"{n} x {n} {plane}", DECKS / "tradeoff" / "wall.yaml", (*size, *switches)


def corpora() -> Iterator[Deck]:
    """Random assemblies without dilatancy."""
    for seed in SEEDS:
        yield f"assembly {seed}", assembly(seed), ("analysis.flow_rule=non_associative",)


def experiments() -> Iterator[Deck]:
    """Dry-stone walls under vertical load that were pushed: Vasconcelos and Lourenço; Lourenço and others 2005."""
    for load in (40, 100, 175, 250):
        yield f"WS {load} kN", dry_wall(1.2, 0.15, 1.325, load, 73e6, 0.65), ()
    for load in (30, 100, 200, 250):
        yield f"SW {load} kN", dry_wall(0.9, 0.1, 1.0, load, 57e6, 0.62), ()


def dry_wall(
    height: float, course: float, level: float, load: float, strength: float, friction: float
) -> dict[str, object]:
    """A wall of 1.0 × 0.2 m in running bond under a beam, of no weight, that carries a load and is pushed at a level.

    height, course, level : m; load : kN; strength : Pa
    """
    depth = 2.0 * (level - height)
    beam = {"group": "beam", "material": "light", "min": [0, 0, height], "max": [1.0, 0.2, height + depth]}
    unit = {"material": "stone", "unit": [0.2, 0.2, course], "length": 1.0, "courses": round(height / course)}
    middle = [0.5, 0.1, height + depth]
    return {
        "mbla": 1,
        "materials": {"stone": {"density": 2039.0}, "light": {"density": 1.0}},
        "joints": {"dry": {"friction": friction, "compressive_strength": strength}},
        "blocks": [{"wall": unit}, {"box": beam}],
        "contacts": {"joint": "dry"},
        "supports": [{"ground": {"z": 0}}],
        "load_cases": {
            "push": {
                "dead": [{"force": [0, 0, -1e3 * load], "on": "beam", "at": middle}],
                "live": [{"force": [1000, 0, 0], "on": "beam", "at": [0.0, 0.1, level]}],
            }
        },
    }


SETS = {"decks": decks, "rules": rules, "walls": walls, "corpora": corpora, "experiments": experiments}


def run(label: str, sets: list[str], limit: int) -> None:
    """All decks of the sets that the file of that label does not have yet."""
    path = COURT / f"{label}.csv"
    known = {(verdict.set, verdict.deck) for verdict in read(path)}
    path.parent.mkdir(exist_ok=True)
    fresh = not path.exists() or not path.stat().st_size
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if fresh:
            writer.writerow([field.name for field in fields(Verdict)])
        for name in sets or SETS:
            for deck, content, overrides in SETS[name]():
                if (name, deck) in known:
                    continue
                for verdict in judged(name, deck, content, overrides, limit):
                    row = (getattr(verdict, field.name) for field in fields(Verdict))
                    writer.writerow([f"{value:.12g}" if isinstance(value, float) else value for value in row])
                file.flush()


def judged(
    name: str, deck: str, content: Path | dict[str, object], overrides: tuple[str, ...], limit: int
) -> list[Verdict]:
    """The load cases of one deck, in a process of its own."""
    environment = os.environ | ONE_THREAD
    with tempfile.TemporaryDirectory() as folder:
        path = content if isinstance(content, Path) else Path(folder) / "deck.yaml"
        if not isinstance(content, Path):
            path.write_text(json.dumps(content), encoding="utf-8")
        settings = [f"--set={value}" for value in overrides]
        child = subprocess.run(
            [sys.executable, "-m", "mbla", "run", str(path), *settings, "--json", "-q", "-o", f"{folder}/out"],
            cwd=PROJECT,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            check=False,
            preexec_fn=partial(resource.setrlimit, resource.RLIMIT_CPU, (limit, limit + 10)),
        )
    found = json.loads(child.stdout) if child.stdout.strip() else {}
    cases = found.get("cases", [])
    if not cases:
        nothing = float("nan")
        return [Verdict(name, deck, "", f"exit {child.returncode}", nothing, nothing, nothing, "", nothing, "", "")]
    return [_verdict(name, deck, case) for case in cases]


def _verdict(name: str, deck: str, case: dict[str, Any]) -> Verdict:
    def number(key: str) -> float:
        value = case.get(key)
        return float("nan") if value is None else float(str(value))

    standing = case.get("standing")
    return Verdict(
        name,
        deck,
        str(case["name"]),
        str(case["status"]),
        number("load_factor"),
        number("least_load_factor"),
        number("associative_load_factor"),
        str(standing.get("verdict", "") if isinstance(standing, dict) else standing or ""),
        float(case["time"]["solver"]),
        str(case.get("reason") or ""),
        str(case.get("path_end") or ""),
    )


def read(path: Path) -> list[Verdict]:
    """Rows of a file; none where there is no file."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [_row(row) for row in csv.DictReader(file)]


def _row(row: dict[str, str]) -> Verdict:
    return Verdict(
        row["set"],
        row["deck"],
        row["case"],
        row["status"],
        float(row["load_factor"]),
        float(row["least"]),
        float(row["associative"]),
        row["standing"],
        float(row["seconds"]),
        row["reason"],
        row["end"],
    )


def compare(before: str, after: str) -> None:
    """What differs between two files: counts by set, then every case with another status or figure."""
    old = {verdict.key: verdict for verdict in read(COURT / f"{before}.csv")}
    new = {verdict.key: verdict for verdict in read(COURT / f"{after}.csv")}
    say = sys.stdout.write
    for name in SETS:
        both = [key for key in old if key in new and key[0] == name]
        if not both:
            continue
        statuses = Counter(new[key].status for key in both)
        seconds = sum(new[key].seconds for key in both), sum(old[key].seconds for key in both)
        words = ", ".join(f"{count} {status}" for status, count in statuses.most_common())
        none = sum(math.isnan(new[key].least) and not math.isnan(old[key].least) for key in both)
        say(f"{name}: {len(both)} load cases ({words}; {none} have no least any more); ")
        say(f"solver stage {seconds[0]:.0f} s for {seconds[1]:.0f} s\n")
        for key in both:
            for line in _differences(old[key], new[key]):
                say(f"  {key[1]} {key[2]}: {line}\n")


def _differences(old: Verdict, new: Verdict) -> Iterator[str]:
    if old.status != new.status:
        yield f"{old.status} -> {new.status} ({new.reason[:100]})"
    for name, limit in (("load_factor", SAME), ("least", SAME), ("associative", SAME_BOUND)):
        one, other = getattr(old, name), getattr(new, name)
        if name == "least" and math.isnan(other):
            continue
        if (one != one) != (other != other) or abs(one - other) > limit * max(abs(one), abs(other)):
            yield f"{name} {one:.9g} -> {other:.9g}"


def table(before: str, after: str) -> None:
    """Load cases of decks without dilatancy: figures, the one before, time over that of associative flow, end."""
    old = {verdict.key: verdict for verdict in read(COURT / f"{before}.csv")}
    new = {verdict.key: verdict for verdict in read(COURT / f"{after}.csv")}
    say, rule = sys.stdout.write, " non_associative"
    say("| deck, load case | load factor | least found | associative | before | time | before | end |\n")
    say("|---|---|---|---|---|---|---|---|\n")
    for key, now in new.items():
        if key[0] != "rules" or not key[1].endswith(rule):
            continue
        deck, was = key[1].removesuffix(rule), old.get(key)
        normal = ("rules", f"{deck} associative", key[2])
        cells = [
            f"{deck} {key[2]}",
            *(_told(value) for value in (now.load_factor, now.least, now.associative)),
            "–" if was is None else _told(was.load_factor),
            _over(now, new.get(normal)),
            _over(was, old.get(normal)),
            now.end if now.status == "solved" else f"{now.end}, {now.status}".removeprefix(", "),
        ]
        say(f"| {' | '.join(cells)} |\n")


def _told(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.6g}"


def _over(verdict: Verdict | None, normal: Verdict | None) -> str:
    """Time over that of associative flow."""
    return "–" if verdict is None or normal is None else f"{verdict.seconds / normal.seconds:.2g}"


def main() -> None:
    """Run, compare or tell."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    running = commands.add_parser("run")
    running.add_argument("label")
    running.add_argument("sets", nargs="*", choices=[[], *SETS])
    running.add_argument("--limit", type=int, default=LIMIT, metavar="SECONDS", help="of the processor for one deck")
    telling = {"compare": compare, "table": table}
    for name in telling:
        command = commands.add_parser(name)
        command.add_argument("before")
        command.add_argument("after")
    options = parser.parse_args()
    if options.command == "run":
        run(options.label, options.sets, options.limit)
    else:
        telling[options.command](options.before, options.after)


if __name__ == "__main__":
    main()
