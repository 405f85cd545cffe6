"""``mbla find`` on closed forms, the decks that have a section ``find``, and what is said where nothing is found."""

from __future__ import annotations

import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from mbla import cli
from mbla.deck import read_deck_text
from mbla.errors import DeckError, UsageError
from mbla.sweeps.find.study import FindResult, find
from tests.decks.folder import PATHS, deck_of, name_of
from tests.line import BLOCK, WALL
from tests.test_readme import block as block_of_readme

ASKED = {
    "parameter": None,
    "target": None,
    "bounds": None,
    "case": None,
    "scan": None,
    "first": None,
    "tolerance": None,
}
OF_DECKS = {
    "benchmarks/closed_forms/slopes_of_blocks": (5.0, 1e-7),
    "benchmarks/closed_forms/groove": (0.5 * math.cos(math.radians(30)), 2e-4),
    "benchmarks/published/cocchetti_rizzi_mu_700_stands": (0.107426, 1e-6),
    "sweeps/base/block_that_rocks": (0.46797, 1e-3),
}
"""value that the section `find` of each deck asks for, and how near"""
UPWARDS = BLOCK.replace("live:", "dead: [{force: [0, 0, 30000], on: block}], live:")
MU = ("parameters.mu", "load_factor", 0.3, (0.1, 1.0))
LEDGE = BLOCK.replace("live:", "dead: [{gravity: [2.4, 0, -9.81]}], live:")
WEDGED = BLOCK.replace(
    "supports: [{ground: {z: 0}}]",
    """  - box: {group: left, material: stone, min: [-1, 0, 0], max: [0, 1, 1]}
  - box: {group: right, material: stone, min: [1, 0, 0], max: [2, 1, 1]}
supports: [{blocks: [left, right]}]""",
)
OF_README = block_of_readme("`wall.yaml`:")
JAMMED = WEDGED.replace("min: [0, 0, 0]", "min: [0, 0, 1]").replace("1]}", "2]}")
JAMMED = JAMMED.replace("blocks: [left, right]", "ground: {z: 0}, joint: ground").replace(
    "joints: {", "joints: {ground: {friction: 0.7}, "
)
"""Between two blocks: these are fixed, or stand on the ground with friction of their own"""


def said(found: FindResult) -> str:
    return " ".join(" ".join(found.lines).split())


def asked(text: str, parameter: str, kind: str, target: float, bounds: tuple[float, float], **more: Any) -> FindResult:
    question = ASKED | {"parameter": parameter, "target": (kind, target), "bounds": bounds} | more
    return find(read_deck_text(text, Path("deck.yaml")), SimpleNamespace(**question))


@pytest.mark.long
def test_every_section_of_a_deck_finds_its_value() -> None:
    sections = {name_of(path): path for path in PATHS if deck_of(path).content.find is not None}
    assert sections.keys() == OF_DECKS.keys()
    for name, (value, near) in OF_DECKS.items():
        found = find(deck_of(sections[name]), SimpleNamespace(**ASKED))
        assert found.exit_code == 0
        assert found.zeros[0].best.x == pytest.approx(value, abs=near)


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_height_of_a_block_that_rocks(flow_rule: str) -> None:
    """Its load factor is b/h."""
    text = BLOCK.replace("flow_rule: associative", f"flow_rule: {flow_rule}")
    found = asked(text, "parameters.h", "load_factor", 0.3, (2.5, 8.0))
    (zero,) = found.zeros
    assert zero.best.x == pytest.approx(1 / 0.3, abs=8e-6)
    assert zero.error <= 8e-6
    assert found.solves <= 6


def test_slopes_save_solves() -> None:
    """Sliding and rocking meet at b/h = μ; beyond, the wall's factor does not grow with friction."""
    with_slopes = asked(WALL, "parameters.mu", "load_factor", 0.5, (0.1, 1.0))
    assert with_slopes.zeros[0].best.x == pytest.approx(0.5, abs=1e-6)
    assert with_slopes.solves <= 4


def test_a_block_that_is_lifted_just_stays_at_its_weight() -> None:
    """The weight of 2 m3 is 2 ρ g: with 30 kN upwards the least density is 30000/(2 g)."""
    found = asked(UPWARDS, "materials.stone.density", "stands", 0.0, (1000, 3000))
    assert found.zeros[0].best.x == pytest.approx(30000 / (2 * 9.81), rel=1e-6)
    assert found.solves <= 4
    assert "it stands above" in " ".join(found.lines)


def test_a_block_on_a_slope_just_stays_at_its_tangent() -> None:
    text = BLOCK.replace("live:", "dead: [{gravity: [2.4, 0, -9.81]}], live:")
    found = asked(text, "joints.dry.friction", "stands", 0.0, (0.1, 1.0))
    assert found.zeros[0].best.x == pytest.approx(2.4 / 9.81, abs=1e-6)
    assert found.zeros[0].best.verified


