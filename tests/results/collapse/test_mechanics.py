"""Resultants, reactions and work."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.contacts.contacts import Contacts
from mbla.model.applied_load import without_forces
from mbla.model.model import Joint, Model
from mbla.results.collapse.mechanics import (
    dissipated_by_joint,
    interface_resultants,
    live_load_in_g,
    load_on_structure,
    loads_by_group,
    support_reactions,
    work_of,
)
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.listing.sections.forces import work_blocks
from mbla.results.listing.text import lines_of
from mbla.solution.solution import Mechanics
from tests.results.synthetic import (
    cuboids,
    horizontal_contacts,
    tower_contacts,
    tower_mechanics,
    tower_model,
)


@pytest.fixture(scope="module")
def model() -> Model:
    return tower_model()


@pytest.fixture(scope="module")
def contacts() -> Contacts:
    return tower_contacts()


@pytest.fixture(scope="module")
def mechanics() -> Mechanics:
    return tower_mechanics()


def test_resultants_carry_weight_and_push(model: Model, contacts: Contacts, mechanics: Mechanics) -> None:
    resultants = interface_resultants(contacts, mechanics.contact_forces)
    assert resultants[:, :3] == pytest.approx(np.array([[-5, 0, 10], [-5, 0, 10]]))
    # tower: 10 N at the edge, 0.5 m from the centroid of the bed; brick: the push at 0.25 m above it
    assert resultants[:, 3:] == pytest.approx(np.array([[0, -5, 0], [0, -1.25, 0]]))


def test_reactions_balance_the_loads(model: Model, contacts: Contacts, mechanics: Mechanics) -> None:
    reactions = support_reactions(model, contacts, mechanics.contact_forces)
    assert [reaction.support for reaction in reactions] == ["ground z = 0", "base[0]"]
    assert reactions[0].wrench[:3] == pytest.approx([-5, 0, 10])
    total = sum(reaction.wrench for reaction in reactions)
    load = load_on_structure(model, model.load_cases[0], 0.5)
    assert load[:3] == pytest.approx([10, 0, -20])
    assert total + load == pytest.approx(np.zeros(6), abs=1e-12)


def test_many_fixed_blocks_are_summed_by_group() -> None:
    n = 20
    lower = np.array([[i, 0, 0] for i in range(n)] + [[0, 0, 1]], float)
    upper = lower + 1
    upper[-1] = [n, 1, 2]
    blocks = cuboids(lower, upper, ["plinth"] * n + ["beam"])
    model = replace(tower_model(), blocks=blocks, fixed=np.array([True] * n + [False]), grounds=())
    contacts = horizontal_contacts([[i, n] for i in range(n)], [(i, i + 1, 0, 1, 1) for i in range(n)])
    forces = np.tile([0.25, 0, 0], (4 * n, 1))
    (reaction,) = support_reactions(model, contacts, forces)
    assert reaction.support == "plinth (fixed blocks)"
    assert reaction.wrench[:3] == pytest.approx([0, 0, n])
    few = replace(model, fixed=np.array([True] * 3 + [False] * (n - 2)))
    assert [each.support for each in support_reactions(few, contacts, forces)] == [f"plinth[{i}]" for i in range(3)]


def test_acceleration_counts_in_g(model: Model) -> None:
    case = model.load_cases[0]
    assert live_load_in_g(model, case) == pytest.approx(1.0)
    assert live_load_in_g(model, replace(case, live_load=2 * case.live_load)) == pytest.approx(2.0)
    one = case.live_load * np.array([0, 1, 0])[:, None]
    assert live_load_in_g(model, replace(case, live_load=one)) == pytest.approx(1.0)


def test_other_live_loads_do_not_count_in_g(model: Model) -> None:
    case = model.load_cases[0]
    assert live_load_in_g(model, replace(case, live=(without_forces("force (1, 0, 0) N on tower[0]"),))) is None
    assert live_load_in_g(model, replace(case, live=())) is None
    uneven = case.live_load * np.array([1, 1, 2])[:, None]
    assert live_load_in_g(model, replace(case, live_load=uneven)) is None
    assert live_load_in_g(model, replace(case, live_load=np.zeros((3, 6)))) is None


def chain(points: Any) -> tuple[Model, Contacts]:
    """A model of unit blocks about these centroids, each touching the next, between two fixed ones at the ends."""
    n = len(points)
    blocks = cuboids(np.array(points) - 0.1, np.array(points) + 0.1, ["arch"] * n)
    model = replace(tower_model(), blocks=blocks, fixed=np.array([True] + [False] * (n - 2) + [True]), grounds=())
    contacts = horizontal_contacts([[i, i + 1] for i in range(n - 1)], [(0, 1, 0, 1, 0)] * (n - 1))
    return model, contacts


def test_outside_of_a_curved_chain() -> None:
    """Centroids and joints on a half circle: outwards is away from its centre, at the ends too."""
    angles = np.linspace(np.pi, 0, 13)
    model, contacts = chain([[np.cos(a), 0, np.sin(a)] for a in angles])
    joints = (angles[1:] + angles[:-1]) / 2
    radii = np.column_stack([np.cos(joints), np.zeros(12), np.sin(joints)])
    normals = np.column_stack([np.sin(joints), np.zeros(12), -np.cos(joints)])
    sides = curvature_sides(rigid_bodies(model, replace(contacts, centroids=radii, normals=normals)))
    along = np.einsum("ij,ij->i", sides, radii) / np.linalg.norm(sides, axis=1)
    assert along[1:-1] == pytest.approx(1)
    assert (along[[0, -1]] > 0.9).all()


def test_a_pile_that_leans_over_has_no_outside() -> None:
    """Its joints lie on a curve, but are parallel: no voussoirs, no intrados."""
    model, contacts = chain([[0.1 * i**2, 0, i] for i in range(6)])
    joints = np.array([[0.1 * (i + 0.5) ** 2, 0, i + 0.5] for i in range(5)])
    assert not curvature_sides(rigid_bodies(model, replace(contacts, centroids=joints))).any()


# ---  ---------------------------------------------------------------------------------------------------------------


MODEL, CONTACTS = tower_model(), tower_contacts()
CASE = MODEL.load_cases[0]


def sliding(cohesion: float = 0.0) -> Mechanics:
    """The brick slides under μN + c, four points of N = 2.5 and a quarter of the area 1 each; λ = (μW + c)/W."""
    factor = 0.65 + cohesion / 10
    mechanism = np.zeros((3, 6))
    mechanism[2, 0] = 0.1
    velocities, forces = np.zeros((8, 3)), np.zeros((8, 3))
    velocities[4:, 1] = 0.1
    forces[4:] = [2.5, -(0.65 * 2.5 + cohesion / 4), 0]
    return replace(
        tower_mechanics(),
        load_factor=factor,
        mechanism=mechanism,
        contact_velocities=velocities,
        contact_forces=forces,
    )


def test_a_rocking_tower_is_lifted_and_nothing_else() -> None:
    work = work_of(MODEL, CONTACTS, CASE, tower_mechanics())
    assert (work.live, work.dead) == pytest.approx((0.5, -0.5))
    assert work.dissipated == pytest.approx([0, 0])


def test_a_sliding_brick_dissipates_at_its_bed() -> None:
    work = work_of(MODEL, CONTACTS, CASE, sliding())
    assert (work.live, work.dead) == pytest.approx((0.65, 0))
    assert work.friction == pytest.approx([0, 0.65])
    assert work.cohesion == pytest.approx([0, 0])


def test_friction_and_cohesion_are_told_apart() -> None:
    model = replace(MODEL, joints={**MODEL.joints, "dry": Joint("dry", 0.65, cohesion=3.0)})
    work = work_of(model, CONTACTS, CASE, sliding(3.0))
    assert work.live == pytest.approx(0.95)
    assert work.friction[1] == pytest.approx(0.65)
    assert work.cohesion[1] == pytest.approx(0.3)
    assert work.live + work.dead == pytest.approx(work.dissipated.sum())


def test_dilatancy_and_opening_against_strength_are_work_of_normal_forces() -> None:
    mechanics = sliding()
    velocities = mechanics.contact_velocities.copy()
    velocities[4:, 0] = 0.65 * 0.1  # associative flow lifts the brick
    work = work_of(MODEL, CONTACTS, CASE, replace(mechanics, contact_velocities=velocities))
    assert work.normal[1] == pytest.approx(-0.65)
    forces = mechanics.contact_forces.copy()
    forces[4:] = [-2.0, 0, 0]  # tension while it opens
    work = work_of(MODEL, CONTACTS, CASE, replace(mechanics, contact_velocities=velocities, contact_forces=forces))
    assert work.normal[1] == pytest.approx(4 * 2 * 0.065)


def test_shares_of_joint_laws_and_groups_sum_to_the_whole() -> None:
    contacts = replace(CONTACTS, joints=np.array([0, 1]), joint_names=("dry", "strong"))
    work = work_of(MODEL, contacts, CASE, sliding())
    joints = dissipated_by_joint(contacts, work)
    assert list(joints) == ["dry", "strong"]
    assert sum(map(sum, joints.values())) == pytest.approx(work.dissipated.sum())
    groups = loads_by_group(MODEL, CASE, sliding())
    assert groups["brick"] == pytest.approx((0.65, 0))
    assert groups["base"] == groups["tower"] == (0, 0)


def words(model: Any, contacts: Any, mechanics: Mechanics) -> str:
    work = work_of(model, contacts, CASE, mechanics)
    return " ".join(" ".join(lines_of(work_blocks(CASE, work))).split())


def test_work_in_words() -> None:
    text = words(MODEL, CONTACTS, sliding())
    assert "live load 100.0 %, dead load 0.0 %; dissipated: friction 100.0 %." in text
    model = replace(MODEL, joints={**MODEL.joints, "dry": Joint("dry", 0.65, cohesion=3.0)})
    assert "friction 68.4 %, cohesion 31.6 %" in words(model, CONTACTS, sliding(3.0))


@pytest.mark.parametrize(
    ("factor", "shares"),
    [
        (0.5, "live load 33.3 %, dead load 66.7 %; dissipated: friction 0.0 %"),
        (1e-9, "live load 0.0 %, dead load 100.0 %; dissipated: friction 0.0 %"),
        (-0.5, "live load -50.0 %, dead load 100.0 %; dissipated: friction 0.0 %"),
    ],
)
def test_a_dead_load_that_drives_is_a_source_too(factor: float, shares: str) -> None:
    """The brick falls while it is pushed: its weight gives W 0.1 = 1, whatever the load factor is."""
    mechanics = sliding()
    mechanism = mechanics.mechanism.copy()
    mechanism[2, 2] = -0.1
    falling = replace(
        mechanics, load_factor=factor, mechanism=mechanism, contact_velocities=np.zeros_like(mechanics.contact_forces)
    )
    assert shares in words(MODEL, CONTACTS, falling)
