"""The record of decks/time_histories is the one that its formula gives, and leaves its base at rest."""

from __future__ import annotations

import numpy as np
import pytest

from tests.decks.synthetic_record import PATH, components, text


def test_the_file_is_made_anew() -> None:
    assert PATH.read_text(encoding="utf-8") == text()


def test_the_base_is_at_rest_at_its_end() -> None:
    times, accelerations = components()
    assert np.abs(accelerations).max(axis=0) == pytest.approx([0.3, 0.25])
    assert np.trapezoid(accelerations, times, axis=0) == pytest.approx([0.0, 0.0], abs=1e-12)