def test_a_tie_with_which_a_block_just_stands() -> None:
    """A force F at half its height turns it over; its weight and a tie at its top hold it: T h = F h/2 − W b/2."""
    tie = 'ties: [{name: rod, through: [[0, 0.5, "=h"], [-3, 0.5, "=h"]], on: [block, ground], capacity: 9000}]\n'
    text = BLOCK.replace("live:", "dead: [{force: [30000, 0, 0], on: block}], live:").replace(
        "load_cases:", f"{tie}load_cases:"
    )
    text = text.replace("mu: 0.5", "mu: 2")
    found = asked(text, "ties.0.capacity", "stands", 0.0, (1000, 20000))
    assert found.zeros[0].best.x == pytest.approx((30000 - 2 * 2000 * 9.81 / 2) / 2, abs=0.02)


def test_a_width_at_which_a_block_just_stands() -> None:
    """Its weight ρ g h b holds it by b/2 about the edge at b, a force F at 1 turns it over: ρ g h b²/2 = F (1 − b)."""
    text = BLOCK.replace("live:", "dead: [{force: [0, 0, -50000], on: block, at: [1, 0.5, 2]}], live:")
    found = asked(text, "parameters.b", "stands", 0.0, (0.5, 2.0))
    half = 2000 * 9.81 * 2 / 2
    assert found.zeros[0].best.x == pytest.approx((math.sqrt(5e4**2 + 4 * half * 5e4) - 5e4) / (2 * half), abs=2e-6)


def test_all_values_of_a_scan() -> None:
    """A force at x on a block 1 m wide: it falls to the left of 0 and to the right of 1, or so."""
    text = BLOCK.replace("ft: 0", "ft: 0, x: 0.5").replace(
        "live:", 'dead: [{force: [0, 0, -50000], on: block, at: ["=x", 0.5, 2]}], live:'
    )
    half = 2 * 2000 * 9.81 / 50000 * 0.5
    once = asked(text, "parameters.x", "stands", 0.0, (-2, 3))
    assert (once.exit_code, once.zeros) == (5, ())
    assert "Nothing was found" in " ".join(once.lines)
    twice = asked(text, "parameters.x", "stands", 0.0, (-2, 3), scan=4)
    assert [zero.best.x for zero in twice.zeros] == pytest.approx([-half, 1 + half], abs=1e-5)
    below, above = ((zero.bracket[0].x, zero.bracket[1].x) for zero in twice.zeros)
    assert below[0] < below[1]
    assert above[0] > above[1]


def test_where_it_stops_standing_the_load_factor_jumps() -> None:
    """A block that is lifted slides at μ (W − F)/W down to nothing; the target lies below that."""
    found = asked(UPWARDS, "materials.stone.density", "load_factor", -0.1, (1000, 3000))
    (zero,) = found.zeros
    assert zero.jumps
    assert zero.best.x == pytest.approx(30000 / (2 * 9.81), rel=1e-4)
    assert found.exit_code == 4
    assert "jumps over the target, from no_equilibrium to" in said(found)
    assert "no value gives -0.1" in found.record["found"][0]["says"]


def test_a_deck_that_is_refused_has_no_value() -> None:
    found = asked(BLOCK, "parameters.mu", "load_factor", 0.3, (-1.0, 1.0))
    assert (found.exit_code, found.answers[0].status) == (4, "refused")
    assert "must be >= 0" in found.answers[0].words
    assert "There is no result for parameters.mu = -1: values next to it may be missed" in said(found)


def test_a_deck_that_is_refused_whatever_the_value_has_its_faults() -> None:
    with pytest.raises(DeckError, match="glue"):
        asked(BLOCK.replace("on: block", "on: no").replace("{joint: dry}", "{joint: glue}"), *MU)


