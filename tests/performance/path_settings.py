"""What each setting of the path of elastic joints is worth: halved and doubled, on small structures.

::

    python -m tests.performance.path_settings               all settings
    python -m tests.performance.path_settings short growth  some
    python -m tests.performance.path_settings --table       what was recorded, for README.md

For each the mean and the greatest change of the load factor, with its structure, load factors that are an answer no
more (stuck, budget) and that have become one, and factorisations over those of the settings as they are, the geometric
mean. One thread.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.flow.path_of_part import path_of_part
from mbla.solution.flow.settings import PathSettings
from tests.decks.folder import DECKS
from tests.performance.recording import RESULTS, read_rows, record
from tests.solution.flow.paths import Case, case_of

STRUCTURES = (
    ("benchmarks/published/ferris_wall_1", "push_x"),
    ("benchmarks/published/ferris_wall_3", "push_x"),
    ("benchmarks/published/ferris_wall_5", "push_x"),
    ("benchmarks/closed_forms/wall_10x10", "in_plane"),
    ("benchmarks/closed_forms/dome_in_bond", "push_x"),
    ("regressions/light_block_pushed", "c"),
    ("structures/colonnade", "along"),
    ("structures/cross_vault_on_piers", "along_x"),
    ("structures/cross_vault_on_piers", "diagonal"),
    ("structures/spiral_stair", "one_tread"),
    ("tutorials/arch", "along"),
    ("tutorials/arch_on_piers", "along"),
    ("tutorials/arch_on_piers", "keystone"),
    ("tutorials/buttressed_wall", "bonded_towards"),
    ("tutorials/corner", "corner_in"),
    ("tutorials/cross_vault", "along_x"),
    ("tutorials/cross_vault", "diagonal"),
    ("tutorials/dome", "push_x"),
    ("tutorials/lintels_and_arches", "in_plane"),
    ("tutorials/pavilion_vault", "along_x"),
    ("tutorials/pavilion_vault", "along_y"),
    ("tutorials/segmental_domes", "slide"),
    ("tutorials/square_silo", "grain"),
)
"""decks and load cases, less than a second each"""

AS_IT_IS = PathSettings()
SHARE, FROM = AS_IT_IS.smoothed
SMALLER, LARGER = 0.5, 2.0


def halved_and_doubled() -> dict[str, tuple[PathSettings, PathSettings]]:
    """Of each setting; of growth what is above 1, of smoothing's share and where it falls each by itself."""
    ways = (SMALLER, LARGER)
    numbers = ("first", "longest", "smoothing", "most_smoothing", "dropped", "counted", "short")
    counts = ("wandering", "steps")
    changes: dict[str, list[dict[str, object]]] = {
        **{name: [{name: way * getattr(AS_IT_IS, name)} for way in ways] for name in numbers},
        **{name: [{name: round(way * getattr(AS_IT_IS, name))} for way in ways] for name in counts},
        "growth": [{"growth": 1.0 + way * (AS_IT_IS.growth - 1.0)} for way in ways],
        "smoothed": [{"smoothed": (way * SHARE, FROM)} for way in ways],
        "smoothed from": [{"smoothed": (SHARE, way * FROM)} for way in ways],
    }
    return {name: tuple(replace(AS_IT_IS, **each) for each in both) for name, both in changes.items()}  # type: ignore[arg-type, misc]


@dataclass(frozen=True)
class Found:
    """Of one path."""

    load_factor: float
    is_answer: bool
    factorizations: int


def followed(case: Case, associative: AssociativeResult, settings: PathSettings) -> Found:
    """One structure by some settings."""
    found = path_of_part(case.loaded, associative, settings)
    return Found(case.loaded.scaling.load_factor(found.load_factor), found.is_answer, found.factorizations)


def compared(names: Sequence[str], before: Sequence[Found], after: Sequence[Found]) -> dict[str, object]:
    """What has changed."""
    changes = np.array([new.load_factor / old.load_factor - 1.0 for old, new in zip(before, after, strict=True)])
    pairs = list(zip(before, after, strict=True))
    known = np.nan_to_num(changes)
    worst = int(np.abs(known).argmax())
    return {
        "mean": f"{100.0 * np.abs(known).mean():.3f} %",
        "greatest": f"{100.0 * known[worst]:+.2f} %",
        "of": names[worst],
        "moved": int((np.abs(known) > 1e-7).sum()),
        "lost": sum(old.is_answer and not new.is_answer for old, new in pairs),
        "gained": sum(new.is_answer and not old.is_answer for old, new in pairs),
        "work": f"{np.exp(np.mean([np.log(new.factorizations / old.factorizations) for old, new in pairs])):.2f}",
    }


def table() -> Iterator[str]:
    """Last recorded rows, a line for each setting."""
    last = {(row["setting"], row["way"]): row for row in read_rows(RESULTS / "path_settings.csv")}
    yield "| setting | halved | doubled |"
    yield "|---|---|---|"
    for name in dict.fromkeys(name for name, _ in last):
        cells = []
        for way in ("halved", "doubled"):
            row = last[name, way]
            lost = f"; {row['lost']} lost" if int(row["lost"]) else ""
            same = "none" if row["moved"] == "0" else f"{row['mean']}, {row['greatest']} ({row['of']})"
            cells.append(f"{same}, {row['work']}{lost}")
        yield f"| {name} | {' | '.join(cells)} |"


def main() -> None:
    """As the first lines say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("settings", nargs="*")
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    if options.table:
        sys.stdout.write("".join(f"{line}\n" for line in table()))
        return
    cases = [case_of(DECKS / f"{name}.yaml", case) for name, case in STRUCTURES]
    names = [f"{name.split('/')[-1]} {case}" for name, case in STRUCTURES]
    associative = [solve_associative(case.loaded, case.settings, lambda record: None) for case in cases]

    def all_by(settings: PathSettings) -> list[Found]:
        return [followed(case, answer, settings) for case, answer in zip(cases, associative, strict=True)]

    before = all_by(AS_IT_IS)
    for name, both in halved_and_doubled().items():
        if options.settings and name not in options.settings:
            continue
        for way, settings in zip(("halved", "doubled"), both, strict=True):
            record("path_settings", {"setting": name, "way": way, **compared(names, before, all_by(settings))})


if __name__ == "__main__":
    main()
