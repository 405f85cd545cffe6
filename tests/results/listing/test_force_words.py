import numpy as np

from mbla.results.listing.forces import force_range_lines, lock_lines
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

MODEL, CONTACTS = tower_model(), tower_contacts()


def words(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def test_locked_forces_are_named_by_interface_the_largest_first() -> None:
    lock = np.zeros((8, 3))
    lock[:4] = [1.0, -0.5, 0.0]
    lock[4:] = [2.0, 0.0, 1.0]
    lines = lock_lines(MODEL, CONTACTS, lock)
    assert "balance the live load alone, so that any multiple of it is carried; 2 interfaces" in words(lines)
    rows = [line.split() for line in lines[-2:]]
    assert rows[0][:2] == ["ground", "z"]  # ground z = 0/brick[0]
    assert rows[0][-2:] == ["8", "4"]
    assert rows[1][0] == "base[0]/tower[0]"
    assert rows[1][-2:] == ["4", "2"]


def test_ranges_of_normal_forces_say_which_are_unique() -> None:
    ranges = np.array([[10.0, 10.0], [2.0, np.inf]])
    lines = force_range_lines(MODEL, CONTACTS, tower_mechanics(), ranges)
    assert "1 of 2 are unique" in words(lines)
    assert lines[-2].split()[-3:] == ["2", "unlimited", "10"]
    assert lines[-1].split()[-3:] == ["10", "10", "10"]
