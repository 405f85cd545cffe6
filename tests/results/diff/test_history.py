"""Structures in time in two results: their peaks are compared."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.results.diff.comparison import compare_results
from mbla.results.diff.words import comparison_text
from mbla.results.results import Results
from tests.results.rocking import peaks, rocking_case
from tests.results.synthetic import tower_results


def rocking(factor: float) -> Results:
    results = tower_results()
    own = peaks()
    case = rocking_case(results.cases[0], peaks=replace(own, displacements=factor * own.displacements), half=None)
    return replace(results, cases=(case,))


def test_peaks_are_the_answers() -> None:
    same, other = (compare_results(rocking(1.0), rocking(factor)) for factor in (1.0, 1.02))
    assert not same.cases[0].differs
    (answer,) = other.cases[0].answers
    assert (answer.name, answer.unit) == ("peak_displacement", "m")
    assert answer.difference == pytest.approx(0.02)
    assert other.cases[0].differs
    words = comparison_text(other, ("a.h5", "b.h5"))
    assert "shaken: DIFFERS; peak displacement 0.071264 in A, 0.0726892 in B" in words
