"""Points of application, use of joints and chains, against statics by hand."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.results.collapse.thrust import interface_chains, point_friction_use, thrust_lines, thrust_of
from mbla.solution.solution import Mechanics
from tests.line import line_of, solution_of
from tests.results.synthetic import cuboids, horizontal_contacts, tower_contacts, tower_mechanics, tower_model

DECKS = Path(__file__).parents[3] / "decks"
ARCH = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 2}}
blocks: [{arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, voussoirs: 15}}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""


def mechanics_of(solution: object) -> Mechanics:
    found = solution.mechanics  # type: ignore[attr-defined]
    assert isinstance(found, Mechanics)
    return found


def test_point_of_application_and_use_of_tower_and_brick() -> None:
    thrust = thrust_of(tower_model(), tower_contacts(), tower_mechanics().contact_forces)
    # the tower rocks about its edge x = 1; the brick's push at 0.25 m over a weight twice as large moves it by 0.125 m
    assert thrust.points == pytest.approx(np.array([[1, 0.5, 1], [4.625, 0.5, 0]]))
    assert thrust.eccentricity == pytest.approx([1.0, 0.25])
    assert thrust.friction_use == pytest.approx([0.5 / 0.65, 0.5 / 0.65])
    assert thrust.normal_forces == pytest.approx([10, 10])
    assert thrust.shear_forces == pytest.approx([5, 5])


def test_an_interface_without_force_has_no_point() -> None:
    forces = tower_mechanics().contact_forces.copy()
    forces[:4] = 0.0
    thrust = thrust_of(tower_model(), tower_contacts(), forces)
    assert thrust.carried.tolist() == [False, True]
    assert np.isnan(thrust.points[0]).all()
    assert np.isnan(thrust.eccentricity[0])
    assert np.isnan(thrust.friction_use[0])


def test_cohesion_and_unlimited_friction_count() -> None:
    model, contacts = tower_model(), tower_contacts()
    forces = tower_mechanics().contact_forces
    sticky = replace(model, joints=model.joints | {"dry": replace(model.joints["dry"], cohesion=3.5)})
    assert thrust_of(sticky, contacts, forces).friction_use == pytest.approx(0.5 * 10 / (6.5 + 3.5))
    rough = replace(model, joints=model.joints | {"dry": replace(model.joints["dry"], friction=np.inf)})
    assert thrust_of(rough, contacts, forces).friction_use == pytest.approx(0.0)
    assert np.isnan(point_friction_use(rough, contacts, forces)[[0, 3]]).all()


def test_tension_takes_from_cohesion_what_pressure_adds() -> None:
    model, contacts = tower_model(), tower_contacts()
    law = replace(model.joints["dry"], friction=0.5, cohesion=8.0, tensile_strength=4.0)
    model = replace(model, joints=dict.fromkeys(model.joints, law))
    forces = np.zeros((8, 3))
    forces[:, 0], forces[:, 1] = -1.0, 1.0  # each point allows 8/4 - 0.5
    thrust = thrust_of(model, contacts, forces)
    assert point_friction_use(model, contacts, forces) == pytest.approx(1 / 1.5)
    assert thrust.friction_use == pytest.approx(1 / 1.5)
    assert np.isnan(thrust.points).all()


def test_eccentricity_on_an_outline_that_turns_inwards() -> None:
    """An L of three unit squares: its hull has the edge x + y = 3 that is no side of it."""
    corners = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], float)
    contacts = horizontal_contacts([[0, 1]], [(0, 1, 0, 1, 0)])
    points = np.column_stack([corners, np.zeros(6)])
    contacts = replace(
        contacts,
        points=points,
        point_start=np.array([0, 6]),
        outline=np.array([6]),
        frames=np.tile(contacts.frames[0], (6, 1, 1)),
        centroids=np.array([[5 / 6, 5 / 6, 0.0]]),
        point_areas=np.full(6, 0.5),
    )
    at_inner_corner = np.zeros((6, 3))
    at_inner_corner[3, 0] = 7.0
    thrust = thrust_of(tower_model(), contacts, at_inner_corner)
    # along the diagonal the hull ends at (1.5, 1.5), 2/3 from the centroid in each direction; the corner is 1/6 off
    assert thrust.eccentricity == pytest.approx([0.25])


def test_thrust_line_of_an_arch_reaches_its_edge_at_the_four_hinges() -> None:
    line = line_of(ARCH)
    mechanics = mechanics_of(solution_of(line))
    thrust = thrust_of(line.model, line.contacts, mechanics.contact_forces)
    (chain,) = thrust_lines(rigid_bodies(line.model, line.contacts), thrust)
    assert sorted(chain.tolist()) == list(range(16))
    steps = np.diff(thrust.points[chain][:, 0])
    assert (steps > 0).all() or (steps < 0).all()
    assert np.sum(thrust.eccentricity > 1 - 1e-6) == 4
    assert thrust.eccentricity.max() == pytest.approx(1.0, abs=1e-8)
    assert np.nanmax(thrust.friction_use) < 1.0


def test_a_wall_is_no_chain_and_a_column_is_one_to_its_top() -> None:
    wall = line_of(
        ARCH.replace(
            "arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, "
            "voussoirs: 15}",
            "wall: {material: stone, unit: [0.4, 0.2, 0.2], length: 2, courses: 4}",
        )
    )
    assert interface_chains(rigid_bodies(wall.model, wall.contacts)) == ()
    tower = replace(
        tower_model(),
        blocks=cuboids([[0, 0, i] for i in range(3)], [[1, 1, i + 1] for i in range(3)], ("a", "b", "c")),
        fixed=np.zeros(3, dtype=bool),
        grounds=tower_model().grounds[:1],
    )
    contacts = horizontal_contacts([[3, 0], [0, 1], [1, 2]], [(0, 1, 0, 1, z) for z in range(3)])
    assert [chain.tolist() for chain in interface_chains(rigid_bodies(tower, contacts))] == [[0, 1, 2]]


def test_a_ring_of_blocks_closes() -> None:
    tower = replace(
        tower_model(),
        blocks=cuboids([[0, 0, i] for i in range(3)], [[1, 1, i + 1] for i in range(3)], ("a", "b", "c")),
        fixed=np.zeros(3, dtype=bool),
        grounds=(),
    )
    ring = horizontal_contacts([[0, 1], [1, 2], [0, 2]], [(0, 1, 0, 1, z) for z in range(3)])
    (chain,) = interface_chains(rigid_bodies(tower, ring))
    assert chain[0] == chain[-1]
    assert sorted(chain[1:].tolist()) == [0, 1, 2]
