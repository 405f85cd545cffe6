"""Every deck stands before its live load, save those that show what has no equilibrium."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.contacts import find_contacts
from mbla.deck.analysis import ReductionSwitches
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.reductions import reduce_program
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing
from mbla.solution.standing import assess_standing, worst_standing
from tests.decks.folder import PATHS, deck_of, name_of

every_deck = pytest.mark.parametrize("path", PATHS, ids=[name_of(path) for path in PATHS])


@every_deck
def test_decks_stand_unless_they_say_that_they_do_not(path: Path) -> None:
    deck = deck_of(path)
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    settings = SolverSettings(tolerance=1e-8)
    for load_case in model.load_cases:
        program = assemble(model, contacts, load_case)
        reduced = reduce_program(model, contacts, program, ReductionSwitches(), associative=False)
        falls = deck.content.expected[load_case.name].status == "no_equilibrium"
        found = worst_standing([assess_standing(part, settings, carried=not falls) for part in reduced.parts])
        assert found.verdict is (Standing.NO if falls else Standing.YES), (load_case.name, found)
