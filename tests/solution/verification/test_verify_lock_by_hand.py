"""Forces that carry every multiple of a live load on one block: right, and wrong in one thing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.verification.lock import lock_failures
from tests.line import BLOCK, Line, line_of
from tests.solution.by_hand import cube, loaded, on_ground

# A block 1 x 1 x 0.5 on the ground, friction 1/2, pressed by 32 and pushed by 8 at its base: 8 N and 2 N a corner.


def block(joint: str = "friction: 0.5") -> Line:
    line = cube(joint)
    return replace(line, load_case=loaded(line.load_case, (0, 0, -1e6, 0, 0, 0), (8, 0, -32, 0, -2, 0)))


@pytest.fixture(scope="module")
def dry() -> Line:
    return block()


def failures(line: Line, normal: float = 8.0, shear: float = 2.0) -> tuple[str, ...]:
    lock = on_ground(line.model, line.contacts, (normal, -shear, 0))
    return lock_failures(line.model, line.contacts, line.load_case, lock)


def test_the_exact_forces(dry: Line) -> None:
    assert failures(dry) == ()


def size_of_the_load() -> float:
    """The moment counts over the lever arm of 3/4."""
    return float(np.sqrt(8.0**2 + 32.0**2 + (2.0 / 0.75) ** 2))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_millionth_of_the_live_load_may_be_left(side: float, dry: Line) -> None:
    size = size_of_the_load()
    assert failures(dry, 8.0 + 0.99e-6 * side * size / 4) == ()
    for share in (1.01e-6, 0.25):
        (failure,) = failures(dry, 8.0 + share * side * size / 4)
        assert failure == (
            f"the forces that should show that the structure locks leave {share:.2g} of the live load of block[0] "
            "unbalanced"
        )


@pytest.mark.parametrize("normal", [8.0, -8.0])
def test_forces_the_wrong_way_round(normal: float, dry: Line) -> None:
    for shear in (2.0, -2.0):
        assert (failures(dry, normal, shear) == ()) == (normal > 0 and shear > 0)


def test_no_more_shear_than_friction(dry: Line) -> None:
    """Without a normal force: 32 of a push alone, and a millionth of it at each corner."""
    beyond = ("the forces that should show that the structure locks do not stay within the yield conditions",)
    for shear, expected in ((4.0, ()), (4.1, beyond), (-4.1, beyond)):
        case = loaded(dry.load_case, (0, 0, 0, 0, 0, 0), (4 * shear, 0, -32, 0, -shear, 0))
        assert failures(replace(dry, load_case=case), shear=shear) == expected
    for pull, expected in ((1e-6, ()), (1e-3, beyond), (8.0, beyond)):
        case = loaded(dry.load_case, (0, 0, 0, 0, 0, 0), (0, 0, 4 * pull, 0, 0, 0))
        if pull == 1e-6:
            case = replace(case, live_load=case.live_load + np.array([[0, 0, -32, 0, 0, 0]]))
        found = failures(replace(dry, load_case=case), -pull if pull != 1e-6 else 8 - pull, 0.0)
        assert found == expected


def test_excess_is_a_millionth_of_the_load(dry: Line) -> None:
    """Of which the shear on each corner may be beyond its friction."""
    for excess, held in ((0.99e-6, True), (1.01e-6, False)):
        shear = 4.0 + excess * np.hypot(32.0, np.hypot(16.0, 4.0 / 0.75))
        case = loaded(dry.load_case, (0, 0, 0, 0, 0, 0), (4 * shear, 0, -32, 0, -shear, 0))
        assert (failures(replace(dry, load_case=case), shear=shear) == ()) == held


def test_cohesion_and_tension_do_not_last() -> None:
    mortar = block("friction: 0.5, cohesion: 1.e6, tensile_strength: 1.e6")
    assert failures(mortar) == ()
    case = loaded(mortar.load_case, (0, 0, 0, 0, 0, 0), (24, 0, -32, 0, -6, 0))
    assert len(failures(replace(mortar, load_case=case), shear=6.0)) == 1


def test_what_crushes_bears_nothing_for_ever() -> None:
    weak = block("friction: 0.5, compressive_strength: 1.e9")
    assert len(failures(weak)) == 1
    assert "yield conditions" in failures(weak)[0]


def test_without_a_live_load_on_what_can_move_there_is_nothing_to_carry(dry: Line) -> None:
    none = ("there is no live load on blocks that can move",)
    unloaded = replace(dry, load_case=loaded(dry.load_case, (0, 0, -32, 0, 0, 0), (0, 0, 0, 0, 0, 0)))
    assert failures(unloaded, 0.0, 0.0) == none


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_numbers_that_are_none(number: float, dry: Line) -> None:
    assert failures(dry, number) == ("the forces that should show that the structure locks are not finite",)


@pytest.mark.parametrize("pressure", [2.0**30, 2.0**36, 2.0**60])
def test_of_large_forces_more_may_be_rounding_but_not_all_of_a_load(pressure: float) -> None:
    """Between two walls that press at each of eight corners: 1e-12 of that, up to 1e-3 of the load, and 1e-6 of it."""
    line = cube(supports="{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}")
    line = replace(line, load_case=loaded(line.load_case, (0, 0, 0, 0, 0, 0), (0, 0, -32, 0, 0, 0)))
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    allowed = 1e-6 * 32 + min(1e-12 * 8 * pressure, 1e-3 * 32)
    for left, held in ((0.99 * allowed, True), (1.01 * allowed, False), (32.0, False)):
        hung = sign[:, None] * np.array([0.0, 0.0, (32.0 - left) / 8])
        lock = np.einsum("pjx,px->pj", line.contacts.frames, hung)
        lock[:, 0] = pressure
        assert (lock_failures(line.model, line.contacts, line.load_case, lock) == ()) == held


@pytest.fixture(scope="module")
def pair() -> Line:
    """Two blocks side by side, pressed by 32 and by 2."""
    text = BLOCK.replace(
        "blocks:\n", "blocks:\n  - box: {group: light, material: stone, min: [5, 0, 0], max: [6, 1, 1]}\n"
    )
    line = line_of(text)
    live = np.zeros((2, 6))
    live[:, 2] = -32.0, -2.0
    return replace(line, load_case=replace(line.load_case, live_load=live))


@pytest.mark.parametrize(("block", "load"), [(0, 32.0), (1, 2.0)])
def test_the_block_that_is_off_by_most_of_its_own_load_is_named(block: int, load: float, pair: Line) -> None:
    contacts = pair.contacts
    here = (contacts.bodies[contacts.interface_of_point] == block).any(axis=1)
    lock = np.zeros((len(contacts.points), 3))
    lock[:, 0] = np.where(here, load / 4, (34.0 - load) / 4)
    assert lock_failures(pair.model, contacts, pair.load_case, lock) == ()
    lock[here, 0] *= 1.25
    lock[~here, 0] *= 1.125
    (failure,) = lock_failures(pair.model, contacts, pair.load_case, lock)
    assert f"leave 0.25 of the live load of {pair.model.blocks.name(block)} " in failure


def test_one_point_beyond_its_friction_is_enough(pair: Line) -> None:
    """Two corners sheared against each other along the line between them, in balance."""
    contacts = pair.contacts
    lock = on_ground(pair.model, contacts, (0, 0, 0))
    lock[:, 0] = np.where((contacts.bodies[contacts.interface_of_point] == 0).any(axis=1), 8.0, 0.5)
    assert lock_failures(pair.model, contacts, pair.load_case, lock) == ()
    light = np.flatnonzero(lock[:, 0] == 0.5)
    first, second = light[0], light[1]
    along = contacts.points[second] - contacts.points[first]
    along /= np.linalg.norm(along)
    lock[first, 1:] = 0.3 * (contacts.frames[first] @ along)[1:]
    lock[second, 1:] = -0.3 * (contacts.frames[second] @ along)[1:]
    (failure,) = lock_failures(pair.model, contacts, pair.load_case, lock)
    assert "yield conditions" in failure
