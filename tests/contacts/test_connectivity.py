from __future__ import annotations

import numpy as np

from mbla.contacts.report import isolated_blocks, unsupported_parts


def parts(fixed: list[bool], bodies: list[tuple[int, int]]) -> list[list[int]]:
    links = np.array(bodies, dtype=np.int64).reshape(-1, 2)
    return [part.tolist() for part in unsupported_parts(np.array(fixed), links)]


def test_chain_on_a_fixed_block() -> None:
    assert parts([True, False, False], [(0, 1), (1, 2)]) == []


def test_chain_on_the_ground_as_body_a() -> None:
    assert parts([False, False], [(2, 0), (0, 1)]) == []


def test_every_part_by_itself_in_order_of_its_first_block() -> None:
    assert parts([False] * 6 + [True], [(5, 1), (0, 3), (2, 6)]) == [[0, 3], [1, 5], [4]]


def test_two_fixed_blocks_in_contact_hold_nothing() -> None:
    assert parts([True, True, False], [(0, 1)]) == [[2]]


def test_isolated_blocks_ignore_the_ground() -> None:
    assert isolated_blocks(3, np.array([[3, 1]])).tolist() == [0, 2]
