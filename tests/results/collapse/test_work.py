from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.model.model import Joint
from mbla.results.collapse.mechanics import dissipated_by_joint, loads_by_group, work_of
from mbla.results.listing.forces import work_lines
from mbla.results.records.mechanism_json import mechanism_json
from mbla.solution.solution import Mechanics
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

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


@pytest.mark.parametrize("units", [1.0, 1e6])
def test_work_is_free_of_the_unit_of_force(units: float) -> None:
    """Forces times 1e6 and velocities by 1e-6, as the same structure in other units gives."""
    mechanics = sliding()
    scaled = replace(
        mechanics,
        contact_forces=units * mechanics.contact_forces,
        contact_velocities=mechanics.contact_velocities / units,
        mechanism=mechanics.mechanism / units,
    )
    case = replace(CASE, dead_load=units * CASE.dead_load, live_load=units * CASE.live_load)
    assert work_of(MODEL, CONTACTS, case, scaled).friction == pytest.approx([0, 0.65])


def words(model: Any, contacts: Any, mechanics: Mechanics) -> str:
    work = work_of(model, contacts, CASE, mechanics)
    return " ".join(" ".join(work_lines(model, contacts, CASE, mechanics, work)).split())


def test_work_in_words() -> None:
    text = words(MODEL, CONTACTS, sliding())
    assert "live load: 0.0 % work against the dead load, 100.0 % friction." in text
    contacts = replace(CONTACTS, joints=np.array([0, 1]), joint_names=("dry", "strong"))
    assert "strong 83.3 16.7 0.0" in words(MODEL, contacts, sliding())  # that law has cohesion
    model = replace(MODEL, joints={**MODEL.joints, "dry": Joint("dry", 0.65, cohesion=3.0)})
    assert "68.4 % friction, 31.6 % cohesion" in words(model, CONTACTS, sliding(3.0))


def test_no_shares_where_no_load_does_work() -> None:
    assert words(MODEL, CONTACTS, replace(sliding(), load_factor=0.0)) == ""


@pytest.mark.parametrize(
    ("factor", "shares"),
    [
        (0.5, "live load (33.3 %) and the dead load (66.7 %): 0.0 % friction"),
        (1e-9, "live load (0.0 %) and the dead load (100.0 %): 0.0 % friction"),
        (-0.5, "work of the dead load, which drives the mechanism: 50.0 % work against the live load, 0.0 % friction"),
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


def test_groups_that_move_have_their_share() -> None:
    mechanics = tower_mechanics()
    mechanism = mechanics.mechanism + sliding().mechanism
    text = words(MODEL, CONTACTS, replace(mechanics, mechanism=mechanism))
    assert "tower" in text
    assert "brick" in text


def test_mechanism_in_the_record() -> None:
    record = mechanism_json(MODEL, CONTACTS, CASE, tower_mechanics(), 3)
    assert {name: record[name] for name in ("open", "slide", "stick")} == {"open": 2, "slide": 0, "stick": 6}
    assert record["interfaces"] == {"stick": 1, "slide": 0, "open": 0, "hinge": 1, "twist": 0, "crush": 0}
    assert (record["hinges"], record["moving_parts"], record["moving_blocks"]) == (1, 1, 1)
    assert (record["reach"], record["moving_weight_share"]) == ("global", 0.5)
    assert record["parts"] == [
        {
            "part": 1,
            "blocks": 1,
            "groups": {"tower": 1},
            "weight": pytest.approx(10),
            "motion": "turns",
            "axis_point": pytest.approx([1, 0.5, 1]),
            "direction": [0, 1, 0],
        }
    ]
    assert record["work"]["live"] == pytest.approx(0.5)
    assert record["work"]["dead"] == pytest.approx(-0.5)
    assert record["work"]["groups"]["tower"]["dead"] == pytest.approx(-0.5)
