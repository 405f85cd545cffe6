"""What modes leave out of a structure on soft joints."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.errors import Message
from mbla.model import build_model
from mbla.solution.modes.checked import checked_modes_of
from mbla.solution.modes.modes import Modes

DECK = """mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.8, stiffness: {{normal: {stiffness}, ratio: 0.4}}}}}}
blocks: [{{box: {{group: b, material: stone, min: [0, 0, 0], max: [0.5, 1, 2]}}}}]
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases: {{rest: {{modes: 2}}}}
"""


def modes(folder: Path, stiffness: float) -> tuple[Modes, tuple[Message, ...]]:
    path = folder / "deck.yaml"
    path.write_text(DECK.format(stiffness=stiffness))
    deck = read_deck(path)
    model = build_model(deck)
    return checked_modes_of(build_assembly(deck, model), model.load_cases[0], 2)


def test_of_stiff_joints_nothing_is_said(tmp_path: Path) -> None:
    found, remarks = modes(tmp_path, 1e9)
    assert found.verified
    assert remarks == ()


def test_soft_joints_are_told_with_the_share_that_weight_takes(tmp_path: Path) -> None:
    """A sag of ρ g H/k = 0.0039 m, of which 6 s H/B² = 18.8 %."""
    found, (remark,) = modes(tmp_path, 1e7)
    assert found.verified
    assert remark.identifier == "modes-soft"
    assert "takes about 19 % of its stiffness" in remark.words


@pytest.mark.parametrize(("stiffness", "share"), [(1.8e6, "1"), (1e6, "1.9")])
def test_modes_of_what_does_not_stand_on_its_joints_are_not_verified(
    tmp_path: Path, stiffness: float, share: str
) -> None:
    found, remarks = modes(tmp_path, stiffness)
    assert not found.verified
    assert [remark.identifier for remark in remarks] == ["modes-not-verified", "modes-soft"]
    assert f"its weight takes about {share} of its stiffness" in remarks[0].words
