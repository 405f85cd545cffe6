"""What the rules accept; what they refuse is in tests/invalid_decks."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck, rules, types
from mbla.deck.items.masonry import OpeningArch
from mbla.deck.rules.exactly_one import KINDS
from mbla.deck.section import RULES, Section
from tests.deck.decks import BLOCK, changed, write

WALL = (
    "wall: {group: block, material: stone, unit: [0.4, 0.2, 0.175], length: 2, courses: 6, "
    "openings: [{from: [0, 0], to: [2, 1.05]}]}"
)
BOX = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"
LIVE = "[{acceleration: [1, 0, 0]}]"

WORDS: dict[type[Section], list[str]] = {
    types.JointLaw: ["the friction angle", "where the friction cone ends"],
    types.Rotation: ["rotate.axis = [0, 0, 0]: must not be the zero vector"],
    types.Reflection: ["mirror.normal = [0, 0, 0]: must not be the zero vector"],
    types.BoxItem: ["box.max[1] = -1: must be > 0"],
    types.PolyhedronItem: ["there are 4 vertices", "is a corner of this face already"],
    types.WallItem: ["that of from", "the length of the wall", "the height of the wall"],
    types.ArchItem: [
        "applies to shape: segmental",
        "half the span, for a basket arch",
        "is the same point as the one before",
        "applies with springers: ground only",
    ],
    types.ColumnItem: ["needs height and drums", "is what drum_heights says", "has no effect on a single drum"],
    types.StackItem: ["would not rest on the one below", "numbers, count - 1", "only one of shift, offsets"],
    types.TrilithonItem: ["the lintel rests on both uprights"],
    types.DomeItem: [
        "applies to segmental domes only",
        "must be even in running bond",
        "a springing on ground is level",
    ],
    types.WallsItem: [
        "must lie along x or along y",
        "must be a corner",
        "there are 4 walls",
        "has a gable already",
    ],
    types.Opening: ["only one of lintel and arch may be given"],
    OpeningArch: ["applies to flat arches", "the end joints of a flat arch meet below it"],
    types.BarrelVaultItem: ["needs rise for shape: catenary", "applies to shape: segmental only", "half the span"],
    types.CrossVaultItem: [
        "must be <= 180: two barrels",
        "springings on ground are level",
        "for a segmental vault: two",
    ],
    types.PavilionVaultItem: ["a keystone closes the crown", "would be a kink in it"],
    types.SpiralStairItem: ["the inner radius", "the angle from tread to tread", "the rise", "needs built_in"],
    types.BridgeItem: [
        "give one for all or one for each",
        "is half the span for shape: semicircular",
        "needs piers between its spans",
        "needs unit for spandrels",
        "half the span: the extrados",
        "for spandrels: full",
        "half the width: use spandrels: full",
        "applies to a bridge with spandrels",
        "needs both height and courses",
    ],
    types.SelectorTerm: ["box[1][2] = -1: must be > 0", "applies with group only", "the first of the range"],
    types.GroundPlane: ["needs a normal beside its point", "applies with point only"],
    types.Support: [
        "needs one of ground or blocks",
        "applies with ground only",
        "does not apply to ground, which does not move",
        "only one of fixed, and slide or turn, may be given",
        "applies with fixed, slide or turn only",
        "fixed[2] = x: x is listed already",
        "slide = [0, 0, 0]: must not be the zero vector",
    ],
    types.SymmetryPlane: [
        "symmetry[0]: needs a normal beside its point",
        "symmetry[0].normal = [1, 0, 0]: applies with point only",
        "symmetry[0].normal = [0, 0, 0]: must not be the zero vector",
    ],
    types.Turn: ["turn.axis = [0, 0, 0]: must not be the zero vector"],
    types.SettlementSection: ["settlement.direction = [0, 0, 0]: must not be the zero vector"],
    types.Load: [
        "a force needs `on`",
        "applies to a force only",
        "does not apply to gravity",
        "does not apply to tilt",
        "applies to acceleration only",
    ],
    types.HeightPattern: ["must be > 2, the height before it", "does not apply beside points"],
    types.LineLoad: ["the line has no length", "must not run along the line"],
    types.PressureLoad: ["needs a level from which depth is measured", "applies with normal only"],
    types.Travel: ["must not be the corner before it"],
    types.Tilt: ["axis = [0, 0, 0]: must not be the zero vector"],
    types.LoadCaseSection: ["is a live load with no effect", "must not stand beside tilt", "must be a live load"],
    types.AnalysisSection: ["applies to flow_rule: associative", "applies to contact_model: concave"],
    types.ContactOverride: ["needs one of between, orientation or box", "box[1][1] = -1: must be > 0"],
    types.AboutNormal: ["orientation.normal = [0, 0, 0]: must not be the zero vector"],
    types.ContactPoints: ["only one of per_edge or spacing", "only one of inset or rounding"],
    types.DeckContent: [
        "contacts.points.inset = 0.2: applies to contact_model: concave only",
        "contacts.table = model_contacts.csv: does not go with symmetry",
        "contains itself",
        "must stand in the live loads of a load case itself",
        "applies to load cases with tilt only",
    ],
    types.Expectation: ["needs at least one of load_factor"],
}
"""Section with rules of its own -> words of a message of each rule"""


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
        (LIVE, LIVE + "\nanalysis: {flow_rule: associative, friction_cone: polyhedral, solver: highs}"),
        (LIVE, LIVE + "\nanalysis: {flow_rule: livesley, solver: highs, second_opinion: true}"),
    ],
)
def test_accepted(tmp_path: Path, old: str, new: str) -> None:
    assert read_deck(write(tmp_path, changed(old, new))).content.mbla == 1


def test_box_of_a_group_that_several_items_make(tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, changed(f"  - {BOX}\n", f"  - {BOX}\n  - {BOX}\n")))
    assert len(deck.content.blocks) == 2


def test_exactly_one_names_keys_of_the_types() -> None:
    for section, keys in rules.EXACTLY_ONE.items():
        assert set(keys) <= set(section.model_fields)


def test_long_lists_of_kinds_have_a_name() -> None:
    long = {section for section, keys in rules.EXACTLY_ONE.items() if len(keys) > 8}
    assert set(KINDS) == long


def test_every_rule_is_registered_and_broken_by_a_faulty_deck() -> None:
    folder = Path(__file__).parents[1] / "invalid_decks"
    expected = "\n".join(path.read_text(encoding="utf-8") for path in folder.glob("deck_*.yaml"))
    of_decks = {section for section in RULES if section.__module__.startswith("mbla.deck.")}  # not of sweep files
    assert set(WORDS) | set(rules.EXACTLY_ONE) | set(rules.AT_LEAST_ONE) == of_decks
    assert all(issubclass(section, Section) for section in RULES)
    missing = [message for messages in WORDS.values() for message in messages if message not in expected]
    assert missing == []
    assert BLOCK.startswith("mbla: 1")
