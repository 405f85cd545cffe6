"""Errors keep what they say when a process hands them to another."""

from __future__ import annotations

import pickle

from mbla.errors import DeckError, Fault, Message, Place


def test_a_deck_error_keeps_its_faults_between_processes() -> None:
    faults = [Fault(Place("a.yaml", line, 1), "blocks", Message("missing-key", "is missing"), "1") for line in (7, 3)]
    error = DeckError(faults)
    copy = pickle.loads(pickle.dumps(error))
    assert copy.faults == error.faults
    assert str(copy) == str(error)
