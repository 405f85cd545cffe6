from __future__ import annotations

from pathlib import Path

import pytest

from mbla.contacts import find_contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.build import program_notices
from mbla.results.series import factor_of
from mbla.run import RunOptions, run
from tests.contacts.structures import blocks_of, boxes, model_of, section
from tests.line import BLOCK, line_of


def test_joints_without_it_are_not() -> None:
    line = line_of(BLOCK)
    assert program_notices(line.model, line.contacts, line.deck.analysis) == ()


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
analysis: {flow_rule: associative, solver: mbla}
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


def test_what_crushes_as_stress_blocks_do_is_not_warned_of() -> None:
    """By default, with either flow rule; not with schemes and solvers that take points alone."""
    for ways, told in (
        ((), False),
        (("analysis.flow_rule=non_associative",), False),
        (("analysis.contact_model=convex",), False),
        (("analysis={flow_rule: non_associative, scheme: interior}",), True),
        (("analysis.solver=highs", "analysis.friction_cone=polyhedral"), True),
        (("analysis.solver=mbla",), True),
        (("analysis.force_ranges=true",), True),
    ):
        line = line_of(BLOCK, "joints.dry.compressive_strength=1e6", *ways)
        notices = program_notices(line.model, line.contacts, line.deck.analysis)
        assert [notice.identifier for notice in notices] == ["eccentric-crushing-overstated"] * told, ways


def test_without_interfaces_there_is_nothing_to_say() -> None:
    model = model_of(blocks_of(boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]))))
    assert program_notices(model, find_contacts(model, section()), AnalysisSection(solver="mbla")) == ()
