"""Assessments of whole load cases: from a deck to the ratios, and when there is no verdict."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import mbla
from mbla.assembly.assembly import Assembly
from mbla.codes.assess import assessment_of
from mbla.results.assessment import Assessment
from mbla.verify import verify_file

FACADE = Path(__file__).parents[2] / "decks" / "tutorials" / "assessed_facade.yaml"
TEXT = FACADE.read_text(encoding="utf-8")
BOX, CASE = 'max: ["=t", 1, "=h"]', "load_cases.outwards."
COURSES = TEXT.replace(BOX, 'max: ["=t", 1, "=h/8"], repeat: {count: 8, translate: [0, 0, "=h/8"]}')
QUICK = {"load_cases.outwards.pushover.step": 0.05}


def assessed(text: str, case: str = "outwards", **overrides: Any) -> Assessment:
    """Of a load case of a deck, a few coarse steps far."""
    changes = QUICK if case == "outwards" else {}
    run = mbla.run(text, cases=case, set=changes | {key.replace("__", "."): value for key, value in overrides.items()})
    found = assessment_of(Assembly(run.model, run.contacts), run.case(case).record)
    assert found is not None
    return found


def values(found: Assessment, state: str = "") -> dict[str, float]:
    """Figures of a limit state by their symbols."""
    return {each.symbol: each.value for each in found.figures if each.limit_state == state}


def ratios(found: Assessment) -> dict[str, float]:
    """Capacity over demand by limit state."""
    return {state: each.value for state, each in found.ratios.items()}


@pytest.mark.long
def test_the_worked_example_from_deck_to_file_and_back(tmp_path: Path) -> None:
    run = mbla.run(FACADE, output=tmp_path)
    case = run.case("outwards")
    found = assessment_of(Assembly(run.model, run.contacts), case.record)
    assert found is not None
    assert found.remarks == ()
    assert values(found) == pytest.approx(
        {"alpha_0": 0.075, "P_1": 8640 * 9.81, "delta_1": 1.0, "Q": 0.0, "e*": 1.0, "e* stones": 1.0, "FC": 1.35}
        | {"a_0*": 0.5450, "a_0* stones": 0.5450},
        rel=1e-5,
    )
    slv, slc = values(found, "SLV"), values(found, "SLC")
    assert [slv[key] for key in ("S", "T_B", "T_C", "T_D", "d_0")] == pytest.approx(
        [1.2, 0.1583, 0.4749, 2.4, 0.3], abs=1e-4
    )
    assert [slv[key] for key in ("d", "d demand", "ratio d")] == pytest.approx([0.12, 0.1431, 0.839], abs=5e-4)
    assert [slc[key] for key in ("d", "d demand", "ratio d")] == pytest.approx([0.18, 0.1332, 1.351], abs=5e-4)
    assert [slv["a(d)"], slv["T"], slc["a(d)"], slc["T"]] == pytest.approx([0.3270, 3.1972, 0.2180, 4.4533], rel=3e-3)
    theta = math.asin(0.12 / (math.hypot(0.6, 8.0) / 2))  # the curve is no straight line: tan(alpha - theta) g/FC
    alpha = math.atan(0.075)
    rest = math.asin(math.sin(alpha) - math.sin(theta))
    assert slv["a(d)"] == pytest.approx(math.tan(rest) * 9.81 / 1.35, rel=1e-5)
    old = assessment_of(Assembly(run.model, run.contacts), run.case("by_circular_of_2009").record)
    assert old is not None
    assert ratios(old) == pytest.approx({"SLV": 0.4630}, abs=5e-5)
    assert slv["q a_g,0"] / slv["a_g"] == pytest.approx(0.4630, abs=5e-5)

    stored, disagreements = verify_file(tmp_path / f"{FACADE.stem}.h5")
    assert disagreements == ()
    back = assessment_of(stored.assembly, stored.cases[0])
    assert back == found


@pytest.mark.long
def test_a_wall_of_many_courses_is_one_kinematic_block() -> None:
    one, many = values(assessed(TEXT)), assessed(COURSES)
    figures = values(many)
    assert figures["e*"] == pytest.approx(1.0, abs=1e-6)
    assert figures["e* stones"] == pytest.approx(3 * 64 / (4 * 64 - 1), rel=1e-5)  # of n courses 3n²/(4n² − 1)
    assert figures["a_0*"] == pytest.approx(one["a_0*"], rel=1e-5)
    assert figures["P_1"] == pytest.approx(one["P_1"])
    assert ratios(many) == pytest.approx(ratios(assessed(TEXT)), rel=1e-3)


def test_ratios_do_not_depend_on_units() -> None:
    deck = TEXT.replace("mbla: 1\n", "mbla: 1\nunits: {length: cm, force: kN, mass: t}\n").replace(
        "{h: 8, t: 0.6}", "{h: 800, t: 60}"
    )
    deck = deck.replace('["=t", 1,', '["=t", 100,').replace("density: 1800", "density: 1.8e-6")
    metres, centimetres = assessed(TEXT), assessed(deck, load_cases__outwards__pushover__step=5)
    assert ratios(centimetres) == pytest.approx(ratios(metres), rel=1e-9)
    first, second = values(metres, "SLV"), values(centimetres, "SLV")
    assert second["d demand"] == pytest.approx(100 * first["d demand"])
    assert second["T"] == pytest.approx(first["T"])


def test_an_added_mass_counts_where_it_is() -> None:
    """A mass on the top, as heavy as the wall: the control point is the centre of both."""
    deck = TEXT.replace("contacts:", "masses: [{mass: 8640, on: facade, at: [0.3, 0.5, 8]}]\ncontacts:")
    figures = values(assessed(deck))
    assert figures["P_1"] == pytest.approx(2 * 8640 * 9.81)
    assert figures["alpha_0"] == pytest.approx(0.3 / 6.0, rel=1e-5)  # at mid-height and at the top
    assert [figures["e*"], figures["Q"]] == pytest.approx([1.0, 0.0])
    assert values(assessed(deck), "SLV")["d/d_C"] == pytest.approx(1.0, rel=1e-5)


def test_confidence_is_of_the_knowledge_where_joints_crush() -> None:
    case = "by_circular_of_2009"
    known = {"load_cases__by_circular_of_2009__assessment__knowledge": "LC3"}
    assert values(assessed(TEXT, case, **known))["FC"] == 1.35
    strong = TEXT.replace("{friction: 0.6}", "{friction: 0.6, compressive_strength: 1.e+12}")
    assert values(assessed(strong, case, **known))["FC"] == 1.0


def test_a_height_asks_for_more_than_the_ground() -> None:
    up = TEXT.replace(
        "      spectra:\n        SLD: {ntc",
        "      height: {z: 6, top: 14, period: 1.9, storeys: 3}\n      spectra:\n        SLD: {ntc",
    )
    ground, floor = assessed(TEXT), assessed(up)
    assert values(floor)["gamma_1"] == pytest.approx(9 / 7)
    assert values(floor, "SLV")["S_eZ(T)"] > values(ground, "SLV")["S_e(T)"]
    assert all(floor.ratios[state].value <= each.value for state, each in ground.ratios.items())
    assert floor.ratios["SLV"].value < ground.ratios["SLV"].value


# --- Doubts, and no verdict -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"load_cases__outwards__pushover__until": 0.1}, "did not come to where"),
        ({"load_cases__outwards__pushover__control__direction": [1, 0, 1]}, "does not count along"),
    ],
)
def test_no_verdict_by_displacements_without_their_curve(changes: dict[str, Any], says: str) -> None:
    found = assessed(TEXT, **changes)
    assert found.ratios.keys() == {"SLD", "SLV"}
    assert found.ratios["SLV"].value == pytest.approx(0.4630, abs=5e-5)  # by the load factor alone, and said so
    assert found.ratios["SLV"].article == "C8.7.1.2.1.7"
    assert [says in text for text in found.remarks] == [True, True]
    assert {text.identifier for text in found.remarks} == {"assessment-in-doubt"}


def test_no_verdict_beyond_a_table() -> None:
    spectrum = "SLC: {ntc_2018: {a_g: 0.20, F_0: 2.40, T_C_star: 0.35, soil: B}}"
    assert spectrum in TEXT
    found = assessed(TEXT.replace(spectrum, "SLC: {table: [[0, 0.2], [0.5, 0.5], [3, 0.02]]}"))
    assert found.ratios.keys() == {"SLD", "SLV"}
    assert any("a table ends" in text for text in found.remarks)


def test_associative_flow_is_in_doubt_and_the_run_warns() -> None:
    run = mbla.run(TEXT, cases="by_circular_of_2009", set={"analysis.flow_rule": "associative"})
    assert [notice.identifier for notice in run.warnings] == ["assessment-in-doubt"]
    assert "unsafe" in run.warnings[0].message


def test_a_mechanism_in_space_is_in_doubt() -> None:
    """A wall that overturns about an edge oblique to the load moves across it too."""
    deck = TEXT.replace(
        f"min: [0, 0, 0], {BOX}", f"min: [0, 0, 0], {BOX}, transform: [{{rotate: {{axis: [0, 0, 1], angle: 30}}}}]"
    )
    found = assessed(deck, "by_circular_of_2009")
    assert any("in space" in text for text in found.remarks)
    assert not any("in space" in text for text in assessed(TEXT, "by_circular_of_2009").remarks)


def test_a_case_without_load_factor_has_no_assessment() -> None:
    found = assessed(TEXT, "by_circular_of_2009", parameters__t=0.6, joints__bed__friction=0.0)
    assert found.figures == ()
    assert [text.identifier for text in found.remarks] == ["assessment-not-done"]


def test_the_verdict_of_a_code_is_among_the_first_lines() -> None:
    run = mbla.run(TEXT, cases="by_circular_of_2009")
    case = run.case("by_circular_of_2009")
    says = "Circolare 617/2009: SLV NOT MET, capacity/demand 0.462963"
    assert f"  {case.name}: {says}" in run.summary.splitlines()[:5]
    verdict = run.listing.splitlines()
    assert verdict.index(f"  {says}.") <= verdict.index(f"Load case {case.name}") + 4
    assert case.summary.endswith(says)
    assert case.assessment is not None
    assert case.assessment.ratios["SLV"].value == pytest.approx(0.462963, rel=1e-5)
    assert case.curve is None


def test_the_curve_of_a_pushover_as_an_array() -> None:
    case = mbla.run(TEXT, cases="outwards", set=QUICK).case("outwards")
    assert case.curve is not None
    assert case.curve[0] == pytest.approx([0.0, 0.075], abs=1e-8)  # from where the path of elastic joints still rises
    assert case.curve.shape == (len(case.record.solution.further.pushover.curve), 2)
    assert case.curve[:, 1] == pytest.approx(0.075 * (1 - case.curve[:, 0] / 0.3), abs=1e-3)


def test_the_verdict_is_of_the_least_load_factor_that_was_found() -> None:
    """As the README says that the least is the one to design with; blocks and curve are those of the state shown."""
    run = mbla.run(TEXT, cases="outwards", set=QUICK)
    record = run.case("outwards").record
    own = record.solution.mechanics
    assert own is not None
    least = 0.8 * own.load_factor
    searched = replace(record, checks=replace(record.checks, least_load_factor=least))
    plain, lower = (assessment_of(Assembly(run.model, run.contacts), case) for case in (record, searched))
    assert plain is not None
    assert lower is not None
    assert values(lower)["alpha_0"] == pytest.approx(0.8 * values(plain)["alpha_0"])
    assert values(lower, "SLV")["a_g,0"] < values(plain, "SLV")["a_g,0"]
    assert "least load factor that was found" in lower.figures[0].words
    assert "from which the capacity curve starts" in lower.remarks[0]
