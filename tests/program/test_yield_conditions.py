"""Limits of contact points, and the warning where these overstate an interface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.contacts import find_contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.build import program_notices
from mbla.program.yield_conditions import CONDITIONS, Crushing, TensionCutOff, YieldLimits, yield_violation
from mbla.results.series import factor_of
from mbla.run import RunOptions, run
from tests.contacts.structures import blocks_of, boxes, model_of, section
from tests.line import BLOCK, line_of
from tests.program.random_points import mixed_program


def limits_of(mu: float = 0.5, c: float = 0.0, ft: float = 0.0, fc: float = np.inf) -> YieldLimits:
    return YieldLimits(*(np.array([value]) for value in (mu, 0.0, c, ft, fc)))


def force(n: float, t1: float = 0.0, t2: float = 0.0) -> FloatArray:
    return np.array([[n, t1, t2]])


@pytest.mark.parametrize("angle", np.linspace(0, 2 * np.pi, 13))
def test_the_friction_cone_is_round(angle: float) -> None:
    shear = np.array([np.cos(angle), np.sin(angle)])
    assert yield_violation(force(2.0, *shear), limits_of(mu=0.5))[0] == pytest.approx(0.0, abs=1e-15)
    assert yield_violation(force(2.0, *(1.25 * shear)), limits_of(mu=0.5))[0] == pytest.approx(0.25)


@pytest.mark.parametrize(
    ("x", "limits", "excess"),
    [
        (force(-0.1), limits_of(), 0.1),
        (force(-0.1), limits_of(mu=0.0), 0.1),
        (force(-0.1), limits_of(c=1.0, ft=0.1), 0.0),
        (force(-0.3), limits_of(c=1.0, ft=0.1), 0.2),
        (force(5.0), limits_of(fc=4.0), 1.0),
        (force(1.0, 1.6), limits_of(c=1.0), 0.1),
        (force(1e9), limits_of(), 0.0),
    ],
)
def test_excess_over_each_limit(x: FloatArray, limits: YieldLimits, excess: float) -> None:
    assert yield_violation(x, limits)[0] == pytest.approx(excess)


def test_dry_joints_need_no_row_for_tension_because_the_cone_ends_at_zero() -> None:
    assert not TensionCutOff.applies(limits_of(mu=0.5))[0]
    assert TensionCutOff.applies(limits_of(mu=0.5, c=1.0))[0]
    assert TensionCutOff.applies(limits_of(mu=0.0))[0]
    assert not Crushing.applies(limits_of())[0]


def test_scaling_leaves_friction_and_unlimited_compression_alone() -> None:
    scaled = limits_of(mu=0.5, c=2.0, ft=1.0).scaled(10.0)
    assert (scaled.friction[0], scaled.cohesion[0], scaled.tension[0]) == (0.5, 20.0, 10.0)
    assert np.isinf(scaled.compression[0])
    assert limits_of(fc=4.0).scaled(10.0).compression[0] == 40.0


def test_conditions_that_do_not_apply_are_implied_by_those_that_do() -> None:
    draw = np.random.default_rng(1)
    limits = mixed_program(3, 1).limits
    n = len(limits.friction)
    for _ in range(200):
        forces = draw.normal(scale=0.5, size=(n, 3))
        forces[draw.random((n, 3)) < 0.3] = 0.0
        left = np.full(n, np.inf)
        for condition in CONDITIONS:
            demand = np.linalg.norm(forces[:, 1:], axis=1) if condition.bounds_shear else 0.0
            room = condition.offset(limits) + condition.slope(limits) * forces[:, 0] - demand
            left = np.where(condition.applies(limits), np.minimum(left, room), left)
        assert np.array_equal(left >= 0, yield_violation(forces, limits) == 0)


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
    """By default, and with dilatancy; not with schemes and solvers that take points alone."""
    for ways, told in (
        ((), False),
        (("analysis.flow_rule=non_associative",), False),
        (("analysis.flow_rule=dilatancy",), False),
        (("analysis.contact_model=convex",), False),
        (("analysis={flow_rule: non_associative, scheme: published}",), True),
        (("analysis.solver=mbla",), True),
    ):
        line = line_of(BLOCK, "joints.dry.compressive_strength=1e6", *ways)
        notices = program_notices(line.model, line.contacts, line.deck.analysis)
        assert [notice.identifier for notice in notices] == ["eccentric-crushing-overstated"] * told, ways


def test_without_interfaces_there_is_nothing_to_say() -> None:
    model = model_of(blocks_of(boxes(([0, 0, 0], [1, 1, 1]), ([5, 0, 0], [6, 1, 1]))))
    assert program_notices(model, find_contacts(model, section()), AnalysisSection(solver="mbla")) == ()
