"""What is wrong with modes is seen, one thing at a time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.assembly.assembly import Assembly
from mbla.assembly.structure_at import StructureAt
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import LoadCase
from mbla.solution.modes.find import modes_of
from mbla.solution.modes.modes import Modes
from mbla.solution.verification.modes import checked_modes

DECKS = Path(__file__).parents[3] / "decks"
DECK = DECKS / "tutorials" / "arch_on_piers.yaml"


@pytest.fixture(scope="module", name="arch")
def found() -> tuple[Assembly, LoadCase, Modes]:
    deck = read_deck(DECK)
    model = build_model(deck)
    assembly, case = build_assembly(deck, model), model.load_cases[0]
    return assembly, case, modes_of(StructureAt.as_built(assembly, case), 4)


def test_a_mode_that_is_left_out_is_missed(arch: tuple[Assembly, LoadCase, Modes]) -> None:
    assembly, case, modes = arch
    rows = [0, 1, 3]
    kept = {name: getattr(modes, name)[rows] for name in ("periods", "shapes", "masses")}
    checked, wrong = checked_modes(StructureAt.as_built(assembly, case), replace(modes, **kept))
    assert not checked.verified
    assert wrong == ("1 mode of a longer period than the shortest is left out",)


def test_modes_are_verified(arch: tuple[Assembly, LoadCase, Modes]) -> None:
    assembly, case, modes = arch
    checked, wrong = checked_modes(StructureAt.as_built(assembly, case), modes)
    assert wrong == ()
    assert checked.verified
    assert checked.residual < 1e-9
    assert ((checked.pressed > 0.0) & (checked.pressed < 1.0)).any()


@pytest.mark.parametrize(
    ("name", "changed", "words"),
    [
        ("periods", lambda modes: modes.periods * 1.001, "without balance"),
        ("shapes", lambda modes: modes.shapes[[1, 1, 2, 3]], "without balance"),
        ("shapes", lambda modes: np.where(np.arange(6) == 2, modes.shapes + 1e-3, modes.shapes), "without balance"),
        ("masses", lambda modes: modes.masses + 1e-3, "masses that take part"),
        ("settlement", lambda modes: 1.01 * modes.settlement, "at rest"),
        ("stiffness", lambda modes: 2.0 * modes.stiffness, "not as stiff as the deck says"),
        ("default", lambda modes: 2.0 * modes.default, "not as stiff as the deck says"),
        ("pressed", lambda modes: np.where(modes.pressed > 0.0, 0.0, 1.0), "said to press that are open"),
    ],
)
def test_what_is_changed_is_found(
    arch: tuple[Assembly, LoadCase, Modes], name: str, changed: object, words: str
) -> None:
    assembly, case, modes = arch
    assert callable(changed)
    checked, wrong = checked_modes(StructureAt.as_built(assembly, case), replace(modes, **{name: changed(modes)}))
    assert not checked.verified
    assert any(words in each for each in wrong)


@pytest.mark.parametrize("name", ["structures/spiral_stair", "tutorials/dome", "benchmarks/closed_forms/tied_wall"])
def test_modes_of_other_structures_are_verified(name: str) -> None:
    """Interfaces that are not convex and press in part, modes of one frequency, ties."""
    deck = read_deck(DECKS / f"{name}.yaml")
    model = build_model(deck)
    assembly, case = build_assembly(deck, model), model.load_cases[0]
    checked, wrong = checked_modes(
        StructureAt.as_built(assembly, case), modes_of(StructureAt.as_built(assembly, case), 6)
    )
    assert wrong == ()
    assert checked.residual < 1e-9
