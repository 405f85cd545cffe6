from dataclasses import replace

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.results.listing.mechanism_words import mechanism_lines, mechanism_summary
from mbla.results.listing.text import MOST_ROWS, WIDTH
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities
from tests.results.synthetic import cuboids, horizontal_contacts, tower_contacts, tower_mechanics, tower_model

MODEL, CONTACTS, MECHANICS = tower_model(), tower_contacts(), tower_mechanics()
CASE = MODEL.load_cases[0]


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
    collapse = collapse_of(MODEL, contacts, CASE, mechanics)
    return words(mechanism_lines(MODEL, contacts, failure_of(MODEL, contacts, collapse, mechanics)))


def summary(contacts: Contacts, mechanics: Mechanics) -> str:
    collapse = collapse_of(MODEL, contacts, CASE, mechanics)
    return mechanism_summary(MODEL, collapse, failure_of(MODEL, contacts, collapse, mechanics))


def test_a_hinge_is_named_with_its_axis() -> None:
    assert summary(CONTACTS, MECHANICS) == "1 hinge; 1 of 2 free blocks moves"
    assert "base[0]/tower[0] 1/0 (1, 0, 1) 1 +y +x" in tables(CONTACTS, MECHANICS)


def test_a_slide_is_named_with_its_direction_and_work() -> None:
    mechanics = sliding_brick()
    assert summary(CONTACTS, mechanics) == "sliding at 1 interface; 1 of 2 free blocks moves"
    text = tables(CONTACTS, mechanics)
    assert "ground z = 0/brick[0] 1/0 (4.5, 0.5, 0) (0.8, 0.6, 0) 1 100.0" in text
    assert "1: brick[0] moves along (0.8, 0.6, 0)" in text


def test_what_moves_slides_over_what_rests() -> None:
    """Bodies swapped: the ground comes second, and the brick is still what slides."""
    bodies, normals = CONTACTS.bodies.copy(), CONTACTS.normals.copy()
    frames = CONTACTS.frames.copy()
    bodies[1], normals[1] = [2, 3], [0, 0, -1]
    frames[4:, 0], frames[4:, 1] = [0, 0, -1], [-1, 0, 0]
    swapped = replace(CONTACTS, bodies=bodies, normals=normals, frames=frames)
    mechanics = sliding_brick()
    velocities = contact_velocities(MODEL, swapped, mechanics.mechanism)
    text = tables(swapped, replace(mechanics, contact_velocities=velocities))
    assert "brick[0]/ground z = 0 1/0 (4.5, 0.5, 0) (0.8, 0.6, 0)" in text


def test_long_lists_start_with_what_moves_most_and_say_what_they_leave_out() -> None:
    n = 60
    lower = np.array([[0, 0, i] for i in range(n)], float)
    model = replace(MODEL, blocks=cuboids(lower, lower + 1, ["stack"] * n), fixed=np.arange(n) == 0, grounds=())
    contacts = horizontal_contacts([[i, i + 1] for i in range(n - 1)], [(0, 1, 0, 1, i + 1) for i in range(n - 1)])
    mechanism = np.zeros((n, 6))
    mechanism[:, 0] = np.arange(n) ** 2.0  # each slides on the one below, the upper ones faster
    velocities = contact_velocities(model, contacts, mechanism)
    mechanics = replace(
        MECHANICS,
        mechanism=mechanism,
        contact_velocities=velocities,
        contact_forces=np.tile([1.0, -1.0, 0.0], (len(velocities), 1)),
        modes=np.full(4 * (n - 1), ContactMode.SLIDE),
    )
    case = replace(CASE, dead_load=np.zeros((n, 6)), live_load=np.ones((n, 6)))
    collapse = collapse_of(model, contacts, case, mechanics)
    failure = failure_of(model, contacts, collapse, mechanics)
    lines = mechanism_lines(model, contacts, failure)
    assert max(map(len, lines)) <= WIDTH
    start = next(i for i, line in enumerate(lines) if line.startswith("  sliding planes"))
    table = lines[start + 1 :]
    assert len(table) == MOST_ROWS + 1
    assert table[0].split()[0] == f"stack[{n - 2}]/[{n - 1}]"
    assert "more that move less; the result files hold them all" in table[MOST_ROWS]
    text = mechanism_summary(model, collapse, failure)
    assert text == "59 of 59 free blocks move, mainly as one rigid part; sliding at 59 interfaces"
