"""Fixing what rests leaves the load factor: the smaller model is built and solved."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import find_contacts
from mbla.errors import MblaError
from mbla.program import assemble
from mbla.results.collapse.force_freedom import enough_of
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.solution.solution import Mechanics, Status
from tests.line import Line, line_of, line_of_file, verified
from tests.properties.random_decks import random_deck
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

DECKS = Path("decks")
ASSOCIATIVE = "analysis.flow_rule=associative"


def solved(line: Line) -> Mechanics:
    solution, checks, _ = verified(line)
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    return solution.mechanics


def with_rest_fixed(line: Line, mechanics: Mechanics) -> tuple[Line, int]:
    """The same line with every block at rest fixed, and how many free blocks are left."""
    parts = rigid_parts(line.model, line.contacts, mechanics.mechanism)
    guides = line.model.guides
    guided = parts[guides.blocks] > 0
    bodies = np.unique(guides.bodies[guided], return_inverse=True)[1].astype(np.int64)
    guides = replace(guides, blocks=guides.blocks[guided], bodies=bodies, motions=guides.motions[guided])
    model = replace(line.model, fixed=line.model.fixed | (parts == 0), guides=guides)
    contacts = find_contacts(model, line.deck.contacts)
    enough = enough_of(line.model, line.contacts, parts)
    assert len(contacts) == len(enough.interfaces)
    assert len(model.free) == len(enough.moving)
    assert len(enough.moving) + len(enough.bearing) + len(enough.left_out) == len(line.model.free)
    return replace(line, model=model, contacts=contacts, program=assemble(model, contacts, line.load_case)), len(
        model.free
    )


@pytest.mark.parametrize(
    ("deck", "overrides"),
    [
        ("tutorials/wall.yaml", ()),
        ("tutorials/arch.yaml", ()),
        ("tutorials/buttressed_wall.yaml", ()),
        ("benchmarks/published/ferris_wall_1.yaml", ()),
        ("benchmarks/published/ferris_wall_3.yaml", ()),
        ("benchmarks/closed_forms/wall_5x5.yaml", ()),
        ("benchmarks/closed_forms/block_sliding.yaml", ()),
    ],
)
def test_associative_flow_has_the_same_load_factor_with_the_rest_fixed(deck: str, overrides: tuple[str, ...]) -> None:
    line = line_of_file(DECKS / deck, ASSOCIATIVE, *overrides)
    mechanics = solved(line)
    smaller, _ = with_rest_fixed(line, mechanics)
    assert solved(smaller).load_factor == pytest.approx(mechanics.load_factor, rel=1e-6)


def test_some_of_these_have_something_to_leave_out() -> None:
    line = line_of_file(DECKS / "tutorials/wall.yaml", ASSOCIATIVE)
    mechanics = solved(line)
    _, left = with_rest_fixed(line, mechanics)
    assert left < len(line.model.free) / 2


def test_fixing_what_moves_does_change_it() -> None:
    """Without the heaviest part to move nothing can: the blocks left are locked between fixed ones."""
    line = line_of_file(DECKS / "benchmarks/published/ferris_wall_1.yaml", ASSOCIATIVE)
    mechanics = solved(line)
    parts = rigid_parts(line.model, line.contacts, mechanics.mechanism)
    heaviest = np.flatnonzero(parts == 1)
    model = replace(line.model, fixed=line.model.fixed | np.isin(np.arange(len(parts)), heaviest))
    contacts = find_contacts(model, line.deck.contacts)
    other = replace(line, model=model, contacts=contacts, program=assemble(model, contacts, line.load_case))
    solution, checks, status = verified(other)
    assert (status, checks.verified, solution.mechanics) == (Status.UNBOUNDED, True, None)


def test_blocks_by_what_they_do_for_what_moves() -> None:
    """The tower turns on its base, which is fixed; the brick rests by itself."""
    model, contacts = tower_model(), tower_contacts()
    enough = enough_of(model, contacts, rigid_parts(model, contacts, tower_mechanics().mechanism))
    assert enough.moving.tolist() == [1]
    assert enough.interfaces.tolist() == [0]
    assert enough.bearing.tolist() == []
    assert enough.left_out.tolist() == [2]


def same_with_rest_fixed(seed: int) -> bool:
    """Whether the deck had a verified answer; it must be that of the smaller model too."""
    deck = random_deck(seed) | {"output": {"vtu": False}, "analysis": {"flow_rule": "associative"}}
    try:
        line = line_of("\n" + json.dumps(deck))
    except MblaError:  # some say what cannot be
        return False
    if not len(line.contacts) or len(line.model.blocks) > 60 or not line.load_case.live_load[line.model.free].any():
        return False
    solution, _, status = verified(line)
    if status is not Status.SOLVED or solution.mechanics is None:
        return False
    smaller, _ = with_rest_fixed(line, solution.mechanics)
    assert solved(smaller).load_factor == pytest.approx(solution.mechanics.load_factor, rel=1e-6, abs=1e-9), seed
    return True


def test_random_decks_have_the_same_load_factor_with_the_rest_fixed() -> None:
    assert sum(map(same_with_rest_fixed, range(12))) >= 4


@pytest.mark.long
def test_many_random_decks_have_the_same_load_factor_with_the_rest_fixed() -> None:
    assert sum(map(same_with_rest_fixed, range(12, 120))) >= 40
