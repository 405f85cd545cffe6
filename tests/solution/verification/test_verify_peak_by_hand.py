"""A peak of a load path: its forces carry its load factor, or it is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.solution.verification.further_claims import peak_check
from mbla.solution.verification.residuals import Residuals
from tests.line import Line
from tests.solution.by_hand import EXACT, cube, state


@pytest.fixture(scope="module")
def line() -> Line:
    return cube()


def checked(line: Line, residuals: Residuals, monkeypatch: pytest.MonkeyPatch) -> float:
    """Of a peak of load factor 3 that leaves these."""
    peak = state(np.zeros((4, 3)), np.zeros((1, 6)), 3.0)

    def residuals_of(*arguments: object) -> Residuals:
        *_, mechanics, dilatancy = arguments
        assert mechanics is peak
        assert isinstance(dilatancy, np.ndarray)
        assert dilatancy.tolist() == [0.0] * 4
        return residuals

    monkeypatch.setattr("mbla.solution.verification.further_claims.residuals_of", residuals_of)
    return peak_check(line.model, line.contacts, line.load_case, peak)


@pytest.mark.parametrize("name", ["equilibrium", "yielding"])
def test_forces_carry_a_peak_to_a_millionth(name: str, line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    for value, held in ((0.0, True), (1e-6, True), (1.001e-6, False), (0.5, False), (np.nan, False)):
        found = checked(line, replace(EXACT, **{name: value}), monkeypatch)
        assert found == 3.0 if held else np.isnan(found)


def test_velocities_of_what_passes_prove_nothing(line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    off = replace(EXACT, penetration=1.0, complementarity=1.0, live_power=0.0, power_balance=1.0)
    assert checked(line, off, monkeypatch) == 3.0


def test_without_a_peak_there_is_none(line: Line) -> None:
    assert np.isnan(peak_check(line.model, line.contacts, line.load_case, None))


def test_forces_that_do_not_carry_their_load(line: Line) -> None:
    none: FloatArray = np.zeros((4, 3))
    assert np.isnan(peak_check(line.model, line.contacts, line.load_case, state(none, np.zeros((1, 6)), 1.0)))
