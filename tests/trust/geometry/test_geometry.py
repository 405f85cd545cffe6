"""Every broken geometry file is refused with a diagnosis, or gives the result of the file that is not broken."""

from __future__ import annotations

import json
import struct
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from tests.trust.counts import record_counts
from tests.trust.geometry.formats import FORMATS, Format
from tests.trust.geometry.judging import DECK, SECONDS, Outcome, differences, outcome, refusal_defects
from tests.trust.geometry.mutants import Mutant, mutants
from tests.trust.geometry.shapes import REFUSED, SAME, TOLD
from tests.trust.geometry.stones import arch
from tests.trust.processes import Commands

OF_TRIANGLES = (
    "`mbla check` reads a block of a million triangles as the cuboid that it is, and refuses it by face and edge "
    "where one triangle is missing"
)
OF_MUTANTS = (
    "A broken geometry file is refused with its fault named, or mended and told, or gives the model of the sound "
    "file; what is left out of a file is told in a warning"
)
BROKEN_ONCE = Path(__file__).parent / "broken_once"
SHORT = 100
"""every so-many-th mutant of those that must be refused is in the short form"""
SIDES = 289
"""squares along an edge of a block: 12 x 289 x 289 = 1,002,252 triangles"""
HUGE_SECONDS, HUGE_MB = 1800, 4096.0
"""of the processor, and resident"""


def verdict(mutant: Mutant, found: Outcome, sound: Outcome) -> tuple[str, list[str]]:
    """What came of a mutant (``refused``, ``same`` or ``told``), and what is wrong with that."""
    defects = [f"took {found.seconds:.0f} s"] if found.seconds > SECONDS else []
    if found.figures is None:
        wrong = [f"refused: {found.faults}"] if mutant.expect is SAME else []
        return "refused", defects + wrong + refusal_defects(found)
    if mutant.expect is REFUSED:
        return "same", [*defects, f"was taken: {found.figures}, {set(found.notices)}"]
    silent = bool(mutant.told) and not found.notices & mutant.told
    if mutant.expect is TOLD:
        return "told", [*defects, *([f"nothing said: {set(found.notices)}"] if silent else [])]
    other = differences(found, sound, mutant.tolerance, mutant.scale)
    if silent:
        defects.append(f"not said what was done: {set(found.notices)}")
    return "same", defects + other


@cache
def sound_outcome(kind: Format, folder: Path) -> Outcome:
    """What comes of the arch in a file that is not broken."""
    return outcome(folder / f"sound {kind.name}".replace(" ", "_"), kind.item, kind.write(arch()), solve=True)


def findings(chosen: list[Mutant], folder: Path) -> tuple[Counter[str], list[str]]:
    """How many came to what, and every defect.

    What must be refused or be the same is run; of the others the model is enough, and what is said of it.
    """
    counts: Counter[str] = Counter()
    defects = []
    for number, mutant in enumerate(chosen):
        solve = mutant.expect in (SAME, REFUSED)
        found = outcome(folder / str(number), mutant.kind.item, mutant.files, solve=solve)
        sound = Outcome(3, (), 0.0, False) if mutant.expect is REFUSED else sound_outcome(mutant.kind, folder)
        came, wrong = verdict(mutant, found, sound)
        counts[came] += 1
        counts["solved"] += solve and came == "same"
        defects += [f"{mutant.title}: {defect}" for defect in wrong]
    return counts, defects


@pytest.mark.parametrize("path", sorted(BROKEN_ONCE.iterdir()), ids=lambda path: path.name)
def test_a_file_that_broke_the_program_once(path: Path, tmp_path: Path) -> None:
    item = f"mesh: {{group: stone, material: stone, file: {path.name}}}"
    found = outcome(tmp_path, item, {path.name: path.read_bytes()}, solve=False)
    assert found.figures is not None or refusal_defects(found) == []


@pytest.mark.long
def test_some_mutants(tmp_path: Path) -> None:
    """Some that must be refused, of every format, and one that is mended and solved."""
    everything = [mutant for mutant in mutants() if mutant.expect is REFUSED][::SHORT]
    assert len({mutant.kind.name for mutant in everything}) >= 8
    counts, defects = findings(everything, tmp_path)
    assert defects == []
    assert counts["refused"] == len(everything)


@pytest.mark.long
def test_a_mended_file_gives_the_result_of_the_sound_one(tmp_path: Path) -> None:
    chosen = [mutant for mutant in mutants() if mutant.title == "obj: faces turned at random"]
    counts, defects = findings(chosen, tmp_path)
    assert defects == []
    assert counts["solved"] == 1


