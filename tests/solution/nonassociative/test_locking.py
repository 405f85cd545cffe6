"""Proofs that a structure locks: found where it does, accepted by separate statics, refused when anything is off."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative import locking
from mbla.solution.nonassociative.locking import locking_forces
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.verification.lock import lock_failures
from tests.line import Line, line_of
from tests.solution.standing_structures import FIXED, LEVEL, bar, box, deck, groove, plane, plug, prism

SETTINGS = SolverSettings(tolerance=1e-8)
BEAM = bar("friction: 0.5", below=plane(0, 1, 0, 1))
SHELF = deck(
    "".join(box(i, i + 1, j, j + 1) for i in range(4) for j in range(4)),
    LEVEL + plane(0, 0, 1, 0) + plane(4, 0, -1, 0),
    "friction: 0.6",
)


def long_groove(friction: float) -> str:
    """A wedge in a V of two planes at 30 degrees: pushed along it locks from mu = 1/tan 30° = 1.73205 on."""
    c, s = math.cos(math.radians(30)), 0.5
    outline = [(0, 0), (1, s / c), (-1, s / c)]
    return deck(prism(outline, 4.0), plane(0, 0, -s, c) + plane(0, 0, s, c), f"friction: {friction}")


def pushed(text: str, direction: str) -> Line:
    """A deck with another live load."""
    return line_of(text, f"load_cases.push.live=[{{acceleration: {direction}}}]")


LOCKED = {
    "wedge pushed into its groove": (groove(0.5), "[0, 0, -1]"),
    "wedge pushed into a smooth groove": (groove(0), "[0, 0, -1]"),
    "wedge pushed along its groove": (long_groove(2), "[0, 1, 0]"),
    "wedge pushed along its groove, just locked": (long_groove(1.7321), "[0, 1, 0]"),
    "plug pushed into the narrow end": (plug(10, 0.5), "[0, 0, 1]"),
    "bar held by thrust alone": (bar("friction: 0.01"), "[0, 1, 0]"),
    "bar pushed against a wall": (BEAM, "[1, 0, 0]"),
    "block pressed on the ground, askew within its friction": (deck(box(0, 1, 0, 1)), "[0.4, 0.2, -1]"),
    "cohesion beside the point": (deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e4"), "[0, 0, -1]"),
    "blocks on a shelf": (SHELF, "[1, 0, 0]"),
    "blocks on a shelf, drawn off": (SHELF, "[0, 1, 0]"),
    "two parts": (deck(box(0, 1, 0, 1) + box(3, 4, 0, 2)), "[0, 0, -1]"),
}


@pytest.mark.parametrize("reduced", [False, True])
@pytest.mark.parametrize(("text", "direction"), LOCKED.values(), ids=LOCKED)
def test_forces_that_carry_every_multiple_are_found_and_accepted(text: str, direction: str, reduced: bool) -> None:
    line = pushed(text, direction)
    parts: tuple[Program, ...] = (line.program,)
    if reduced:
        switches = ReductionSwitches()
        parts = reduce_program(line.model, line.contacts, line.program, switches, associative=True).parts
    assert solve_associative(line.program, SETTINGS, lambda record: None).status is Status.UNBOUNDED
    lock = locking_forces(parts, SETTINGS, lambda record: None)
    assert lock is not None
    assert lock_failures(line.model, line.contacts, line.load_case, lock) == ()


FREE = {
    "wedge that dilatancy does not lock": (long_groove(1.732), "[0, 1, 0]"),
    "block pressed askew beyond its friction": (deck(box(0, 1, 0, 1)), "[0.6, 0, -1]"),
    "cohesion does not last": (deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e9"), "[1, 0, 0]"),
    "tensile strength does not last": (
        deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e9, tensile_strength: 1.e9"),
        "[0, 0, 1]",
    ),
    "a joint that crushes": (deck(box(0, 1, 0, 1), joint="friction: 0.5, compressive_strength: 1.e9"), "[0, 0, -1]"),
    "one of two parts": (deck(box(0, 1, 0, 1) + box(3, 4, 0, 2), joint="friction: 0.2"), "[0.3, 0, -1]"),
}


@pytest.mark.parametrize(("text", "direction"), FREE.values(), ids=FREE)
def test_nothing_is_found_where_the_live_load_brings_collapse(text: str, direction: str) -> None:
    assert locking_forces((pushed(text, direction).program,), SETTINGS, lambda record: None) is None


def test_forces_avoid_joints_that_crush() -> None:
    """A block on a fixed one and on the ground, of which the joint with the ground can crush."""
    text = deck(
        box(0, 1, 0, 1, group="fixed") + box(0, 2, 1, 2) + box(1, 2, 0, 1, group="post"), LEVEL.rstrip() + "\n" + FIXED
    )
    text = text.replace("supports:\n  - {ground: {", "supports:\n  - {joint: weak, ground: {").replace(
        "joints: {", "joints: {weak: {friction: 0.5, compressive_strength: 1.e8}, "
    )
    line = line_of(text, "load_cases.push.live=[{force: [0, 0, -1], on: {group: block, index: 0}, at: [0.4, 0.5, 2]}]")
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert lock is not None
    assert lock_failures(line.model, line.contacts, line.load_case, lock) == ()
    weak = np.isfinite(line.program.limits.compression)
    assert weak.any()
    assert np.all(lock[weak] == 0)


@pytest.fixture
def locked() -> tuple[Line, FloatArray]:
    line = pushed(BEAM, "[1, 0, 0]")
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert lock is not None
    return line, lock


def test_forces_that_do_not_balance_are_refused(locked: tuple[Line, FloatArray]) -> None:
    line, lock = locked
    (failure,) = lock_failures(line.model, line.contacts, line.load_case, lock * (1 + 1e-5))
    assert f"1e-05 of the live load of {line.model.blocks.name(0)} unbalanced" in failure


def test_forces_against_another_load_are_refused(locked: tuple[Line, FloatArray]) -> None:
    line, lock = locked
    assert lock_failures(line.model, line.contacts, line.load_case, -lock)


def test_tension_in_balance_is_refused(locked: tuple[Line, FloatArray]) -> None:
    """Drawn by the wall behind instead of pressed by the one in front: as much balance, and no lock."""
    line, lock = locked
    fallback = np.zeros_like(lock)
    frames, matrix = line.contacts.frames, line.program.equilibrium_matrix
    behind = (np.abs(line.contacts.points[:, 0]) < 1e-9) & (np.abs(frames[:, 0, 0]) > 0.9)
    normal = np.flatnonzero(behind) * 3
    live = line.program.live_load
    fallback.ravel()[normal] = np.linalg.lstsq(matrix[:, normal].toarray(), -live, rcond=None)[0]
    assert matrix @ fallback.ravel() == pytest.approx(-live, abs=1e-12)
    scaling = line.program.scaling
    drawn = scaling.forces(fallback) / scaling.live
    (failure,) = lock_failures(line.model, line.contacts, line.load_case, drawn)
    assert "yield conditions" in failure


def test_shear_beyond_friction_is_refused() -> None:
    """What the cohesion of the joint carries, and friction does not."""
    line = pushed(deck(box(0, 1, 0, 0.5), joint="friction: 0.5, cohesion: 1.e6"), "[0.4, 0, -1]")
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert lock is not None
    other = pushed(deck(box(0, 1, 0, 0.5), joint="friction: 0.35, cohesion: 1.e6"), "[0.4, 0, -1]")
    (failure,) = lock_failures(other.model, other.contacts, other.load_case, lock)
    assert "yield conditions" in failure


def test_force_on_a_joint_that_crushes_is_refused() -> None:
    line = pushed(deck(box(0, 1, 0, 1)), "[0, 0, -1]")
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert lock is not None
    weak = pushed(deck(box(0, 1, 0, 1), joint="friction: 0.5, compressive_strength: 1.e9"), "[0, 0, -1]")
    (failure,) = lock_failures(weak.model, weak.contacts, weak.load_case, lock)
    assert "yield conditions" in failure


def test_a_light_block_that_is_not_held_is_not_lost_in_the_mean() -> None:
    """Two blocks pressed down, one a millionth of the other: forces under the heavy one alone prove nothing."""
    line = pushed(deck(box(0, 0.01, 0, 0.01, width=0.01) + box(3, 4, 0, 1)), "[0, 0, -1]")
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert lock is not None
    assert lock_failures(line.model, line.contacts, line.load_case, lock) == ()
    lock[line.contacts.points[:, 0] < 1] = 0
    (failure,) = lock_failures(line.model, line.contacts, line.load_case, lock)
    assert "block[0]" in failure


def test_numbers_that_are_none_are_refused(locked: tuple[Line, FloatArray]) -> None:
    line, lock = locked
    lock[0, 0] = np.nan
    (failure,) = lock_failures(line.model, line.contacts, line.load_case, lock)
    assert "not finite" in failure


@pytest.mark.parametrize("failing", [1, 2, 3, 8, 9])
def test_forces_that_cannot_be_repaired_are_sought_again(failing: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the smallest ones first, then nearer to the limit of friction; what is found is proved all the same."""
    line = pushed(BEAM, "[1, 0, 0]")
    tries: list[int] = []

    def repair(program: Program, forces: FloatArray, factor: float) -> tuple[FloatArray, float] | None:
        tries.append(len(forces))
        return None if len(tries) <= failing else repaired_forces(program, forces, factor)

    monkeypatch.setattr(locking, "repaired_forces", repair)
    lock = locking_forces((line.program,), SETTINGS, lambda record: None)
    assert len(tries) == min(failing + 1, 9)
    if failing == 9:
        assert lock is None
    else:
        assert lock is not None
        assert lock_failures(line.model, line.contacts, line.load_case, lock) == ()
