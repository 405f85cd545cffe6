"""A deck that gives half, or a quarter, against the deck of the whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import Model, build_model
from mbla.results.outcome import answer_of
from mbla.results.results import Results
from mbla.run import RunOptions, run

HEAD = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
output: {vtu: false}
"""
SIDE = (
    "  - wall: {group: side, material: stone, unit: [0.4, 0.2, 0.2], length: 1.0, courses: 3, "
    "transform: [{rotate: {axis: [0, 0, 1], angle: 90}}, {translate: [%s, 0.2, 0]}]}\n"
)
FRONT = "  - wall: {group: front, material: stone, unit: [0.4, 0.2, 0.2], length: %s, courses: 4}\n"
SUPPORTS = "supports: [{ground: {z: 0}}]\n"
CASES = """
load_cases:
  inwards: {live: [{acceleration: [0, 1, 0]}]}
  outwards: {live: [{acceleration: [0, -1, 0]}]}
  pressed: {live: [{force: [0, -1000, 0], on: {group: side, index: 4}, at: [0.1, 0.6, 0.3]}]}
"""
SYMMETRY = "symmetry: [{x: 1, halves: [{group: front, unit: 2, course: 0}, {group: front, unit: 2, course: 2}]}]\n"
HALF = f"{HEAD}blocks:\n{FRONT % 1.0}{SIDE % 0.2}{SUPPORTS}{SYMMETRY}{CASES}"
FORCE = "{force: [0, -1000, 0], on: {group: side, index: 4}, at: [0.1, 0.6, 0.3]}"
IMAGE = "{force: [0, -1000, 0], on: {group: side, index: 13}, at: [1.9, 0.6, 0.3]}"
BLOCKS = f"blocks:\n{FRONT % 2.0}{SIDE % 0.2}{SIDE % 2.0}"
WHOLE = f"{HEAD}{BLOCKS}{SUPPORTS}{CASES.replace(FORCE, f'{FORCE}, {IMAGE}')}"

TABLE = """
blocks:
  - box: {group: leg, material: stone, min: [0.5, 0.7, 0], max: [1, 1.2, 2]}
  - box: {group: slab, material: stone, min: [0, 0, 2], max: [1.2, 1.4, 2.3]}
supports: [{blocks: leg}]
symmetry: [{x: 0, halves: slab}, {point: [5, 0, 5], normal: [0, -2, 0], halves: slab}]
load_cases:
  lifted: {live: [{acceleration: [0, 0, 1]}]}
  leg_sinks: {settlement: {on: leg, direction: [0, 0, -1]}}
  legs_spread: {settlement: {on: leg, direction: [1, 0, 0]}}
"""


def model_of(tmp_path: Path, text: str) -> Model:
    path = tmp_path / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    return build_model(read_deck(path))


def results_of(tmp_path: Path, text: str, flow_rule: str, *cases: str) -> Results:
    path = tmp_path / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    overrides = (f"analysis.flow_rule={flow_rule}",)
    return run(path, RunOptions(folder=tmp_path / "out", overrides=overrides, cases=cases, force=True))


def test_the_blocks_are_those_of_the_whole(tmp_path: Path) -> None:
    half, whole = model_of(tmp_path, HALF), model_of(tmp_path, WHOLE)
    assert len(half.blocks) == len(whole.blocks)
    assert len({half.blocks.name(block) for block in range(len(half.blocks))}) == len(half.blocks)
    orders = [np.lexsort(np.round(model.blocks.centroids, 6).T) for model in (half, whole)]
    for name in ("centroids", "volumes", "densities", "convex"):
        mine, theirs = (getattr(model.blocks, name)[order] for model, order in zip((half, whole), orders, strict=True))
        np.testing.assert_allclose(mine, theirs, rtol=1e-12, atol=1e-12)
    for number in range(3):
        for load in ("dead_load", "live_load"):
            mine, theirs = (
                getattr(model.load_cases[number], load)[order]
                for model, order in zip((half, whole), orders, strict=True)
            )
            np.testing.assert_allclose(mine, theirs, atol=1e-9)


