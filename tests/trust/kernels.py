"""Figures of all decks under several kernels of OpenBLAS, what differs between them, and the table of README.md.

::

    python -m tests.trust.kernels                                    prints the kernel that numpy computes with
    OPENBLAS_CORETYPE=Haswell python -m tests.trust.kernels FILE     runs all decks that have no line in FILE yet
    python -m tests.trust.kernels --record FILE FILE ...             compares, writes counts and table

A line is JSON: ``deck``, ``way`` (kernel, and threads where it is not one), ``seconds`` and ``cases``, the figures of
each load case. The library chooses its kernel when it is loaded, so each has a process of its own. Kernels round in
different orders: what is proved may not depend on them.
"""

from __future__ import annotations

import ctypes
import json
import math
import os
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from tests.decks.folder import PATHS, is_long, name_of, run_deck
from tests.trust.counts import README, record_counts

KERNELS = ("Haswell", "SkylakeX", "Sandybridge", "Nehalem")
"""values of OPENBLAS_CORETYPE; for Zen the library of numpy and scipy takes the kernel of Haswell"""
ALIKE = 1e-6
"""relative difference up to which figures count as the same"""
BEGIN, END = "<!-- kernels:begin -->\n", "<!-- kernels:end -->\n"
CLAIM = (
    "Statuses and associative figures of all decks are the same whatever kernel OpenBLAS computes with, and with two "
    "threads; figures without dilatancy that are not stand in the table below"
)

Figures = Mapping[str, Any]
"""of a load case: its status, whether its flow is associative (``normal``), and its figures"""
PROVED = "associative_load_factor"
OWN = ("load_factor", "least_load_factor", "torsion_load_factor", "angle", "reaction")
"""figures by the deck's flow rule"""


def kernel() -> str:
    """Name of the kernel that numpy computes with; empty where its library does not tell."""
    for path in Path(np.__file__).parents[1].glob("numpy.libs/*openblas*"):
        core = getattr(ctypes.CDLL(str(path)), "scipy_openblas_get_corename64_", None)
        if core is not None:
            core.restype = ctypes.c_char_p
            return str(core().decode())
    return ""


# --- running ----------------------------------------------------------------------------------------------------------


def run_decks(file: Path) -> None:
    """Run the decks that have no line yet, those that take long last, and write each line as soon as it is there."""
    done = {line["deck"] for line in lines_of(file)}
    threads = os.environ.get("OPENBLAS_NUM_THREADS", "1")
    way = kernel() + ("" if threads == "1" else f", {threads} threads")
    for path in sorted(PATHS, key=lambda path: (is_long(name_of(path)), name_of(path).startswith("structures/"))):
        if (name := name_of(path)) not in done:
            started = time.process_time()
            cases = run_deck(path, "--set", "output.vtu=false").record["cases"]
            line = {"deck": name, "way": way, "seconds": round(time.process_time() - started, 2)}
            line["cases"] = {case["name"]: figures_of(case) for case in cases}
            with file.open("a", encoding="utf-8") as out:
                out.write(json.dumps(line) + "\n")


def figures_of(case: Mapping[str, Any]) -> Figures:
    """What is compared of a load case, from its JSON record."""
    figures = {name: case[name] for name in ("status", PROVED, *OWN[:-1])}
    reaction = case["reaction"]  # over the size of forces there: it may be nothing
    figures["reaction"] = None if reaction is None else reaction["value"] / reaction["unit"]
    return {"normal": case["flow_rule"] == "associative", **figures}


def lines_of(file: Path) -> list[dict[str, Any]]:
    """Lines of a file; none where there is no file."""
    text = file.read_text(encoding="utf-8") if file.exists() else ""
    return [json.loads(line) for line in text.splitlines()]