def test_the_judge_sees_what_is_wrong() -> None:
    """A check that cannot fail is none: each way of being wrong is found."""
    sound = Outcome(0, (), 0.1, True, frozenset(), None, {"blocks": 9, "load_factor": 0.4})
    mutant = next(each for each in mutants() if each.title == "obj: face turned")
    said = frozenset({"faces-turned-outwards"})
    same = Outcome(0, (), 0.1, True, said, None, dict(sound.figures or {}))
    assert verdict(mutant, same, sound) == ("same", [])
    for found in (
        Outcome(0, (), 0.1, True, frozenset(), None, sound.figures),  # mended without a word
        Outcome(0, (), 0.1, True, said, None, {"blocks": 8, "load_factor": 0.4}),
        Outcome(0, (), 0.1, True, said, None, {"blocks": 9, "load_factor": 0.41}),
        Outcome(0, (), 99.0, True, said, None, sound.figures),
        Outcome(3, ("deck.yaml:5:3 blocks[0].mesh: block mesh[0]: face 3 has no area",), 0.1, False),
    ):
        assert verdict(mutant, found, sound)[1]
    hole = next(each for each in mutants() if each.title == "obj: face missing")
    line = "deck.yaml:5:3 blocks[0].mesh: block mesh[0]: is not closed: 3 edges have one face only, face 3"
    assert verdict(hole, Outcome(3, (line,), 0.1, False), sound) == ("refused", [])
    for found in (
        same,
        Outcome(1, (line,), 0.1, False),
        Outcome(3, (), 0.1, False),
        Outcome(3, (line,), 0.1, True),
        Outcome(3, ("Traceback (most recent call last):",), 0.1, False),
        Outcome(3, ("deck.yaml:5:3 blocks[0].mesh: bad file",), 0.1, False),
    ):
        assert verdict(hole, found, sound)[1]


def cube(n: int) -> FloatArray:
    """Triangles of the unit cube, n x n squares to a face, (12 n², 3, 3)."""
    ticks = np.arange(n + 1, dtype=np.float64) / n
    u, v = (each.ravel() for each in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    squares = np.stack(
        [np.stack([ticks[u + a], ticks[v + b]], axis=1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=1
    )
    flat = np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])
    faces = []
    for axis in range(3):
        for side in (0.0, 1.0):
            corners = np.insert(flat, axis, side, axis=2)
            faces.append(corners if (side == 1.0) != (axis == 1) else corners[:, ::-1])
    return np.concatenate(faces)


def write(folder: Path, triangles: FloatArray) -> Path:
    """A binary STL file and its deck; the path of the deck."""
    folder.mkdir(parents=True, exist_ok=True)
    records = np.zeros(len(triangles), dtype=[("numbers", "<f4", 12), ("attribute", "<u2")])
    records["numbers"][:, 3:] = triangles.reshape(-1, 9)
    (folder / "huge.stl").write_bytes(b" " * 80 + struct.pack("<I", len(triangles)) + records.tobytes())
    deck = folder / "deck.yaml"
    deck.write_text(DECK.format(item="mesh: {material: stone, file: huge.stl}"), encoding="utf-8")
    return deck


@pytest.mark.trust
def test_a_million_triangles(tmp_path: Path) -> None:
    """One block of a million triangles is the cuboid that it is; without one of them it is refused."""
    triangles = cube(SIDES)
    assert np.linalg.det(triangles).sum() / 6 == pytest.approx(1.0)
    with Commands(("mbla.check",), {"RLIMIT_CPU": HUGE_SECONDS}) as running:
        whole = running.run("check", "--json", write(tmp_path / "whole", triangles))
        hole = running.run("check", "--json", write(tmp_path / "open", triangles[:-1]))
    assert whole.status == 0, whole.err
    model = json.loads(whole.out)["model"]
    assert (model["blocks"], model["interfaces"]) == (1, 1)
    assert model["total_volume"] == pytest.approx(1.0, rel=1e-6)
    assert hole.status == 3
    assert "is not closed: 3 edges" in hole.err
    memory = max(whole.memory, hole.memory)
    assert memory < HUGE_MB
    counted = {
        "triangles": len(triangles),
        "seconds for the whole block": round(whole.seconds),
        "seconds for the open one": round(hole.seconds),
        "MB at most": round(memory),
    }
    record_counts("million-triangles", 4, OF_TRIANGLES, counted)


@pytest.mark.trust
def test_every_mutant(tmp_path: Path) -> None:
    chosen = list(mutants())
    assert len(chosen) >= 200
    assert {mutant.kind.name for mutant in chosen} == set(FORMATS)
    counts, defects = findings(chosen, tmp_path)
    assert defects == []
    counted = {
        "mutated files": len(chosen),
        "kinds of files": len(FORMATS),
        "refused by name": counts["refused"],
        "with the model of the sound file": counts["same"],
        "of these solved, with its load factor": counts["solved"],
        "with a warning of what is missing": counts["told"],
        "tracebacks, hangs, silent differences": len(defects),
    }
    record_counts("broken-geometry", 4, OF_MUTANTS, counted)
