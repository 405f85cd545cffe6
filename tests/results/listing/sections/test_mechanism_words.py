"""Sentences and tables of a failure, on the wall of the tutorial and on results made by hand."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.results.listing.blocks import MOST_ROWS
from mbla.results.listing.sections.mechanism_words import failure_sentences, mechanism_blocks, mechanism_summary
from mbla.results.listing.text import WIDTH, lines_of
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities
from tests.line import line_of_file, verified
from tests.results.synthetic import cuboids, horizontal_contacts, tower_contacts, tower_mechanics, tower_model

WALL = Path("decks/tutorials/wall.yaml")
MODEL, CONTACTS, MECHANICS = tower_model(), tower_contacts(), tower_mechanics()
CASE = MODEL.load_cases[0]


def sentences(case: int, *overrides: str) -> list[str]:
    line = line_of_file(WALL, *overrides, case=case)
    mechanics = verified(line)[0].mechanics
    assert mechanics is not None
    collapse = collapse_of(line.assembly, line.load_case, mechanics)
    failure = failure_of(line.model, line.contacts, collapse, mechanics)
    return failure_sentences(line.model, line.load_case, collapse, failure)


def test_the_wall_of_the_tutorial() -> None:
    """What a reader needs to draw it: which part, how it turns and where about."""
    assert sentences(0) == [
        "The mechanism is partial, 20.8 % of the weight: 12 of 52 free blocks move as one rigid part.",
        "Part 1 (12 blocks of wall, x 2.2 .. 3.2, z 0.2 .. 1.4 m, 20.8 % of the weight) turns about "
        "+y at (3.2, 0.125, 0.2), its centroid moving along (0.88, 0, 0.47).",
    ]
    assert sentences(1)[1].startswith("Everything that is free (52 blocks) turns about -x at (1.6, 0.25, 0), its")


def test_a_mechanism_in_which_nothing_moves_is_told_in_one_sentence() -> None:
    contacts = tower_contacts()
    still = replace(
        tower_mechanics(),
        mechanism=np.zeros((3, 6)),
        contact_velocities=np.zeros((8, 3)),
        modes=np.zeros(8, dtype=np.int64),
    )
    collapse = collapse_of(Assembly(MODEL, contacts), CASE, still)
    failure = failure_of(MODEL, contacts, collapse, still)
    assert failure_sentences(MODEL, CASE, collapse, failure) == ["No block moves."]


def words(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def sliding_brick() -> Mechanics:
    mechanism = np.zeros((3, 6))
    mechanism[2, :2] = [0.08, 0.06]
    velocities = contact_velocities(MODEL, CONTACTS, mechanism)
    modes = np.array([ContactMode.STICK] * 4 + [ContactMode.SLIDE] * 4)
    forces = np.zeros((8, 3))
    forces[4:] = [2.5, -1.3, -0.975]
    mechanics = replace(
        MECHANICS, mechanism=mechanism, contact_velocities=velocities, modes=modes, contact_forces=forces
    )
    return replace(mechanics, load_factor=0.8125)


def tables(contacts: Contacts, mechanics: Mechanics) -> str:
    assembly = Assembly(MODEL, contacts)
    collapse = collapse_of(assembly, CASE, mechanics)
    return words(lines_of(mechanism_blocks(assembly, CASE, failure_of(MODEL, contacts, collapse, mechanics))))


def summary(contacts: Contacts, mechanics: Mechanics) -> str:
    collapse = collapse_of(Assembly(MODEL, contacts), CASE, mechanics)
    return mechanism_summary(MODEL, collapse, failure_of(MODEL, contacts, collapse, mechanics))


def test_a_slide_is_named_with_its_direction_and_work() -> None:
    mechanics = sliding_brick()
    assert summary(CONTACTS, mechanics) == "sliding at 1 interface; 1 of 2 free blocks moves as one rigid part"
    text = tables(CONTACTS, mechanics)
    assert "ground z = 0/brick[0] 1/0 (4.5, 0.5, 0) (0.8, 0.6, 0) 1 100.0" in text
    assert "1: brick[0] moves along (0.8, 0.6, 0)" in text


def test_long_lists_start_with_what_moves_most_and_say_what_they_leave_out() -> None:
    n = 60
    lower = np.array([[0, 0, i] for i in range(n)], float)
    model = replace(MODEL, blocks=cuboids(lower, lower + 1, ["stack"] * n), fixed=np.arange(n) == 0, grounds=())
    contacts = horizontal_contacts([[i, i + 1] for i in range(n - 1)], [(0, 1, 0, 1, i + 1) for i in range(n - 1)])
    mechanism = np.zeros((n, 6))
    mechanism[:, 0] = np.where(np.arange(n) > 0, (-1.0) ** np.arange(n) * (100 + np.arange(n)), 0.0)  # to and fro
    velocities = contact_velocities(model, contacts, mechanism)
    mechanics = replace(
        MECHANICS,
        mechanism=mechanism,
        contact_velocities=velocities,
        contact_forces=np.tile([1.0, -1.0, 0.0], (len(velocities), 1)),
        modes=np.full(4 * (n - 1), ContactMode.SLIDE),
    )
    case = replace(CASE, dead_load=np.zeros((n, 6)), live_load=np.ones((n, 6)))
    assembly = Assembly(model, contacts)
    collapse = collapse_of(assembly, case, mechanics)
    failure = failure_of(model, contacts, collapse, mechanics)
    lines = lines_of(mechanism_blocks(assembly, case, failure))
    assert max(map(len, lines)) <= WIDTH
    start = next(i for i, line in enumerate(lines) if line.startswith("  sliding planes"))
    table = lines[start + 1 :]
    assert len(table) == MOST_ROWS + 1
    assert "more; the result files hold them all" in table[MOST_ROWS]
    text = mechanism_summary(model, collapse, failure)
    assert text == "sliding at 59 interfaces; 59 of 59 free blocks move mainly in 2 rigid parts"
