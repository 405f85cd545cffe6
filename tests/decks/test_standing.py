"""Every deck stands before its live load, save those that show what has no equilibrium, or one by self-stress only."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model, solids_of
from mbla.model import build_model
from mbla.program import assemble
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing
from mbla.solution.standing.standing import assess_dead_load, worst_standing
from mbla.solution.trials import posed
from tests.decks.folder import deck_of, every_deck, name_of

pytestmark = pytest.mark.long


LOCKED_IN = ("benchmarks/closed_forms/bar_between_walls",)


@every_deck
def test_decks_stand_unless_they_say_that_they_do_not(path: Path) -> None:
    deck = deck_of(path)
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    solids = solids_of(held_model(model, contacts), contacts)
    model, contacts = solids.model, solids.contacts
    settings = SolverSettings(tolerance=1e-8)
    for case in model.load_cases:
        load_case = posed(model, contacts, case, settings)
        moving = model.of_case(load_case)
        program = assemble(moving, contacts, load_case)
        reduced = reduce_program(moving, contacts, program, ReductionSwitches(), associative=False)
        falls = deck.content.expected[load_case.deck_name].status == "no_equilibrium"
        found = worst_standing([assess_dead_load(part, settings, carried=not falls).standing for part in reduced.parts])
        stands = Standing.SELF_STRESS if name_of(path) in LOCKED_IN else Standing.YES
        assert found.verdict is (Standing.NO if falls else stands), (load_case.name, found)
