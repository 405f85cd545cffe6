from dataclasses import replace

import numpy as np

from mbla.results.collapse.collapse import Collapse, collapse_of
from mbla.results.words.mechanism_words import MOST_ROWS, mechanism_lines, mechanism_summary
from mbla.results.words.text import WIDTH
from mbla.solution.solution import ContactMode
from mbla.solution.statics import contact_velocities
from tests.results.synthetic import cuboids, horizontal_contacts, tower_contacts, tower_mechanics, tower_model

MODEL, CONTACTS, MECHANICS = tower_model(), tower_contacts(), tower_mechanics()
CASE = MODEL.load_cases[0]


def words(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def sliding_brick() -> Collapse:
    mechanism = np.zeros((3, 6))
    mechanism[2, :2] = [0.08, 0.06]
    velocities = contact_velocities(MODEL, CONTACTS, mechanism)
    modes = np.array([ContactMode.STICK] * 4 + [ContactMode.SLIDE] * 4)
    forces = np.zeros((8, 3))
    forces[4:] = [2.5, -1.3, -0.975]
    mechanics = replace(
        MECHANICS, mechanism=mechanism, contact_velocities=velocities, modes=modes, contact_forces=forces
    )
    return collapse_of(MODEL, CONTACTS, CASE, replace(mechanics, load_factor=0.8125))


def test_a_hinge_is_named_with_its_axis() -> None:
    collapse = collapse_of(MODEL, CONTACTS, CASE, MECHANICS)
    assert mechanism_summary(MODEL, collapse) == "1 hinge; 1 of 2 free blocks moves"
    assert "base[0]/tower[0] 0/1 (1, 0.5, 1) +y +x side" in words(mechanism_lines(MODEL, CONTACTS, collapse))


def test_a_slide_is_named_with_its_direction_and_power() -> None:
    collapse = sliding_brick()
    assert mechanism_summary(MODEL, collapse) == "sliding at 1 interface; 1 of 2 free blocks moves"
    text = words(mechanism_lines(MODEL, CONTACTS, collapse))
    assert "brick[0] over ground z = 0 0/1 (4.5, 0.5, 0) (0.8, 0.6, 0) 100.0" in text
    assert "1: brick[0] moves along (0.8, 0.6, 0)" in text


def test_what_moves_slides_over_what_rests() -> None:
    """Bodies swapped: the ground comes second, and the brick is still what slides."""
    collapse = sliding_brick()
    bodies, normals = CONTACTS.bodies.copy(), CONTACTS.normals.copy()
    bodies[1], normals[1] = [2, 3], [0, 0, -1]
    swapped = replace(CONTACTS, bodies=bodies, normals=normals)
    turned = replace(collapse, interfaces=replace(collapse.interfaces, translation=-collapse.interfaces.translation))
    assert "brick[0] over ground z = 0 0/1 (4.5, 0.5, 0) (0.8, 0.6, 0)" in words(
        mechanism_lines(MODEL, swapped, turned)
    )


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
        contact_forces=np.ones_like(velocities),
        modes=np.full(4 * (n - 1), ContactMode.SLIDE),
    )
    case = replace(CASE, dead_load=np.zeros((n, 6)), live_load=np.ones((n, 6)))
    collapse = collapse_of(model, contacts, case, mechanics)
    lines = mechanism_lines(model, contacts, collapse)
    assert max(map(len, lines)) <= WIDTH
    table = lines[lines.index("  Sliding (59; those that move most):") + 2 :]
    assert table[0].split()[:3] == ["stack[59]", "over", "stack[58]"]
    assert table[MOST_ROWS - 1].split()[0] == f"stack[{n - MOST_ROWS}]"
    assert f"and {n - 1 - MOST_ROWS} more; the result files hold them all" in table[MOST_ROWS]
    assert mechanism_summary(model, collapse) == "sliding at 59 interfaces; 59 of 59 free blocks move in 59 parts"
