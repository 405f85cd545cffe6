"""Contacts that are handed on from deck to deck: the same ones, and only where nothing that they depend on changed."""

from __future__ import annotations

import pytest

from mbla.arrays import alike
from mbla.contacts.known import KnownContacts
from mbla.contacts.search import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from tests.decks.folder import BENCHMARKS

SMALL = "blocks.0.arch.voussoirs=7"


@pytest.mark.parametrize(
    ("change", "kept"),
    [
        ("parameters.mu=0.5", True),
        ("joints.dry.cohesion=1e4", True),
        ("load_cases.push_x.live.0.acceleration=[0, 1, 0]", True),
        ("analysis.accuracy=draft", True),
        ("parameters.t=0.2", False),
        ("contacts.tolerance=1e-4", False),
        ("contacts.points={per_edge: 3}", False),
        ("joints.dry.compressive_strength=1e7", False),
        ("supports=[{blocks: {group: arch, index: 0}}]", False),
    ],
)
def test_handed_on_where_nothing_changed_that_they_depend_on(change: str, kept: bool) -> None:
    known, path = KnownContacts(), BENCHMARKS["arch_20_voussoirs"]
    first, then = (read_deck(path, (SMALL, *more), expected=False) for more in ((), (change,)))
    before = known.of(build_model(first), first.contacts)
    model = build_model(then)
    found = known.of(model, then.contacts)
    assert (found is before) == kept
    own = find_contacts(model, then.contacts)
    assert alike(found.points, own.points)
    assert alike(found.frames, own.frames)
    assert found.report.notices == own.report.notices
