"""Settings of the proof of an associative load factor: those that prove nothing are refused."""

from __future__ import annotations

import pytest

from mbla.solution.associative.settings import AssociativeSettings


def test_the_usual_ones_are_valid() -> None:
    AssociativeSettings().validate()


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (AssociativeSettings(noise=1e-2), "noise below zero_size"),
        (AssociativeSettings(sharper=10.0), "tolerances"),
        (AssociativeSettings(powers=()), "powers"),
        (AssociativeSettings(rough=0.0), "friction"),
    ],
)
def test_settings_that_prove_nothing_are_refused(wrong: AssociativeSettings, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        wrong.validate()