@pytest.mark.parametrize("text", [HALF, WHOLE, f"{HEAD}{TABLE.rpartition('  leg_sinks')[0]}"])
def test_the_loads_of_a_case_add_up_to_its_load(tmp_path: Path, text: str) -> None:
    """Of a whole, of a half with its images, and of a quarter, whose slab is cut by both planes."""
    for case in model_of(tmp_path, text).load_cases:
        for loads, total in ((case.dead, case.dead_load), (case.live, case.live_load)):
            sums = np.zeros_like(total)
            for load in loads:
                sums[load.blocks] += load.wrenches[:, :6]
            np.testing.assert_allclose(sums, total, atol=1e-12 * np.abs(total).max())


def test_the_contacts_are_those_of_the_whole(tmp_path: Path) -> None:
    found = []
    for text in (HALF, WHOLE):
        model = model_of(tmp_path, text)
        found.append(find_contacts(model, read_deck(tmp_path / "deck.yaml").contacts))
    assert len(found[0]) == len(found[1])
    assert len(found[0].points) == len(found[1].points)
    assert found[0].areas.sum() == pytest.approx(found[1].areas.sum(), rel=1e-12)


@pytest.mark.parametrize("case", ["inwards", "outwards", "pressed"])
def test_the_half_has_the_factor_of_the_whole(tmp_path: Path, case: str) -> None:
    factors = []
    for text in (HALF, WHOLE):
        (found,) = results_of(tmp_path, text, "associative", case).cases
        assert found.checks.verified
        assert found.solution.associative is not None
        assert found.solution.size is not None
        assert found.solution.size.mirror_planes == 1
        factors.append(found.solution.associative.load_factor)
    assert factors[0] == pytest.approx(factors[1], rel=1e-6)


@pytest.mark.long
def test_the_half_has_the_factor_of_the_whole_without_dilatancy(tmp_path: Path) -> None:
    """Where that is unique: the front falls off its sides, which friction holds in no other way."""
    factors = []
    for text, planes in ((HALF, 1), (WHOLE, 0)):
        (found,) = results_of(tmp_path, text, "non_associative", "outwards").cases
        assert found.status.value == "solved"
        assert found.solution.mechanics is not None
        assert found.solution.size is not None
        assert found.solution.size.mirror_planes == planes
        factors.append(found.solution.mechanics.load_factor)
    assert factors[0] == pytest.approx(factors[1], rel=1e-6)


def test_states_without_dilatancy_are_symmetric(tmp_path: Path) -> None:
    results = results_of(tmp_path, HALF, "non_associative", "inwards")
    (found,) = results.cases
    assert found.solution.mechanics is not None
    centroids, motion = results.model.blocks.centroids, found.solution.mechanics.mechanism
    image = centroids * [-1, 1, 1] + [2, 0, 0]
    partner = np.array([np.linalg.norm(centroids - each, axis=1).argmin() for each in image])
    np.testing.assert_allclose(motion[partner], motion * [-1, 1, 1, 1, -1, -1], atol=1e-9 * np.abs(motion).max())


def test_a_quarter_of_a_table(tmp_path: Path) -> None:
    model = model_of(tmp_path, HEAD + TABLE)
    assert len(model.blocks) == 5
    slab = int(np.argmax(model.blocks.volumes))
    assert model.blocks.volumes[slab] == pytest.approx(4 * 1.2 * 1.4 * 0.3, rel=1e-12)
    np.testing.assert_allclose(model.blocks.centroids[slab], [0, 0, 2.15], atol=1e-12)
    assert bool(model.blocks.convex[slab])
    assert int(model.fixed.sum()) == 4
    assert model.mirrors == ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0))
    results = results_of(tmp_path, HEAD + TABLE, "associative")
    lifted = results.case("lifted").solution.mechanics
    assert lifted is not None
    assert lifted.load_factor == pytest.approx(1.0, rel=1e-7)
    weight = 4 * 1.2 * 1.4 * 0.3 * 2000 * 9.81
    # all four legs sink: they carry the slab to the end; as they spread each is pushed back by friction at the most
    sinks, spreads = (answer_of(results.case(name)) for name in ("leg_sinks", "legs_spread"))
    assert sinks == pytest.approx(weight, rel=1e-7)
    assert spreads == pytest.approx(-0.6 * weight, rel=1e-6)


