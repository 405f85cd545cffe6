"""What a check says that solving a load case needs."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.assembly import build_assembly
from mbla.check import needs_of
from mbla.deck import read_deck_text
from mbla.model import build_model
from tests.line import BLOCK

IN_TIME = (
    "modes: 3",
    "time_history: {motion: {pulse: sine, amplitude: 0.3 g, duration: 0.5, direction: x}}",
)


@pytest.mark.parametrize("asked", IN_TIME)
def test_a_load_case_in_time_needs_its_state_at_rest(asked: str) -> None:
    deck = read_deck_text(BLOCK.replace("live: [{acceleration: [1, 0, 0]}]", asked), Path("deck.yaml"))
    assembly = build_assembly(deck, build_model(deck))
    counts = needs_of(deck, assembly, assembly.model.load_cases[0]).counts
    assert counts["free_blocks"] == 1
    assert int(counts["matrix_entries"]) > 0
