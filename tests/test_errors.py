"""Errors keep what they say when a process hands them to another."""

from __future__ import annotations

import pickle

import pytest

from mbla.errors import DeckError, Fault, FileError, Message, Place
from mbla.results.failures import identifiers_of


def test_a_deck_error_keeps_its_faults_between_processes() -> None:
    faults = [Fault(Place("a.yaml", line, 1), "blocks", Message("missing-key", "is missing"), "1") for line in (7, 3)]
    error = DeckError(faults)
    copy = pickle.loads(pickle.dumps(error))
    assert copy.faults == error.faults
    assert str(copy) == str(error)


def test_a_fault_without_identifier_is_refused_where_it_is_made() -> None:
    with pytest.raises(TypeError) as caught:
        Fault(Place("a.yaml", 1, 1), "blocks", "is missing")  # type: ignore[arg-type]
    assert str(caught.value) == "a fault takes a Message, which has an identifier, not 'is missing'"


@pytest.mark.parametrize(
    ("error", "identifier"),
    [
        (FileError("file-missing", "a.yaml: does not exist"), "file-missing"),
        (MemoryError(), "out-of-memory"),
        (PermissionError(), "file-system"),
        (KeyError("a"), "internal-error"),
    ],
)
def test_every_error_has_an_identifier(error: Exception, identifier: str) -> None:
    assert identifiers_of(error) == [identifier]