# --- comparing --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Compared:
    """Load cases by deck and name, each with its figures by way; only those that every way has."""

    ways: tuple[str, ...]
    cases: Mapping[tuple[str, str], Mapping[str, Figures]]

    @cached_property
    def statuses(self) -> list[str]:
        """Load cases whose status is not the same in every way, with the statuses."""
        words = []
        for case, found in self.cases.items():
            if len({each["status"] for each in found.values()}) > 1:
                by_way = ", ".join(f"{each['status']} ({way})" for way, each in found.items())
                words.append(f"{'/'.join(case)}: {by_way}")
        return words

    @cached_property
    def proved(self) -> list[float]:
        """How far associative figures lie apart."""
        figures = [
            [found[way][name] for way in self.ways]
            for found in self.cases.values()
            for name in (PROVED, *(OWN if found[self.ways[0]]["normal"] else ()))
        ]
        return [apart(values) for values in figures if any(value is not None for value in values)]

    @cached_property
    def others(self) -> list[tuple[str, str, list[float | None], float]]:
        """Load case, name, values by way and distance of each figure without a proof that is not the same."""
        rows = [
            ("/".join(case), name, [found[way][name] for way in self.ways])
            for case, found in self.cases.items()
            for name in (() if found[self.ways[0]]["normal"] else OWN)
        ]
        return [(*row, apart(row[2])) for row in rows if apart(row[2]) > ALIKE]


def compared(lines: Sequence[Mapping[str, Any]]) -> Compared:
    """Lines of several ways, side by side."""
    ways = tuple(dict.fromkeys(line["way"] for line in lines))
    cases: dict[tuple[str, str], dict[str, Figures]] = {}
    for line in lines:
        for name, figures in line["cases"].items():
            cases.setdefault((line["deck"], name), {})[line["way"]] = figures
    return Compared(ways, {case: found for case, found in cases.items() if len(found) == len(ways)})


def apart(values: Sequence[float | None]) -> float:
    """Greatest distance over the greatest size, at least 1e-3 as all figures are ratios; inf where some have none."""
    known = [value for value in values if value is not None and math.isfinite(value)]
    if len(known) < len(values):
        return math.inf if known else 0.0
    return (max(known) - min(known)) / max(*map(abs, known), 1e-3)


def table(found: Compared) -> str:
    """Figures without a proof that differ, a line for each, those that lie farthest apart first."""
    rows: dict[tuple[str, tuple[float | None, ...]], list[str]] = {}
    for case, name, values, _ in sorted(found.others, key=lambda row: -row[3]):
        rows.setdefault((case, tuple(values)), []).append(name.replace("_", " "))
    lines = [f"| load case | figures | {' | '.join(found.ways)} | apart |", "|---" * (len(found.ways) + 3) + "|"]
    for (case, figures), names in rows.items():
        shown = " | ".join("none" if value is None else f"{value:.7g}" for value in figures)
        lines.append(f"| {case} | {', '.join(names)} | {shown} | {apart(figures):.1e} |")
    return "\n".join(lines) + "\n"


def record(lines: Sequence[Mapping[str, Any]]) -> Compared:
    """Keep the counts, and put the table in place of the one in README.md."""
    found = compared(lines)
    counts = {
        "decks": len({deck for deck, _ in found.cases}),
        "load cases": len(found.cases),
        f"ways ({'; '.join(found.ways)})": len(found.ways),
        "statuses that differ": len(found.statuses),
        "associative figures": len(found.proved),
        f"of these that differ by more than {ALIKE:g}": sum(far > ALIKE for far in found.proved),
        "figures without dilatancy that do": len(found.others),
    }
    record_counts("kernels", 85, CLAIM, counts)
    text = README.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN, 1)
    README.write_text(before + BEGIN + table(found) + END + rest.split(END, 1)[1], encoding="utf-8")
    return found


def main() -> None:
    """As the first lines say."""
    match sys.argv[1:]:
        case []:
            sys.stdout.write(f"{kernel()}\n")
        case ["--record", *files]:
            found = record([line for file in files for line in lines_of(Path(file))])
            sys.stdout.write("\n".join([*found.statuses, f"associative: {max(found.proved):.1e}"]) + "\n")
        case [file]:
            run_decks(Path(file))


if __name__ == "__main__":
    main()
