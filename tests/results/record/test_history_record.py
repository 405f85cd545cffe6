"""A structure in time as an object of the JSON record."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest

from mbla.results.record.json_record import results_json
from mbla.results.record.json_values import json_line
from mbla.solution.solution import Status
from tests.results.rocking import rocking_case, rocks
from tests.results.synthetic import tower_results

RESULTS = tower_results()


def record_of(**changed: Any) -> dict[str, Any]:
    case = replace(rocking_case(RESULTS.cases[0]), **changed)
    found: dict[str, Any] = json.loads(json_line(results_json(replace(RESULTS, cases=(case,)))))
    return dict(found["cases"][0]["time_history"])


def test_figures() -> None:
    found = record_of()
    assert found["peak"] == pytest.approx(0.0713, abs=1e-4)
    assert found["drift"] == pytest.approx(found["peak"] / 2.0)
    assert (found["peak_block"], found["falls"], found["fallen"]) == ("tower[0]", None, 0)
    assert (found["steps"], found["halved"], found["missed"]) == (400, 2, 0)
    assert found["balance"] < 1e-12
    assert found["energies"]["base"] == pytest.approx(sum(found["energies"][name] for name in ("kinetic", "contacts")))
    assert found["change_by_half_step"] == pytest.approx(0.01)
    assert (found["lower"], found["upper"]) == (found["peak"], found["half_step"]["peak"])
    assert found["motions"][0]["peak_displacement"] == pytest.approx(0.628, abs=1e-3)
    assert [point["name"] for point in found["points"]] == ["middle"]
    assert found["points"][0]["peak"] == pytest.approx(found["peak"])


def test_the_peak_of_spectra_of_a_point() -> None:
    spectra = rocks().spectra
    assert spectra is not None
    found = record_of()["points"][0]["spectral_peak"]
    row = spectra.periods.tolist().index(found["period"])
    assert found["value"] == spectra.points[0, row, "xyz".index(found["axis"])] == spectra.points.max()


def test_what_is_no_result_has_no_figures() -> None:
    found = record_of(status=Status.NOT_VERIFIED)
    assert (found["peak"], found["falls"], found["energies"], found["points"]) == (None, None, None, [])
    assert found["verdict"].startswith("NOT VERIFIED: what was followed does not hold; it says that it rocks")


def test_others_have_none() -> None:
    assert results_json(RESULTS)["cases"][0]["time_history"] is None
