"""Walls built through the deck, and what is measured on them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts import find_contacts
from mbla.contacts.contacts import Contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks

UNIT = [0.4, 0.2, 0.15]


@dataclass(frozen=True)
class Built:
    """A model of one item on the ground, and its contacts."""

    model: Model
    contacts: Contacts

    @property
    def blocks(self) -> Blocks:
        """All blocks."""
        return self.model.blocks

    @property
    def volume(self) -> float:
        """Of all blocks."""
        return float(self.blocks.volumes.sum())

    def position(self, name: str) -> IntArray:
        """Label of each block."""
        return self.blocks.labels.position(name)

    def member(self, name: str) -> BoolArray:
        """Blocks that are such a member."""
        return np.array([member == name for member in self.blocks.labels.members])

    def boxes(self) -> FloatArray:
        """Least and greatest coordinates of each block, (n, 2, 3)."""
        start, vertices = self.blocks.vertex_start[:-1], self.blocks.vertices
        return np.stack([np.minimum.reduceat(vertices, start), np.maximum.reduceat(vertices, start)], axis=1)

    def bed_area(self) -> float:
        """Of all level interfaces between blocks."""
        return self._area(np.abs(self.contacts.normals[:, 2]) > 1 - 1e-9)

    def area_along(self, axis: int) -> float:
        """Of all interfaces between blocks whose normal is along an axis."""
        return self._area(np.abs(self.contacts.normals[:, axis]) > 1 - 1e-9)

    def area(self) -> float:
        """Of all interfaces between blocks."""
        return self._area(np.ones(len(self.contacts), dtype=bool))

    def ground_area(self) -> float:
        """Of all interfaces with the ground."""
        return float(self.contacts.areas[(self.contacts.bodies >= len(self.blocks)).any(axis=1)].sum())

    def _area(self, chosen: BoolArray) -> float:
        between = (self.contacts.bodies < len(self.blocks)).all(axis=1)
        return float(self.contacts.areas[chosen & between].sum())


def build(folder: Path, kind: str = "wall", units: str = "m", **keys: Any) -> Built:
    """An item on the ground plane z = 0; the deck is refused where blocks overlap or one is not closed."""
    item = {"material": "stone", "unit": UNIT, **keys}
    deck = {
        "mbla": 1,
        "units": {"length": units},
        "materials": {"stone": {"density": 2000}, "oak": {"density": 700}},
        "joints": {"dry": {"friction": 0.6}},
        "blocks": [{kind: item}],
        "contacts": {"joint": "dry"},
        "supports": [{"ground": {"z": 0}}],
        "load_cases": {"push": {"live": [{"acceleration": [1, 0, 0]}]}},
    }
    path = folder / "deck.yaml"
    path.write_text(json.dumps(deck), encoding="utf-8")
    read = read_deck(path)
    model = build_model(read)
    contacts = find_contacts(model, read.contacts)
    return Built(model, contacts)


def is_sound(built: Built) -> None:
    """Faces outwards as made, no overlap, no splinter, nothing that misses, hangs or stands apart."""
    notices = [notice for notice in built.model.notices if notice.identifier != "opening-not-spanned"]
    assert [notice.message for notice in notices] == []
    report = built.contacts.report
    assert len(report.overlaps) == len(report.unchecked) == len(report.slivers) == len(report.near_misses) == 0
    assert len(report.isolated) == len(report.unsupported) == 0
    assert built.blocks.volumes.min() > 0
    n = len(built.blocks)
    parent = np.arange(n + 1)
    for a, b in np.minimum(built.contacts.bodies, n):
        root_a, root_b = _root(parent, a), _root(parent, b)
        parent[root_a] = root_b
    assert len({_root(parent, body) for body in range(n + 1)}) == 1


def _root(parent: IntArray, body: int) -> int:
    while parent[body] != body:
        parent[body] = parent[parent[body]]
        body = int(parent[body])
    return body


def perpends(built: Built, segment: int | None = None, axis: int = 0) -> dict[int, list[float]]:
    """Places of the joints between units of each course, along an axis, ends of stretches left out."""
    chosen = np.ones(len(built.blocks), dtype=bool)
    if segment is not None:
        chosen = built.position("segment") == segment
    boxes, courses = built.boxes(), built.position("course")
    found: dict[int, list[float]] = {}
    for course in range(int(courses.max()) + 1):
        here = boxes[chosen & (courses == course) & ~built.member("lintel")]
        starts, ends = np.unique(here[:, 0, axis].round(9)), np.unique(here[:, 1, axis].round(9))
        found[course] = np.intersect1d(starts, ends).tolist()
    return found


def least_distance(found: dict[int, list[float]]) -> float:
    """Between perpends of successive courses."""
    return min(
        float(np.abs(np.subtract.outer(found[course], found[course + 1])).min(initial=np.inf))
        for course in range(len(found) - 1)
    )
