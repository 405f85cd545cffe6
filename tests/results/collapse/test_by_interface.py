import numpy as np
import pytest

from mbla.results.collapse.interface_modes import interface_radii, largest_by_interface, sum_by_interface
from tests.results.synthetic import tower_contacts


def test_sums_and_largest_of_each_interface() -> None:
    contacts, values = tower_contacts(), np.array([1.0, 2, 3, 4, -5, -6, -7, -8])
    assert sum_by_interface(contacts, values).tolist() == [10, -26]
    assert sum_by_interface(contacts, np.column_stack([values, values])).tolist() == [[10, 10], [-26, -26]]
    assert sum_by_interface(contacts, values > 2).tolist() == [2, 0]
    assert largest_by_interface(contacts, values).tolist() == [4, 0]


def test_radius_of_a_unit_square() -> None:
    assert interface_radii(tower_contacts()) == pytest.approx([0.5**0.5, 0.5**0.5])
