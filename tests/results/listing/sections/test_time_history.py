"""A structure in time, as sections of the listing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mbla.model.motion.signal import Signal
from mbla.results.listing.listing import case_section
from mbla.results.listing.summary import summary_lines
from mbla.results.listing.text import lines_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from tests.results.rocking import rocking_case
from tests.results.synthetic import tower_results

RESULTS = tower_results()


def words_of(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def test_sections_say_what_it_was_moved_by_what_it_did_and_what_it_took() -> None:
    case = rocking_case(RESULTS.cases[0])
    words = words_of(lines_of(case_section(RESULTS.assembly, case).blocks))
    for said in (
        "base moves by sine along (1, 0, 0) at most 0.0503 g, 0.314 m/s, 0.628 m",
        "peak displacement 0.0713 m at 0.4 s, tower[0]",
        "drift 3.56 % of its height above the lowest support",
        "residual displacement 0.001 m, tower[0] (+- 0.0002)",
        "largest opening 0.0637 m, base[0] and tower[0]",
        "middle tower[0] 0.0713 0.4",
        "Peaks of response spectra, 5 % damping, periods from 0.1 to 4 s: point along x [g] along y [g] along z [g]",
        "dry 2 0.0637 base[0] and tower[0]",
        "work of the base 0.3793 0.1963",
        "They balance to 0.0e+00 of the largest",
        "steps 400 of 0.01 s; 2 halved, 32 small ones in all",
        "factorisations 800, 2 a step",
        "first period 0.02 s",
        "with half of the step peak 0.072 m at 0.31 s (1 % off)",
    ):
        assert said in words, said
    assert "load factor" not in words
    assert "Steps" not in words


def test_what_does_not_stand_has_no_figures() -> None:
    gone = dict[str, Any].fromkeys(("rows", "frames", "histories", "peaks", "half"))
    case = replace(rocking_case(RESULTS.cases[0], **gone), status=Status.NO_EQUILIBRIUM)
    words = words_of(lines_of(case_section(RESULTS.assembly, case).blocks))
    assert "No equilibrium: the structure does not stand under its dead load." in words
    assert "status no equilibrium" in words


def test_the_summary_has_the_peak_in_its_table() -> None:
    case = rocking_case(RESULTS.cases[0])
    words = words_of(summary_lines(replace(RESULTS, cases=(case,))))
    assert "load case status peak displacement [m] shaken solved 0.071264" in words
    assert "shaken: rocks, peak 0.0713 m at 0.4 s (tower[0])" in words


def test_a_motion_that_is_cut_and_a_base_that_goes_on_after_it() -> None:
    case = rocking_case(RESULTS.cases[0])
    asked = case.load_case.time_history
    assert asked is not None
    short = replace(case, load_case=replace(case.load_case, time_history=replace(asked, duration=1.0)))
    assert "0.628 m: of all of it, which is cut at 1 s" in section_words(short)
    pulse = replace(asked.motions[0], signal=Signal(np.array([0.0, 0.5]), np.array([2.0, 2.0])))
    goes_on = replace(case, load_case=replace(case.load_case, time_history=replace(asked, motions=(pulse,))))
    assert "1 m/s, 0.25 m; after it the base goes on at 1 m/s" in section_words(goes_on)


def section_words(case: CaseResult) -> str:
    return words_of(lines_of(case_section(RESULTS.assembly, case).blocks))
