import numpy as np

from mbla.results.listing.sections.forces import lock_blocks
from mbla.results.listing.text import lines_of
from tests.results.synthetic import tower_contacts, tower_model

MODEL, CONTACTS = tower_model(), tower_contacts()


def words(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def test_locked_forces_are_named_by_interface_the_largest_first() -> None:
    lock = np.zeros((8, 3))
    lock[:4] = [1.0, -0.5, 0.0]
    lock[4:] = [2.0, 0.0, 1.0]
    lines = lines_of(lock_blocks(MODEL, CONTACTS, lock))
    assert "balance the live load alone, so that any multiple of it is carried; 2 interfaces" in words(lines)
    rows = [line.split() for line in lines[-2:]]
    assert rows[0][:2] == ["ground", "z"]  # ground z = 0/brick[0]
    assert rows[0][-2:] == ["8", "4"]
    assert rows[1][0] == "base[0]/tower[0]"
    assert rows[1][-2:] == ["4", "2"]
