from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.contacts import find_contacts
from mbla.model.model import Joint
from mbla.model.polyhedra import join_polyhedra
from mbla.program.remarks import program_notices
from mbla.results.series import factor_of
from mbla.run_deck import RunOptions, run
from tests.contacts.structures import blocks_of, boxes, ground, model_of, prism, section
from tests.line import BLOCK, line_of


def test_compressive_strength_at_corner_points_is_warned_of() -> None:
    line = line_of(BLOCK, "joints.dry.compressive_strength=1e6")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.severity == "warning"
    assert notice.identifier == "eccentric-crushing-overstated"
    assert "dry" in notice.message


@pytest.mark.parametrize(
    ("points", "identifier"),
    [
        ("contacts.points.per_edge=2", "crushing-at-points"),
        ("contacts.points.spacing=0.5", "crushing-at-points"),
        ("contacts.points.spacing=1.0", "eccentric-crushing-overstated"),
        ("contacts.points.per_edge=1", "eccentric-crushing-overstated"),
        ("contacts.points.inset=0.1", "eccentric-crushing-overstated"),
    ],
)
def test_points_between_the_corners_bound_what_they_overstate(points: str, identifier: str) -> None:
    line = line_of(BLOCK, "joints.dry.compressive_strength=1e6", points)
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.identifier == identifier


def test_a_single_edge_without_points_is_enough_for_the_warning() -> None:
    """1 m along x, 0.4 m along y."""
    text = BLOCK.replace('max: ["=b", 1, "=h"]', 'max: ["=b", 0.4, "=h"]')
    line = line_of(text, "joints.dry.compressive_strength=1e6", "contacts.points.spacing=0.5")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.identifier == "eccentric-crushing-overstated"


def test_joints_without_it_are_not() -> None:
    line = line_of(BLOCK)
    assert program_notices(line.model, line.contacts) == ()


PIER = """mbla: 1
units: {length: mm, force: N, mass: t}
materials: {stone: {unit_weight: 1.0e-5}}
joints: {mortar: {friction: 0.7, cohesion: 5, tensile_strength: 2, compressive_strength: 2}}
blocks:
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [300, 200, 1000]}
contacts: {joint: mortar, points: {per_edge: PARTS}}
supports: [{ground: {z: 0}}]
load_cases:
  top: {live: [{force: [1000, 0, 0], on: pier, at: [150, 100, 1000]}]}
analysis: {flow_rule: associative}
"""


@pytest.mark.parametrize("parts", [9, 11])
def test_the_excess_of_points_that_also_bear_tension(tmp_path: Path, parts: int) -> None:
    """Blocks of fc on a and of ft on h - a: N = fc a b - ft (h - a) b, M = (fc + ft) b a (h - a)/2.

    Odd parts have their greatest excess in the middle, where a weight of next to nothing puts the end of the block.
    """
    path = tmp_path / "pier.yaml"
    path.write_text(PIER.replace("PARTS", str(parts)))
    results = run(path, RunOptions())
    b, h, strengths = 200.0, 300.0, 2.0 + 2.0
    a = (600.0 + 2.0 * b * h) / (strengths * b)
    moment = factor_of(results.cases[0]) * 1000 * 1000
    excess = moment - strengths * b * a * (h - a) / 2
    bound = strengths * b * h**2 / (8 * parts**2)
    assert 0.8 * bound < excess <= bound


@pytest.mark.parametrize(("count", "words"), [(1, "1 interface with a"), (2, "2 interfaces with a")])
def test_outlines_without_a_stress_block_are_counted(count: int, words: str) -> None:
    """Prisms over an L on each other and on the ground, and a box beside them, which has one."""
    outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
    tiers = [prism(outline, float(k), k + 1.0) for k in range(count)]
    blocks = blocks_of(join_polyhedra([*tiers, boxes(([5, 0, 0], [6, 1, 1]))]))
    model = model_of(blocks, grounds=(ground(),))
    assert program_notices(model, find_contacts(model, section()), "convex") == ()
    strong = replace(model, joints={"dry": Joint("dry", 0.65, compressive_strength=1e6)})
    (notice,) = program_notices(strong, find_contacts(strong, section()), "convex")
    assert notice.identifier == "crushing-by-points"
    assert notice.message.startswith(words)


def test_without_interfaces_there_is_nothing_to_say() -> None:
    model = model_of(blocks_of(boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]))))
    for contact_model in ("concave", "convex"):
        assert program_notices(model, find_contacts(model, section()), contact_model) == ()


@pytest.mark.parametrize(
    ("widths", "identifier"),
    [
        ((1.0, 0.4), "eccentric-crushing-overstated"),
        ((0.4, 1.0), "eccentric-crushing-overstated"),
        ((1.0, 1.0), "crushing-at-points"),
    ],
)
def test_one_interface_with_corners_alone_is_enough_for_the_warning(
    widths: tuple[float, float], identifier: str
) -> None:
    """At a spacing of 0.5 m a block 1 m wide has points between its corners, one of 0.4 m has none."""
    boxes = (
        f"  - box: {{group: block, material: stone, min: [{3 * k}, 0, 0], max: [{3 * k + width}, {width}, {width}]}}\n"
        for k, width in enumerate(widths)
    )
    start, rest = BLOCK.split("  - box")
    text = start + "".join(boxes) + rest[rest.index("supports:") :]
    line = line_of(text, "joints.dry.compressive_strength=1e6", "contacts.points.spacing=0.5")
    (notice,) = program_notices(line.model, line.contacts)
    assert notice.identifier == identifier
