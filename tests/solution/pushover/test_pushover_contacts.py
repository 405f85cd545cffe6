"""Contacts of a pushed structure that are found anew on the way."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import BoolArray, FloatArray
from mbla.solution.pushover import way as ways
from mbla.solution.pushover.place import PushedPlace
from mbla.solution.pushover.renewal import renewed
from tests.solution.pushover.test_pushover import pushover_of
from tests.solution.pushover.test_pushover_laws import random_deck


def wrenches(place: PushedPlace) -> dict[tuple[int, int], FloatArray]:
    """Smoothed force and moment about the origin on b of each pair of bodies, (6,) N and N m."""
    assert place.state is not None
    joints, state = place.joints, place.state
    forces = joints.forces(np.vstack([state.normal[None], state.shear]))[: len(joints.areas)]
    there = np.einsum("nk,nkj->nj", forces, place.at.placed.frames)
    every = np.hstack([there, np.cross(place.at.placed.points, there)])
    bodies, row = np.unique(joints.touching.points.bodies, axis=0, return_inverse=True)
    total = np.zeros((len(bodies), 6))
    np.add.at(total, row.ravel(), every)
    return {(int(a), int(b)): each for (a, b), each in zip(bodies, total, strict=True)}


@pytest.mark.parametrize("seed", [0, 3])
def test_two_bodies_press_on_each_other_as_before(seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A wall and a block that slide: new points of a pair have the force and moment of those before."""
    found = list[tuple[PushedPlace, PushedPlace]]()

    def watched(place: PushedPlace, is_over: Callable[[BoolArray], bool]) -> PushedPlace:
        new = renewed(place, is_over)
        if new.joints is not place.joints and place.state is not None:
            found.append((place, new))
        return new

    monkeypatch.setattr(ways, "renewed", watched)
    text = re.sub(r"steps: \d+", "steps: 8", random_deck(seed))
    (deck := tmp_path / "deck.yaml").write_text(text, encoding="utf-8")
    pushover_of(deck)
    changed = 0
    for before, after in found:
        changed += int((after.joints.touching.before < 0).any())
        own, new = wrenches(before), wrenches(after)
        size = max(float(np.abs(each).max()) for each in own.values())
        for pair in own.keys() & new.keys():
            assert new[pair] == pytest.approx(own[pair], abs=1e-3 * size)
    assert changed > 2
