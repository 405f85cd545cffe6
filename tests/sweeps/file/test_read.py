"""What the reader of sweep files accepts, and what it does with files; its words are in tests/invalid_sweeps."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.sweeps.file.content import MAX_POINTS
from mbla.sweeps.file.parts import design_parts, is_random
from mbla.sweeps.file.read import Sweep, read_sweep
from tests.deck.decks import BLOCK, write
from tests.sweeps.file.sweeps import ALL_WAYS, GOOD, base_of


def sweep_of(folder: Path, text: str) -> Sweep:
    return read_sweep(write(folder, text, "sweep.yaml"), ("title=x",))


def faults(folder: Path, text: str | bytes) -> list[str]:
    path = folder / "sweep.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(DeckError) as caught:
        read_sweep(path)
    return [str(fault).removeprefix(f"{path}:") for fault in caught.value.faults]


def test_values_keep_their_kinds(tmp_path: Path) -> None:
    text = GOOD.replace("[0.1, 0.15, 0.2]", '[1, 2.0, 1e-3, "1", no, true, "=mu", [0, 1]]')
    values = sweep_of(tmp_path, text).content.parameters["t"].values
    assert values == [1, 2.0, 0.001, "1", "no", True, "=mu", [0, 1]]
    assert [type(each) for each in values] == [int, float, float, str, str, bool, str, list]


def test_parts_of_the_design(tmp_path: Path) -> None:
    content = sweep_of(tmp_path, ALL_WAYS).content
    parts = design_parts(content)
    assert [(part.kind, part.parameters, part.points, part.seed) for part in parts] == [
        ("grid", ("mu", "law"), 0, None),
        ("zip", ("t", "n"), 0, None),
        ("random", ("joints.dry.cohesion",), 4, 7),
        ("latin_hypercube", ("tension", "g"), 4, 1),
        ("sobol", ("density", "radius"), 4, 1),
        ("grid", ("d",), 0, None),
    ]
    assert [is_random(part, content) for part in parts] == [False, False, True, True, True, False]


@pytest.mark.parametrize(
    ("points", "accepted"), [("n: {whole: {from: 1, to: 1000}}", True), ("n: {whole: {from: 1, to: 1001}}", False)]
)
def test_the_number_of_points_is_that_of_the_product(tmp_path: Path, points: str, accepted: bool) -> None:
    assert MAX_POINTS == 1000 * 1000
    text = f"mbla_sweep: 1\ndeck: d.yaml\nparameters:\n  m: {{whole: {{from: 1, to: 1000}}}}\n  {points}\n"
    if accepted:
        sweep_of(tmp_path, text)
    else:
        assert faults(tmp_path, text) == [
            "3:1 parameters: makes 1001000 points, at most 1000000 are taken: a sample needs fewer"
        ]


def test_a_sweep_file_is_no_deck(tmp_path: Path) -> None:
    path = write(tmp_path, GOOD, "sweep.yaml")
    with pytest.raises(DeckError) as caught:
        read_deck(path)
    assert str(caught.value) == f"{path}:1:1 mbla_sweep = 1: this is a sweep file, not a deck: mbla sweep runs it"


def test_a_sweep_file_is_no_deck_of_another(tmp_path: Path) -> None:
    with pytest.raises(DeckError) as caught:
        base_of(tmp_path, GOOD, deck=GOOD)
    assert str(caught.value).startswith(f"{tmp_path}/deck.yaml:1:1 mbla_sweep = 1: this is a sweep file, not a deck")


def test_a_deck_is_no_sweep_file(tmp_path: Path) -> None:
    (line,) = faults(tmp_path, BLOCK)
    assert line.startswith("1:1 mbla = 1: this is a deck, not a sweep file: mbla run solves it")


def test_fragility_takes_a_random_part_beside_a_grid(tmp_path: Path) -> None:
    text = GOOD.replace("  t: {", "  r: {uniform: {from: 0, to: 1}}\n  t: {")
    text += "design:\n  - grid: {of: [mu, t]}\n  - random: {points: 4}\nfragility: {demand: [0.1]}\n"
    assert sweep_of(tmp_path, text).content.fragility is not None
