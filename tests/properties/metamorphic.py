"""Metamorphic checks of load factors: transformations × decks; ``python -m tests.properties.metamorphic``.

Prints a table and writes it to README.md beside this file. Decks are those under ``decks/`` that are small, and random
ones. An exception that theory explains stands in ``EXPLAINED``; any other ends with exit status 1.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import sys
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from pathlib import Path

from mbla.errors import DeckError
from tests.decks.folder import LONG, PATHS, name_of
from tests.properties.comparisons import Comparison, Verdict, compare, without_normality
from tests.properties.relations import Relation
from tests.properties.scenes import Scene, random_scene, scene_of, solve_scene
from tests.properties.transformations import TABLE

README = Path(__file__).with_name("README.md")
MOST_POINTS = 700
"""contact points of a deck that is tried: some twenty analyses of each take seconds"""
MOST_POINTS_WITHOUT_NORMALITY = 260
SEEDS = range(300, 320)
ODD = (Verdict.EXCEPTION, Verdict.OTHER, Verdict.NOTHING)
FLOWS = ("associative", "non_associative")

ALIKE = ("benchmarks/formats/arch_from_", "benchmarks/published/cocchetti_rizzi_mu_3")
"""beginnings of names of decks that are one structure many times: the last of each stands for all"""

EXPLAINED: dict[tuple[str, str], str] = {
    ("random/312", "rotate with gravity"): "without normality: no scheme is sure to find a state, and this one says so"
}
"""Exceptions by (scene, transformation) and why theory admits them."""


def names() -> list[str]:
    """Every scene that could be tried: decks by name, random ones as ``random/SEED``."""
    decks = [name_of(path) for path in PATHS if name_of(path) not in LONG]
    for beginning in ALIKE:
        same = [name for name in decks if name.startswith(beginning)]
        decks = [name for name in decks if name not in same[:-1]]
    return [*decks, *(f"random/{seed}" for seed in SEEDS)]


def scene_named(name: str) -> Scene:
    """The scene of that name."""
    folder, _, stem = name.partition("/")
    if folder == "random":
        return random_scene(int(stem))
    return scene_of(next(path for path in PATHS if name_of(path) == name))


def checked(name: str) -> tuple[str, list[tuple[str, Comparison]], float]:
    """All comparisons of a scene with their flow rule, and seconds of the processor."""
    started = time.process_time()
    try:
        scene = scene_named(name)
        points = len(scene.contacts()[1].points)
    except DeckError:  # of random decks some say what is refused
        return name, [], time.process_time() - started
    found: list[tuple[str, Comparison]] = []
    if points <= MOST_POINTS:
        solved = solve_scene(scene)
        found += [("associative", one) for row in TABLE for one in compare(scene, solved, row)]
    if points <= MOST_POINTS_WITHOUT_NORMALITY and scene.deck.analysis.contact_model == "concave":
        other = without_normality(scene)
        solved = solve_scene(other)
        rows = [row for row in TABLE if row.any_flow]
        found += [("non_associative", one) for row in rows for one in compare(other, solved, row)]
    return name, found, time.process_time() - started


def table(found: Sequence[tuple[str, Comparison]], flow: str) -> list[str]:
    """Rows of the table of one flow rule."""
    associative = flow == "associative"
    extra = "moved as admitted" if associative else "within the range | another state"
    lines = [
        f"| transformation | load factor | decks | cases | equal | largest difference of these "
        f"| {extra} | no result | exceptions |",
        "|---|---|---|---|---|---|---|" + ("---|---|" if associative else "---|---|---|"),
    ]
    for row in TABLE:
        ours = [one for rule, one in found if rule == flow and one.transformation == row.name]
        if not ours:
            continue
        equal = [abs(one.difference) for one in ours if one.verdict is Verdict.EQUAL]
        count = {verdict: sum(one.verdict is verdict for one in ours) for verdict in Verdict}
        middle = f"{count[Verdict.MOVED]}" if associative else f"{count[Verdict.WITHIN]} | {count[Verdict.OTHER]}"
        largest = f"{max(equal):.1e}" if equal and row.relation is not Relation.ENCLOSED else "–"
        relation = row.relation if row.ratio == 1.0 else f"times {row.ratio:g}"
        lines.append(
            f"| {row.name} | {relation} | {len({one.scene for one in ours})} | {len(ours)} | {len(equal)} | {largest} "
            f"| {middle} | {count[Verdict.NOTHING]} | {count[Verdict.EXCEPTION]} |"
        )
    return lines


def unexplained(found: Iterable[tuple[str, Comparison]]) -> list[Comparison]:
    """Exceptions without a reason."""
    return [
        one for _, one in found if one.verdict is Verdict.EXCEPTION and (one.scene, one.transformation) not in EXPLAINED
    ]


def page(found: Sequence[tuple[str, Comparison]], untried: Sequence[str] = ()) -> str:
    """The page; ``untried`` are scenes that time was too short for."""
    scenes = {one.scene for _, one in found}
    random = sum(name.startswith("random/") for name in scenes)
    lines = [
        "# Metamorphic checks",
        "",
        "Written by `python -m tests.properties.metamorphic`: every transformation on every small deck and on random",
        f"ones, {len(scenes)} in all, {random} of them random. Equal means to 1e-6, relatively, with bounds that",
        "overlap; where the structure is turned or mirrored the sum of the reactions turns as a vector does, and the",
        "weight stays. No result: the other scene came out not verified, and says so.",
        "",
        *((f"Not tried, for want of time: {', '.join(untried)}.", "") if untried else ()),
        "## Associative flow",
        "",
        *table(found, "associative"),
        "",
        *(f"- **{row.name}**: {row.relation}; {row.reason}." for row in TABLE),
        "",
        "## Without normality",
        "",
        "The load factor is not unique: for one mechanism it may lie anywhere in the range that the results give,",
        "and other mechanisms have other ranges. More friction, glue or strength may lower it: nothing monotonic is",
        "a theorem. What is held: verified as before, not above the associative bound; equal, or within the verified",
        "range of one of the two, or another state of the exact law.",
        "",
        *table(found, "non_associative"),
        "",
        "## Exceptions",
        "",
    ]
    odd = [(rule, one) for rule, one in found if one.verdict in ODD]
    for rule, one in odd:
        reason = EXPLAINED.get((one.scene, one.transformation), "")
        if one.verdict is Verdict.OTHER:
            reason = "another state of the exact law"
        lines.append(f"- {rule}, {one.scene} {one.case}, {one.transformation}: {one.words}. {reason}")
    if not odd:
        lines.append("None.")
    return "\n".join(lines) + "\n"


def _read(journal: Path | None) -> dict[str, list[tuple[str, Comparison]]]:
    """Comparisons by scene."""
    if journal is None or not journal.exists():
        return {}
    rows = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
    return {
        name: [(flow, Comparison(**one | {"verdict": Verdict(one["verdict"])})) for flow, one in some]
        for name, some in rows
    }


def _keep(journal: Path | None, name: str, some: Sequence[tuple[str, Comparison]]) -> None:
    if journal is not None:
        with journal.open("a", encoding="utf-8") as file:
            file.write(json.dumps([name, [(flow, asdict(one)) for flow, one in some]]) + "\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print, write; 1 where an exception has no reason."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", help="scenes, else all; the page is then not written")
    parser.add_argument("--journal", type=Path, help="file of what is done: scenes in it are not tried again")
    parser.add_argument("--seconds", type=float, default=math.inf, help="no new scene after so long; default: all")
    options = parser.parse_args(arguments)
    chosen = options.only or names()
    done, started = _read(options.journal), time.monotonic()
    found = [pair for name in chosen for pair in done.get(name, [])]
    ahead = [name for name in chosen if name not in done]
    with multiprocessing.get_context("spawn").Pool(options.jobs) as pool:
        for name, some, seconds in pool.imap_unordered(checked, ahead) if options.seconds > 0 else ():
            found += some
            done[name] = some
            _keep(options.journal, name, some)
            odd = [one for _, one in some if one.verdict in ODD]
            sys.stdout.write(
                "\n    ".join([f"{name}: {len(some)} comparisons, {seconds:.1f} s", *map(str, odd)]) + "\n"
            )
            sys.stdout.flush()
            if time.monotonic() - started > options.seconds:
                break
    for flow in FLOWS:
        sys.stdout.write("\n".join(["", flow, *table(found, flow)]) + "\n")
    if not options.only:
        README.write_text(page(found, [name for name in chosen if name not in done]), encoding="utf-8")
    missing = unexplained(found)
    sys.stdout.write(f"{len(missing)} exceptions without a reason\n")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
