from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from mbla.deck.sections.selectors import Selector
from mbla.errors import Fault, KeyPath, Message, Place
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.blocks import BlockLabels, join_labels, labels_of
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.polyhedra import cuboids


def fault_at(path: KeyPath, message: Message) -> Fault:
    return Fault(Place("deck", 1, 1), ".".join(map(str, path)), message)


def selection(partial: frozenset[str] = frozenset()) -> BlockSelection:
    """Ten unit cubes along x; even ones are group a, odd ones b; the a are two copies of courses 0, 0, 1 and 0, 0."""
    least = np.array([[2.0 * i, 0, 0] for i in range(10)])
    labels = Labels(("a", "b") * 5, np.ones(10), join_labels([_within(cube) for cube in range(10)]))
    return BlockSelection(build_blocks(cuboids(least, least + 1), labels, 1e-3).blocks, partial, fault_at)


def _within(cube: int) -> BlockLabels:
    if cube % 2:
        return labels_of(1, "", {})
    member = "lintel" if cube == 4 else "pier"
    return labels_of(1, member, {"course": np.array([int(cube == 4)]), "copy": np.array([int(cube > 4)])})


def select(selector: Any, partial: frozenset[str] = frozenset()) -> tuple[Any, list[Fault]]:
    site = selection(partial)
    blocks = select_blocks(TypeAdapter(Selector).validate_python(selector), ("on",), site)
    return None if blocks is None else blocks.tolist(), site.faults


@pytest.mark.parametrize(
    ("selector", "blocks"),
    [
        ("a", [0, 2, 4, 6, 8]),
        ({"group": "b"}, [1, 3, 5, 7, 9]),
        ({"group": "b", "index": 3}, [7]),
        ({"box": [(3, 0, 0), (9, 1, 1)]}, [2, 3, 4]),
        ({"box": [(0.5, 0.5, 0.5), (2.5, 0.6, 0.6)]}, [0, 1]),
        (["a", {"group": "b", "index": 0}], [0, 1, 2, 4, 6, 8]),
        ({"group": "b", "box": [(3, 0, 0), (9, 1, 1)]}, [3]),
        ({"group": "a", "member": "lintel"}, [4]),
        ({"group": "a", "course": 0}, [0, 2, 6, 8]),
        ({"group": "a", "course": -1}, [4]),
        ({"group": "a", "course": (0, -1)}, [0, 2, 4, 6, 8]),
        ({"group": "a", "copy": 1, "course": 0}, [6, 8]),
        ({"group": "a", "copy": (-2, -1), "course": -1}, [4, 6, 8]),
        ({"box": [(-1, -1, -1), (5, 1, 1)], "course": 0}, [0, 2]),
        (["a", "a", {"box": [(-1, -1, -1), (1, 1, 1)]}], [0, 2, 4, 6, 8]),
    ],
)
def test_selection(selector: Any, blocks: list[int]) -> None:
    assert select(selector) == (blocks, [])


def test_unknown_index() -> None:
    blocks, (fault,) = select([{"group": "a", "index": 5}, "b"])
    assert blocks is None
    assert (fault.key, fault.message) == ("on.0.index", "there is no such block: a has 5, index 0 to 4")


def test_empty_box() -> None:
    blocks, (fault,) = select({"box": [(0, 5, 0), (1, 6, 1)]})
    assert blocks is None
    assert fault.key == "on.box"
    assert fault.message == ("no centroid of a block lies in it; they lie between (0.5, 0.5, 0.5) and (18.5, 0.5, 0.5)")


@pytest.mark.parametrize(
    ("selector", "key", "message"),
    [
        (
            {"group": "a", "member": "lintl"},
            "on.member",
            "unknown member; did you mean lintel? these blocks have: lintel and pier",
        ),
        ({"group": "b", "member": "pier"}, "on.member", "these blocks have no members: leave it out"),
        ({"group": "b", "course": 0}, "on.course", "these blocks have no course: leave it out"),
        ({"group": "a", "course": 2}, "on.course", "there is none: they go from 0 to 1"),
        ({"group": "a", "course": -3}, "on.course", "there is none: they go from 0 to 1"),
        ({"group": "a", "copy": 1, "course": 1}, "on.course", "there is none: they go from 0 to 0"),
        (
            {"group": "b", "box": [(0, 0, 0), (1, 1, 1)]},
            "on.box",
            "no centroid of these blocks lies in it; they lie between (2.5, 0.5, 0.5) and (18.5, 0.5, 0.5)",
        ),
    ],
)
def test_what_excludes_the_last_blocks(selector: Any, key: str, message: str) -> None:
    blocks, (fault,) = select(selector)
    assert blocks is None
    assert (fault.key, fault.message) == (key, message)


def test_every_fault_of_a_list() -> None:
    _, faults = select([{"group": "a", "index": 5}, {"group": "b", "index": 9}])
    assert [fault.key for fault in faults] == ["on.0.index", "on.1.index"]


@pytest.mark.parametrize("selector", ["a", {"group": "a", "index": 77}, ["b", "a"], {"box": [(0, 5, 0), (1, 6, 1)]}])
def test_groups_that_could_not_be_built_are_not_judged(selector: Any) -> None:
    assert select(selector, frozenset({"a"})) == (None, [])