def test_parts_beside_the_plane_keep_their_own_states(tmp_path: Path) -> None:
    """A column on either side, each symmetric in itself about a parallel plane, which the deck does not give."""
    column = "blocks:\n  - box: {group: column, material: stone, min: [2, 0, 0], max: [3, 2, 4]}\n"
    text = f"{HEAD}{column}{SUPPORTS}symmetry: [{{x: 0}}]\n{CASES}"
    text = text.replace("group: side, index: 4", "group: column, index: 0")
    text = text.replace("at: [0.1, 0.6, 0.3]", "at: [2.5, 1, 4]")
    results = results_of(tmp_path, text, "non_associative", "inwards")
    assert len(results.model.blocks) == 2
    (found,) = results.cases
    assert found.solution.size is not None
    assert (found.solution.size.parts, found.solution.size.mirror_planes) == (2, 0)
    assert found.solution.mechanics is not None
    assert found.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-7)


def test_added_masses_are_those_of_the_whole(tmp_path: Path) -> None:
    """On a block and its image, and on one that the plane cuts, of which the deck gives half the mass."""
    masses = (
        "masses:\n"
        "  - {mass: 70, on: {group: side, index: 4}, at: [0.15, 0.6, 0.7]}\n"
        "  - {mass: %s, on: {group: front, unit: 2, course: 2}, at: [%s, 0.1, 0.6]}\n"
    )
    half = model_of(tmp_path, HALF + masses % (15, 0.9))
    image = "  - {mass: 70, on: {group: side, index: 13}, at: [1.85, 0.6, 0.7]}\n"
    whole = model_of(tmp_path, WHOLE + masses % (30, 1.0) + image)
    assert half.total_weight == pytest.approx(whole.total_weight, rel=1e-12)
    assert half.total_weight - model_of(tmp_path, HALF).total_weight == pytest.approx(170 * 9.81)
    rows = [np.lexsort(np.round(each.blocks.centroids, 9).T) for each in (half, whole)]
    for one, other in zip(
        (half.blocks.added_masses[rows[0]], half.blocks.added_mass_points[rows[0]]),
        (whole.blocks.added_masses[rows[1]], whole.blocks.added_mass_points[rows[1]]),
        strict=True,
    ):
        assert one == pytest.approx(other, abs=1e-9)


def test_named_loads_have_images(tmp_path: Path) -> None:
    named = HALF.replace("[{acceleration: [0, 1, 0]}]", "[{loads: quake, factor: 2}]")
    one = model_of(tmp_path, f"{named}loads: {{quake: [{{acceleration: [0, 0.5, 0]}}]}}\n")
    assert one.load_cases[0].live_load == pytest.approx(model_of(tmp_path, HALF).load_cases[0].live_load)
    with pytest.raises(DeckError, match=r"loads\.quake\[0\]\.acceleration.*acts across the plane of symmetry x = 1"):
        model_of(tmp_path, f"{named}loads: {{quake: [{{acceleration: [0.5, 0.5, 0]}}]}}\n")


def test_an_image_can_be_named_where_joint_laws_are_given(tmp_path: Path) -> None:
    between = "{joint: frictionless, between: [{group: side, index: 9}, ground]}"
    text = HALF.replace("contacts: {joint: dry}", f"contacts: {{joint: dry, overrides: [{between}]}}")
    (tmp_path / "deck.yaml").write_text(text, encoding="utf-8")
    deck = read_deck(tmp_path / "deck.yaml")
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    slippery = contacts.bodies[contacts.joints == contacts.joint_names.index("frictionless")]
    assert [model.blocks.name(block) for block in slippery[slippery < len(model.blocks)].tolist()] == ["side[9]"]
    (tmp_path / "deck.yaml").write_text(text.replace("index: 9", "index: 99"), encoding="utf-8")
    with pytest.raises(DeckError, match=r"there is no such block: side has 18, index 0 to 17"):
        build_model(read_deck(tmp_path / "deck.yaml"))
