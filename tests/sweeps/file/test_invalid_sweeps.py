"""Every sweep file of tests/invalid_sweeps is refused at the place and for the reason that its table says.

The sentences are in one file, and may be mended there: ``python -m tests.faulty_sweeps --update``.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.faulty_files import place_and_kind
from tests.faulty_sweeps import SENTENCES, SWEEPS, refusal_of, sentences


def test_there_are_enough() -> None:
    assert len(SWEEPS) >= 100


@pytest.mark.parametrize("path", SWEEPS, ids=lambda path: path.stem)
def test_places_and_reasons(path: Path) -> None:
    expected = SWEEPS[path].faults
    assert expected, "a faulty sweep file says what is expected of it"
    assert tuple(place_and_kind(fault, path) for fault in refusal_of(path).faults) == expected


def test_sentences() -> None:
    assert sentences() == SENTENCES.read_text(encoding="utf-8")
