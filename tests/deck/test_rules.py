"""What the rules accept, and what is told of it; what they refuse is in tests/invalid_decks.

A key that is given and has no effect is said to have none; one that has an effect is not. One word for accuracy
sets every knob; a knob that the deck gives wins.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, get_args

import pytest

from mbla.deck import read_deck
from mbla.deck.section import RULES, Rule
from mbla.deck.sections.accuracy import PRESETS, Accuracy, Knobs, knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import DeckError, Finding
from tests import line
from tests.deck.decks import BLOCK, changed, write
from tests.faulty_decks import DECKS
from tests.line import line_of

WALL = (
    "wall: {group: block, material: stone, unit: [0.4, 0.2, 0.175], length: 2, courses: 6, "
    "openings: [{from: [0, 0], to: [2, 1.05]}]}"
)
BOX = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"
LIVE = "[{acceleration: [1, 0, 0]}]"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('{friction: "=mu"}', "{friction: 0}"),
        ('{friction: "=mu"}', "{friction_angle: 33, dilatancy: 33}"),
        ('{friction: "=mu"}', "{friction: 1, dilatancy: 45}"),
        ('{friction: "=mu"}', "{friction: 0.5, cohesion: 1000, tensile_strength: 2000}"),
        ('{friction: "=mu"}', "{friction: 0, tensile_strength: 5}"),
        (BOX, WALL),
        (LIVE, "[{gravity: [1, 0, 0]}]"),
        (LIVE, "[{acceleration: [0, 0, 1.e-300]}]"),
        (LIVE, "[{acceleration: [1, 0, 0], on: block}]"),
        (LIVE, "[{force: [1, 0, 0], on: {group: block, index: 0}}]"),
        (LIVE, LIVE + "\n    dead: []"),
        (LIVE, LIVE + "\n    dead: [{gravity: none}]"),
        ("{ground: {z: 0}}", "{blocks: block, fixed: [x, rz]}"),
        (
            "{ground: {z: 0}}",
            "{blocks: block, slide: [1, 0, 0], turn: {axis: [1, 0, 0], about: [0, 0, 0]}, together: true}",
        ),
        (f"live: {LIVE}", "settlement: {on: block, direction: [0, 0, -1]}"),
        (f"live: {LIVE}", "settlement: {on: [block], turn: {axis: [0, 1, 0], about: [0, 0, 0]}}"),
        (LIVE, LIVE + "\n    dead: [{gravity: [0, 0, 0]}]"),
        (LIVE, LIVE + "\n    dead: [{acceleration: [0, 0, -1]}]"),
        ("supports:\n  - {ground: {z: 0}}\n", ""),
        ("{ground: {z: 0}}", "{ground: {z: 0}, blocks: block, joint: dry}"),
    ],
)
def test_accepted(tmp_path: Path, old: str, new: str) -> None:
    assert read_deck(write(tmp_path, changed(old, new))).content.mbla == 1


def test_box_of_a_group_that_several_items_make(tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, changed(f"  - {BOX}\n", f"  - {BOX}\n  - {BOX}\n")))
    assert len(deck.content.blocks) == 2


def test_every_rule_is_broken_by_a_faulty_deck(monkeypatch: pytest.MonkeyPatch) -> None:
    of_decks = {section: RULES[section] for section in RULES if section.__module__.startswith("mbla.deck.")}
    broken: set[Rule] = set()

    def recorded(check: Rule) -> Rule:
        def run(section: Any) -> Iterator[Finding]:
            for finding in check(section):
                broken.add(check)
                yield finding

        return run

    for section, checks in of_decks.items():
        monkeypatch.setitem(RULES, section, [recorded(check) for check in checks])
    for path in (path for path in DECKS if path.stem.startswith("deck_")):
        with pytest.raises(DeckError):
            read_deck(path)
    assert {check for checks in of_decks.values() for check in checks} == broken


WITHOUT = line.BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {}")


def idle(*overrides: str) -> list[str]:
    notices = line_of(WITHOUT, *overrides).deck.notices
    return [notice.message for notice in notices if notice.identifier == "key-idle"]


@pytest.mark.parametrize(
    ("key", "idle_with", "used_with"),
    [
        ("analysis.scheme=published", "flow_rule=associative", "flow_rule=non_associative"),
        ("analysis.search=2", "flow_rule=associative", "flow_rule=dilatancy"),
        ("analysis.search=2", "contact_model=convex", "contact_model=concave"),
        ("analysis.search=2", "scheme=published", "scheme=auto"),
        ("analysis.published.slope=0.01", "scheme=auto", "scheme=published"),
        ("analysis.residual=1e-5", "flow_rule=associative", "flow_rule=dilatancy"),
        ("analysis.residual=1e-5", "scheme=published", "scheme=auto"),
        ("analysis.path.ratio=0.5", "flow_rule=associative", "flow_rule=dilatancy"),
        ("analysis.path.until=20", "flow_rule=livesley", "flow_rule=non_associative"),
        ("analysis.path.until=20", "scheme=published", "scheme=auto"),
        ("analysis.torsion=false", "flow_rule=dilatancy", "flow_rule=non_associative"),
        ("analysis.torsion=false", "contact_model=convex", "contact_model=concave"),
        ("analysis.torsion=false", "scheme=published", "scheme=auto"),
        ("joints.dry.dilatancy=5", "flow_rule=non_associative", "flow_rule=dilatancy"),
    ],
)
def test_with_what_a_key_has_an_effect(key: str, idle_with: str, used_with: str) -> None:
    (message,) = idle(key, f"analysis.{idle_with}")
    assert "has no effect: it applies to" in message
    assert idle(key, f"analysis.{used_with}") == []


def test_stiffness_has_an_effect_in_time_alone(tmp_path: Path) -> None:
    text = BLOCK.replace('{friction: "=mu"}', "{friction: 0.6, stiffness: {normal: 10 GPa/m}}")
    notice = next(each for each in notices(tmp_path, text) if "key-idle" in each)
    assert notice.endswith("stiffness: has no effect: it applies to load cases with time_history or modes")
    in_time = notices(tmp_path, text.replace("live: [{acceleration: [1, 0, 0]}]", "modes: 3"))
    assert [each for each in in_time if "key-idle" in each] == []


@pytest.mark.parametrize("key", ["analysis.gap=1e-5", "analysis.reductions=false"])
def test_keys_of_both_contact_models(key: str) -> None:
    for rule in ("associative", "non_associative"):
        assert idle(key, "analysis.contact_model=convex", f"analysis.flow_rule={rule}") == []


def test_keys_that_are_not_given_are_not_mentioned() -> None:
    assert idle() == idle("analysis.flow_rule=associative") == []


LIVE_2 = "    live: [{acceleration: [1, 0, 0]}]\n"


def notices(folder: Path, text: str) -> list[str]:
    path = write(folder, text)
    return [str(notice).replace(f"{folder}/", "") for notice in read_deck(path).notices]


def test_none_for_the_working_deck(tmp_path: Path) -> None:
    assert notices(tmp_path, BLOCK) == []


def test_gravity_in_metres_in_a_deck_in_millimetres(tmp_path: Path) -> None:
    text = changed(LIVE_2, "    dead: [{gravity: [0, 0, -9.81]}]\n" + LIVE_2).replace("length: m", "length: mm")
    text = text.replace("density: 2000", "density: 2.e-6")
    assert notices(tmp_path, text) == [
        "warning [gravity-unusual]: deck.yaml:16:22 load_cases.push.dead[0].gravity = [0, 0, -9.81]: "
        "is 0.00981 m/s^2, not 9.81: its numbers are in mm/s^2"
    ]


@pytest.mark.parametrize(
    ("length", "gravity"),
    [
        ("m", "[0, 0, -9.80665]"),
        ("m", "[0, -9.8, 0]"),
        ("mm", "[0, 0, -9810]"),
        ("ft", "[0, 0, -32.174]"),
        ("mm", '[0, 0, "-9.81 m/s^2"]'),
        ("m", "[6.94, 0, -6.94]"),
        ("m", "[0, 0, 0]"),
    ],
)
def test_usual_gravity(tmp_path: Path, length: str, gravity: str) -> None:
    text = changed(LIVE_2, f"    dead: [{{gravity: {gravity}}}]\n" + LIVE_2).replace("length: m", f"length: {length}")
    assert notices(tmp_path, text.replace("density: 2000", 'density: "2000 kg/m^3"')) == []


def test_gravity_three_per_cent_off_as_live_load(tmp_path: Path) -> None:
    (notice,) = notices(tmp_path, changed(LIVE_2, "    live: [{gravity: [0, 0, -9.5]}]\n"))
    assert notice.startswith(
        "warning [gravity-unusual]: deck.yaml:16:22 load_cases.push.live[0].gravity = [0, 0, -9.5]"
    )


@pytest.mark.parametrize(
    ("usual", "unusual", "words"),
    [
        ("{friction: 0.6}", "{friction: 33}", "joints.dry.friction = 33: is more than masonry has; an angle"),
        (
            "{friction_angle: 33}",
            "{friction_angle: 0.6}",
            "joints.dry.friction_angle = 0.6: is not that of masonry, 20 to 45 degrees",
        ),
        ("{friction_angle: 33}", "{friction_angle: 85}", "joints.dry.friction_angle = 85: is not that of masonry"),
        (
            "acceleration: [1, 0, 0]",
            "pressure: {normal: [-1, 0, 0], level: 2, per_depth: 6}",
            'per_depth = 6: is 6 N/m^3, and that of earth and water is 1 to 30 kN/m^3; "6 kN/m^3" may be meant',
        ),
        (
            "acceleration: [1, 0, 0]",
            "pressure: {normal: [-1, 0, 0], level: 2, per_depth: -6}",
            'per_depth = -6: is -6 N/m^3, and that of earth and water is 1 to 30 kN/m^3; "-6 kN/m^3" may be meant',
        ),
        ("density: 2000", "density: 20", "materials.stone.density = 20: is not that of masonry, 1500 to 3000 kg/m^3"),
        ("unit_weight: 20e3", "unit_weight: 20", "materials.stone.unit_weight = 20: is not that of masonry"),
        ("[1, 0, 0]}]", "[9.81, 0, 0]}]", "live[0].acceleration = [9.81, 0, 0]: is in units of g = 9.81 m/s^2"),
        (
            "{friction: 0.6, compressive_strength: 5e6}",
            "{friction: 0.6, compressive_strength: 5}",
            "compressive_strength = 5: is 5 N/m^2, and that of masonry is 0.5 to 200 MPa; without the key it is "
            'unlimited; "5 MPa" may be meant',
        ),
        ("{friction: 0.6, cohesion: 1e5}", "{friction: 0.6, cohesion: 0.1}", 'is 0.1 N/m^2, .*; "0.1 MPa" may be'),
        (
            "{friction: 0.6, stiffness: {normal: 1.e+10}}",
            "{friction: 0.6, stiffness: {normal: 10}}",
            'dry.stiffness.normal = 10: is 10 N/m^3, .*; "10 GPa/m" may be meant',
        ),
        (
            "{friction: 0.6, stiffness: {modulus: 3 GPa, thickness: 1 cm}}",
            "{friction: 0.6, stiffness: {modulus: 3, thickness: 1 cm}}",
            'dry.stiffness.modulus = 3: is 3 N/m^2, .*; "3 GPa" may be meant',
        ),
        (
            "{friction: 0.6, stiffness: {normal: 1.e+10, ratio: 0.5}}",
            "{friction: 0.6, stiffness: {normal: 1.e+10, ratio: 40}}",
            "dry.stiffness.ratio = 40: is not that of joints",
        ),
        ("{friction: 0.6, cohesion: 1 kPa}", "{friction: 0.6, cohesion: 200}", '"200 kPa" may be meant'),
        (
            "[1, 0, 0]}]",
            "[1, 0, 0]}]\n    assessment: {spectra: {SLV: {en_1998: {a_g: 0.98, type: 1, soil: B}}}}",
            "SLV.en_1998.a_g = 0.98: is in units of g = 9.81 m/s^2",
        ),
        (
            "[1, 0, 0]}]",
            "[1, 0, 0]}]\n    assessment: {spectra: {SLV: {table: [[0, 0.2], [1000, 0.1]]}}}",
            "SLV.table[1][0] = 1000: is in seconds",
        ),
        ("[1, 0, 0]}]", "[1, 0, 0]}]\n    pushover: {step: 5, until: 200}", '"200 mm" may be meant'),
        (
            "contacts:",
            "ties:\n  - {through: [[0, 0, 0], [1, 0, 0]], diameter: 24, strength: 235 MPa}\ncontacts:",
            'ties[0].diameter = 24: is 24 m, which no bar has; "24 mm" may be meant',
        ),
        (
            "contacts:",
            "fill:\n  soil: {on: block, material: stone, level: 3, cells: {size: 1}, friction_angle: 30, water: "
            "{level: 3, unit_weight: 9.81}}\ncontacts:",
            'water.unit_weight = 9.81: is 9.81 N/m^3, and that of water is 9.81 kN/m^3; "9.81 kN/m^3" may be meant',
        ),
    ],
)
def test_values_that_are_mostly_meant_in_another_unit(usual: str, unusual: str, words: str, tmp_path: Path) -> None:
    text = BLOCK.replace('{friction: "=mu"}', usual) if usual.startswith("{") else BLOCK
    text = text.replace("density: 2000", usual) if usual.startswith("unit") else text
    assert usual in text or usual.startswith("{"), text
    assert [notice for notice in notices(tmp_path, text) if "unusual" in notice] == []
    (notice,) = (notice for notice in notices(tmp_path, text.replace(usual, unusual)) if "unusual" in notice)
    assert notice.startswith("warning [value-unusual]: deck.yaml:")
    assert re.search(".*".join(map(re.escape, words.split(".*"))), notice)


@pytest.mark.parametrize(
    ("usual", "unusual", "words"),
    [
        ("friction_angle: 30,", "friction_angle: 0.52,", "friction_angle = 0.52: is in degrees, and that of soil"),
        ("friction_angle: 30,", "friction_angle: 70,", "friction_angle = 70: is in degrees, and that of soil"),
        ("wall: {}", "wall: {friction_angle: 0.35}", "wall.friction_angle = 0.35: is in degrees"),
        ("cohesion: 5 kPa", "cohesion: 5 MPa", "cohesion = 5 MPa: is 5e+06 N/m^2, and that of soil is 0 to 300 kPa"),
        ("cohesion: 5 kPa", "cohesion: 5", 'cohesion = 5: is 5 N/m^2, .*; "5 kPa" may be meant'),
        ("{mobilisation: 1}", "{friction_angle: 0.5, mobilisation: 1}", "passive.friction_angle = 0.5: is in degrees"),
    ],
)
def test_values_of_soil_that_are_mostly_meant_in_another_unit(
    usual: str, unusual: str, words: str, tmp_path: Path
) -> None:
    text = BLOCK + (
        "fill:\n"
        "  clay: {on: block, material: stone, level: 2, cells: {size: 1}, friction_angle: 30, cohesion: 5 kPa, "
        "wall: {}}\n"
        "  ballast: {on: block, material: stone, level: 2, passive: {mobilisation: 1}}\n"
    )
    assert usual in text
    assert [notice for notice in notices(tmp_path, text) if "unusual" in notice] == []
    (notice,) = (notice for notice in notices(tmp_path, text.replace(usual, unusual)) if "unusual" in notice)
    assert notice.startswith("warning [value-unusual]: deck.yaml:")
    assert re.search(".*".join(map(re.escape, words.split(".*"))), notice)


def test_names_that_nothing_uses(tmp_path: Path) -> None:
    text = changed("{mu: 0.6}", "{mu: 0.6, nu: 1, xi: '=nu'}").replace(
        "joints:\n", "  brick: {density: 1000}\njoints:\n  wet: {friction: 1}\n"
    )
    assert notices(tmp_path, text) == [
        "notice [parameter-unused]: deck.yaml:4:34 parameters.xi is not used",
        "notice [material-unused]: deck.yaml:7:3 materials.brick is not used",
        "notice [joint-unused]: deck.yaml:9:3 joints.wet is not used",
    ]


# One word sets every knob; a knob that the deck gives wins.


OTHER: dict[str, Any] = {
    "tolerance": 1e-5,
    "gap": 1e-4,
    "residual": 1e-5,
    "search": 3.0,
    "torsion": False,
    "standing": False,
}
"""A value of each knob that no preset has, or standard has not."""


@pytest.mark.parametrize("accuracy", get_args(Accuracy))
def test_a_preset_sets_every_knob(accuracy: Accuracy) -> None:
    section = AnalysisSection(accuracy=accuracy, flow_rule="associative")
    assert knobs_of(section) == PRESETS[accuracy]


@pytest.mark.parametrize("knob", [field.name for field in fields(Knobs)])
@pytest.mark.parametrize("accuracy", ["standard", "reference"])
def test_a_knob_that_is_given_wins_and_turns_alone(accuracy: Accuracy, knob: str) -> None:
    found = line_of(line.WALL, f"analysis.accuracy={accuracy}", f"analysis.{knob}={str(OTHER[knob]).lower()}")
    assert asdict(knobs_of(found.deck.analysis)) == asdict(PRESETS[accuracy]) | {knob: OTHER[knob]}


def test_a_draft_assesses_the_standing_where_its_claim_depends_on_it() -> None:
    assert not knobs_of(AnalysisSection(accuracy="draft", flow_rule="associative")).standing
    assert knobs_of(AnalysisSection(accuracy="draft", flow_rule="non_associative")).standing
    assert not knobs_of(AnalysisSection(accuracy="draft", flow_rule="non_associative", standing=False)).standing


def test_presets_go_from_rough_to_sharp() -> None:
    draft, standard, reference = (PRESETS[name] for name in ("draft", "standard", "reference"))
    for knob in ("tolerance", "gap", "residual"):
        assert getattr(draft, knob) > getattr(standard, knob) > getattr(reference, knob)


def test_every_description_says_what_the_presets_set() -> None:
    words = {name: AnalysisSection.model_fields[name].description or "" for name in asdict(PRESETS["draft"])}
    assert all("default by accuracy: draft " in text for text in words.values())
    assert words["gap"].endswith("draft 0.001, standard 3e-07, reference 5e-08")
    assert words["search"].endswith("draft 0, standard 1, reference 4")