@pytest.mark.parametrize(
    ("live", "words"),
    [
        ("live: [{tilt: {axis: [0, 1, 0]}}]", "a tilting table has an angle"),
        ("objective: {force: {direction: [0, 0, 1], on: block}}", "its answer is a force"),
    ],
)
def test_a_load_case_without_a_load_factor_is_refused(live: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        asked(BLOCK.replace("live: [{acceleration: [1, 0, 0]}]", live), *MU)


@pytest.mark.parametrize(("text", "most"), [(JAMMED, 4), (WEDGED, 4), (LEDGE, 0)])
def test_what_stands_only_in_a_self_stressed_state_has_no_limit_of_standing(text: str, most: int) -> None:
    """A block between two others is held by a thrust that nothing causes; one on a slope by its weight."""
    found = asked(text, "parameters.mu", "stands", 0.0, (0.0, 1.0), tolerance=1e-3)
    assert found.exit_code == most
    assert ("from the stress-free assembly it falls" in said(found)) == bool(most)


@pytest.mark.parametrize(("bounds", "least"), [((0.1, 2.0), 0.5), ((0.5, 2.0), 0.5), ((0.9, 2.0), 0.9)])
def test_beyond_the_friction_at_which_it_rocks_every_value_meets_the_target(
    bounds: tuple[float, float], least: float
) -> None:
    """The load factor is min(μ, b/h), known to rounding."""
    found = asked(BLOCK, "parameters.mu", "load_factor", 0.5, bounds)
    (own,) = found.record["found"]
    assert own["stretch"] == pytest.approx([least, 2.0], abs=4e-6)
    assert own["rises"] is None
    assert found.exit_code == 0
    assert found.solves <= 4
    assert f"to {bounds[1]:g} meets the target" in own["says"]


@pytest.mark.parametrize(("target", "status", "count"), [(0.5, 0, 1), (0.4, 5, 0)])
def test_a_parameter_without_effect(target: float, status: int, count: int) -> None:
    found = asked(BLOCK, "materials.stone.density", "load_factor", target, (1000, 2000))
    assert (found.exit_code, len(found.zeros), found.record["changes"]) == (status, count, False)
    assert "has no effect on the load factor between 1000 and 2000 kg/m^3" in said(found)
    assert "Nothing was found" not in said(found)


def test_a_draft_without_dilatancy_meets_the_target_to_what_is_known_of_it() -> None:
    found = asked(
        BLOCK.replace("flow_rule: associative", "flow_rule: non_associative, accuracy: draft"),
        *("parameters.mu", "load_factor", 0.5, (0.9, 2.0)),
    )
    assert found.record["found"][0]["stretch"] == [0.9, 2.0]
    assert all(abs(zero.best.y) <= zero.best.uncertainty for zero in found.zeros)


def test_a_whole_number_gives_a_stretch() -> None:
    """A height that is rounded to 4 m, with a load factor of 1/4."""
    text = BLOCK.replace('"=h"', '"=round(h)"')
    found = asked(text, "parameters.h", "load_factor", 0.25, (3.0, 5.0), tolerance=1e-2)
    (own,) = found.record["found"]
    assert own["stretch"] == pytest.approx([3.5, 4.5], abs=0.05)
    assert found.exit_code == 0
    assert "both ends are known within" in own["says"]


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    options = ["--parameter", "parameters.h", "--target", "load_factor=0.25", "--bounds", "3", "8"]
    assert cli.main(["find", str(deck), *options]) == 0
    assert "parameters.h = 4" in capsys.readouterr().out
    assert cli.main(["find", str(deck), *options, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["found"][0]["value"] == pytest.approx(4.0, abs=1e-5)
    assert record["solves"] == len(record["evaluations"])
    assert cli.main(["find", str(deck), *options[:-2], "5", "8", "-q"]) == 5
    assert capsys.readouterr().out == ""
    assert list(tmp_path.iterdir()) == [deck]


@pytest.mark.long
@pytest.mark.parametrize(("bounds", "most"), [((0.4, 0.8), 9), ((0.514, 0.519), 7)])
def test_a_load_factor_without_dilatancy_that_scatters_does_not_jump(bounds: tuple[float, float], most: int) -> None:
    """The wall of the README: its load factor steps by a thousandth where friction hardly changes."""
    found = asked(OF_README, "joints.dry.friction", "load_factor", 0.5, bounds)
    (zero,) = found.zeros
    assert (found.exit_code, zero.jumps) == (0, False)
    assert zero.best.x == pytest.approx(0.5165, abs=1e-3)
    assert 1e-4 < zero.error < 2e-3
    assert found.solves <= most
    assert "between which the result scatters" in said(found)


WEDGE = """mbla: 1
parameters: {s: 1.0}
materials: {rock: {unit_weight: 25000}}
joints: {a: {friction: "=s*tan(20)"}, b: {friction: "=s*tan(30)"}}
blocks:
  - polyhedron:
      group: wedge
      material: rock
      vertices:
        - [0, 0, 0]
        - [-25.6897543, 15.77392112, 28.89698835]
        - [3.7380141, 13.76396059, 30.10324559]
        - [-23.50769217, 57.41014703, 37.56552641]
      faces: [[0, 1, 3], [0, 2, 3], [0, 1, 2], [1, 2, 3]]
contacts: {joint: a}
supports:
  - {ground: {point: [0, 0, 0], normal: [0.6830127019, -0.1830127019, 0.7071067812]}, joint: a}
  - {ground: {point: [0, 0, 0], normal: [-0.7697511314, -0.5389855446, 0.3420201433]}, joint: b}
load_cases:
  slide: {live: [{acceleration: [0.37893279, -0.92542420, 0]}]}
"""
"""A wedge of rock on two planes; between the friction that carries it at all and that with which it stands from the
stress-free assembly it stands only by self-stress."""


@pytest.mark.long
def test_what_stands_only_by_self_stress_lies_below_a_load_factor() -> None:
    """Closed form without dilatancy: sliding along the line of intersection, T = s (tan 20 N_a + tan 30 N_b)."""
    a = np.array([0.6830127019, -0.1830127019, 0.7071067812])
    b = np.array([-0.7697511314, -0.5389855446, 0.3420201433])
    along = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
    n_a, n_b, t = np.linalg.solve(np.column_stack([a, b, along]), [0.0, 0.0, 1.0])
    limit = abs(t) / (math.tan(math.radians(20)) * n_a + math.tan(math.radians(30)) * n_b)
    found = asked(WEDGE, "parameters.s", "load_factor", 0.0, (0.9, 1.2))
    assert found.scanned[0].status == "only by self-stress"
    assert found.exit_code == 0
    assert found.zeros[0].best.x == pytest.approx(limit, rel=1e-5)
