"""Random decks as a user runs them: no internal error, files that agree, the same answer in other words.

What says the same in another way has the same associative load factors, exit status and angles; so have the published
walls, whose figures a second formulation gives.
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from mbla.results.exit_status import EXIT_CODES, FAULTS, GRAVEST_FIRST
from mbla.results.explanations import explanations
from mbla.solution.solution import PROVED_STANDING, Status
from tests.analytic.planar import wall, wall_load_factor
from tests.analytic.test_planar_programs import ferris_tin_loi
from tests.properties.random_decks import random_deck
from tests.properties.random_items import Tree
from tests.properties.restatements import rotation
from tests.properties.rewritten import copies_written_out, in_units, moved, shuffled

FEW = (0, 3, 10, 13, 23, 39, 46, 49)
"""one each of solved, without equilibrium, unbounded, convex, a dome on a tilting table, dilatancy and mortar"""
SEEDS = (*FEW, *range(60, 110, 4))
MORE = [seed for seed in range(60, 110) if seed not in SEEDS]
SAME = 3e-6
"""relative difference of load factors: the bounds of each may be 1e-6 apart, or a little more near an edge"""
SHARP = 1e-7
"""with ``accuracy: reference``"""
NOTHING = 1e-7
"""difference of load factors that are 0, where nothing but a frictionless joint holds, say"""
SAME_ANGLE = 1e-4
"""degrees"""
INVARIANT = (0, 18, 22, *range(60, 90))


@dataclass(frozen=True)
class Run:
    """Exit status, the object of ``--json``, and what went to standard error."""

    code: int
    record: dict[str, Any]
    errors: str

    @property
    def cases(self) -> list[dict[str, Any]]:
        """Load cases of the record."""
        found: list[dict[str, Any]] = self.record.get("cases", [])
        return found


def write_deck(deck: Tree, folder: Path, name: str = "deck") -> Path:
    """The deck as a file; JSON is YAML."""
    path = folder / f"{name}.yaml"
    path.write_text(json.dumps(deck), encoding="utf-8")
    return path


def run_deck(path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """What ``mbla run --json --force`` makes of it."""

    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is no JSON")

    code = main(["run", str(path), "--json", "--force"])
    streams = capsys.readouterr()
    return Run(code, json.loads(streams.out, parse_constant=refuse), streams.err)


@pytest.mark.parametrize(
    "seed",
    [
        *(pytest.param(seed, marks=pytest.mark.long) for seed in SEEDS),
        *(pytest.param(seed, marks=pytest.mark.trust) for seed in MORE),
    ],
)
def test_files_and_exit_status_agree(seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_deck(random_deck(seed), tmp_path)
    run = run_deck(path, capsys)
    assert run.code in (0, 3, 4, 5), run.errors
    assert run.code == run.record["exit_code"]
    checked = main(["check", str(path), "--vtu"])
    told = capsys.readouterr()
    if run.code == 3:
        assert checked == 3
        check_refusal(path, run)
        return
    assert checked == 0, told.err
    codes = {EXIT_CODES[Status(case["status"])] for case in run.cases}
    codes |= {4 for notice in run.record["notices"] if notice["identifier"] in FAULTS}
    assert run.code == next((code for code in GRAVEST_FIRST if code in codes), 0)
    assert all((case["load_factor"] is None) != (case["status"] in ("solved", "approximate")) for case in run.cases)
    file = str(path.with_suffix(".out") / "deck.h5")
    verdicts = {case["standing"]["verdict"] for case in run.cases if case["standing"] is not None}
    unproved = not verdicts <= {str(verdict) for verdict in PROVED_STANDING}
    assert main(["verify", file]) in ({run.code, 4} if unproved else {run.code}), capsys.readouterr().out
    assert main(["show", file]) == 0


def check_refusal(path: Path, run: Run) -> None:
    """Each fault with its place and an identifier that is explained, in words and in the object alike; no files."""
    lines = run.errors.splitlines()
    assert run.record["errors"] == lines
    assert all(f"{path.name}:1:" in line for line in lines)
    identifiers = [re.search(r"\[([a-z0-9-]+)\]$", line) for line in lines]
    assert run.record["identifiers"] == list(dict.fromkeys(found[1] for found in identifiers if found))
    assert all(identifiers)
    assert set(run.record["identifiers"]) <= set(explanations())
    assert not path.with_suffix(".out").exists()


def associative_deck(seed: int) -> Tree:
    """A random deck of the kind whose load factor is unique."""
    deck = random_deck(seed)
    analysis = deck["analysis"] | {"flow_rule": "associative", "accuracy": "standard"}
    return deck | {"analysis": analysis, "output": {"vtu": False}}


def variants(deck: Tree) -> dict[str, Tree]:
    """The same in other words; what speaks of axes (boxes, beds, depths, held components) is only shifted level."""
    text = json.dumps(deck)
    found = {
        "millimetres": in_units(deck, "mm", "kN", "t"),
        "feet": in_units(deck, "ft", "lbf", "lb"),
        "unreduced": deck | {"analysis": deck["analysis"] | {"reductions": False}},
    }
    if '"copy"' not in text:
        found["copies"] = copies_written_out(deck)
    if '"index"' not in text and "glued" not in text:
        found["shuffled"] = shuffled(deck, 1)
    if '"box": [' in text:
        return found
    level = any(word in text for word in ('"orientation": "', "per_depth", '"pattern"', '"fixed"'))
    axis, degrees = ((0, 0, 1), 33.0) if level else ((1, 2, -1), 33.0)
    degrees = 0.0 if '"fixed"' in text else degrees
    found["moved"] = placed(deck, axis, degrees, (3.0, -2.0, 0.0 if level else 1.5))
    found["far_away"] = placed(deck, axis, 0.0, (1e5, -3e4, 0.0 if level else 2e4))
    return found


def placed(deck: Tree, axis: tuple[float, float, float], degrees: float, shift: tuple[float, float, float]) -> Tree:
    """Turned and shifted."""
    return moved(deck, rotation(axis, degrees), {"axis": list(axis), "angle": degrees}, shift)


def compare(first: Run, run: Run, name: str, same: float) -> None:
    """Exit status, statuses, load factors and angles."""
    assert run.code == first.code, (name, run.errors)
    for one, other in zip(first.cases, run.cases, strict=True):
        assert other["status"] == one["status"], name
        for key, rel, nothing in (("load_factor", same, NOTHING), ("angle", 0.0, SAME_ANGLE)):
            before, after = (math.nan if case[key] is None else float(case[key]) for case in (one, other))
            assert after == pytest.approx(before, rel=rel, abs=nothing, nan_ok=True), (name, key)


@pytest.mark.parametrize(
    "seed",
    [
        *(pytest.param(seed, marks=pytest.mark.long) for seed in INVARIANT[::4]),
        *(pytest.param(seed, marks=pytest.mark.trust) for seed in INVARIANT if seed not in INVARIANT[::4]),
    ],
)
def test_other_words_have_the_same_answer(seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = associative_deck(seed)
    first = run_deck(write_deck(deck, tmp_path), capsys)
    for name, other in variants(deck).items():
        compare(first, run_deck(write_deck(other, tmp_path, name), capsys), name, SAME)


@pytest.mark.long
@pytest.mark.parametrize("number", [1, 3, 5])
def test_published_walls_in_other_words(number: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Walls of Ferris and Tin-Loi, brick by brick: to 1e-7, in their plane and in space, small and large, anywhere."""
    courses = ferris_tin_loi(number)
    bricks = [{"min": [b.left, 0, b.bottom], "max": [b.right, 0.2, b.top]} for b in wall(courses)]
    deck: Tree = {
        "mbla": 1,
        "materials": {"stone": {"density": 2000}},
        "joints": {"dry": {"friction": 0.65}},
        "blocks": [{"box": {"group": "wall", "material": "stone"} | brick} for brick in bricks],
        "contacts": {"joint": "dry"},
        "supports": [{"ground": {"z": 0}}],
        "load_cases": {"push": {"live": [{"acceleration": [1, 0, 0]}]}},
        "analysis": {"flow_rule": "associative", "accuracy": "reference"},
        "output": {"vtu": False},
    }
    light = deck | {"materials": {"stone": {"density": 2e-6}}}
    others = variants(deck) | {
        "light, in millimetres": in_units(light, "mm", "kN", "t"),
        "shuffled, turned": shuffled(placed(deck, (0.3, -1.0, 0.4), -141.0, (3.0, -7.0, 2.0)), 2),
    }
    first = run_deck(write_deck(deck, tmp_path), capsys)
    assert first.cases[0]["load_factor"] == pytest.approx(wall_load_factor(courses, 0.65), rel=SHARP)
    for name, other in others.items():
        compare(first, run_deck(write_deck(other, tmp_path, name.replace(" ", "_")), capsys), name, SHARP)
