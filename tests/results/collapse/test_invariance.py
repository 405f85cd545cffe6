"""What follows from forces and velocities does not depend on place, units, or the numbers of blocks and bodies.

Random decks are solved once; their result is then moved, scaled, renumbered, and read anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of
from mbla.results.collapse.force_freedom import _equilibrium, _plane_rows, _resultants, enough_of, force_freedom
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.mechanics import group_reactions, support_reactions
from mbla.results.collapse.thrust import NO_FORCE, thrust_lines, thrust_of
from mbla.results.collapse.torsion_use import torsion_use
from tests.results.collapse.solved_state import State, moved, renumbered, scaled, states_of, swapped

pytestmark = pytest.mark.long

FEW = (312, 316, 387, 398)
MANY = range(300, 420, 4)
TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
"""a rotation without any axis of the deck"""


def variants(state: State) -> dict[str, tuple[State, IntArray]]:
    """The state in other words, and for each the old number of every block."""
    n_blocks = len(state.model.blocks)
    same = np.arange(n_blocks)
    order = np.random.default_rng(n_blocks).permutation(n_blocks)
    size = float(np.ptp(state.model.blocks.vertices, axis=0).max())
    return {
        "turned": (moved(state, TURN, np.array([3.0, -2.0, 5.0]) * size), same),
        "far_away": (moved(state, np.eye(3), np.array([1e4, -3e4, 2e4]) * size), same),
        "millimetres": (scaled(state, 1e3, 1e-3), same),
        "kilometres": (scaled(state, 1e-3, 1e6), same),
        "swapped": (swapped(state, np.arange(0, len(state.contacts), 2)), same),
        "renumbered": (renumbered(state, order), order),
    }


def numbers(state: State, old: IntArray) -> dict[str, Any]:
    """All that has no direction and no unit; blocks by their old numbers."""
    model, contacts, mechanics = state.model, state.contacts, state.mechanics
    thrust = thrust_of(model, contacts, mechanics.contact_forces)
    collapse = collapse_of(Assembly(model, contacts), state.load_case, mechanics)
    failure = failure_of(model, contacts, collapse, mechanics)
    freedom = force_freedom(rigid_bodies(model, contacts), mechanics, state.dimension)
    enough = enough_of(model, contacts, collapse.parts)
    reactions = group_reactions(model, contacts, mechanics.contact_forces)
    return {
        "carried": thrust.carried,
        "eccentricity": thrust.eccentricity,
        "friction_use": thrust.friction_use,
        "torsion_use": torsion_use(model, contacts, mechanics.contact_forces, state.contact_model),
        "lines": {frozenset(line.tolist()) for line in thrust_lines(rigid_bodies(model, contacts), thrust)},
        "modes": collapse.interfaces.modes,
        "parts": partition(collapse.parts, old),
        "clusters": partition(failure.clusters, old),
        "explained": failure.explained,
        "turns": {
            (frozenset(old[motion.blocks].tolist()), motion.turns) for motion in (*collapse.motions, *failure.motions)
        },
        "hinges": [sorted(line.interfaces.tolist()) for line in failure.hinge_lines],
        "planes": [sorted(plane.interfaces.tolist()) for plane in failure.sliding_planes],
        "cracks": [sorted(crack.interfaces.tolist()) for crack in failure.cracks],
        "shares": np.array([line.share for line in failure.hinge_lines] + [crack.share for crack in failure.cracks]),
        "work": np.array([plane.power_share for plane in failure.sliding_planes]),
        "degree": None if isinstance(freedom, str) else freedom.degree,
        "determined": None if isinstance(freedom, str) else freedom.determined.tolist(),
        "enough": [sorted(old[blocks].tolist()) for blocks in (enough.moving, enough.bearing, enough.left_out)],
        "reaction_groups": {reaction.support for reaction in reactions},
    }


def partition(numbers: IntArray, old: IntArray) -> set[tuple[bool, frozenset[int]]]:
    """Which blocks are together, and whether at rest."""
    return {(bool(n == 0), frozenset(old[numbers == n].tolist())) for n in np.unique(numbers)}


def compare(first: dict[str, Any], other: dict[str, Any], name: str) -> None:
    for key, value in first.items():
        if isinstance(value, np.ndarray) and value.dtype == float:
            assert other[key] == pytest.approx(value, rel=1e-5, abs=1e-5, nan_ok=True), (name, key)
        elif isinstance(value, np.ndarray):
            assert other[key].tolist() == value.tolist(), (name, key)
        elif key in ("hinges", "planes", "cracks"):
            assert sorted(other[key]) == sorted(value), (name, key)
        else:
            assert other[key] == value, (name, key)


def check(seed: int) -> None:
    for state in states_of(seed):
        first = numbers(state, np.arange(len(state.model.blocks)))
        for name, (other, old) in variants(state).items():
            compare(first, numbers(other, old), name)
        check_use(state, first)
        check_partition(state)
        check_reactions(state)
        check_degree(state, first["degree"])


def check_use(state: State, found: dict[str, Any]) -> None:
    """No tension: the resultant acts within the outline; no more shear than allowed, with or without torsion."""
    forces = state.mechanics.contact_forces
    thrust = thrust_of(state.model, state.contacts, forces)
    noise = 1e-4 * np.abs(forces).max() / np.maximum(thrust.normal_forces, 1e-300)
    if forces[:, 0].min() >= -NO_FORCE * np.abs(forces).max():
        edge = np.nan_to_num(thrust.eccentricity) <= 1.0 + noise
        assert edge.all()
    both = np.isfinite(found["friction_use"])
    assert (found["friction_use"][both] <= found["torsion_use"][both] * (1 + 1e-9) + 1e-9).all()


def check_partition(state: State) -> None:
    """Every interface between clusters that hinges, slides or opens is told once, and no other is."""
    collapse, failure = told(state)
    modes = collapse.interfaces.modes
    of_body = np.append(failure.clusters, np.zeros(len(state.model.grounds), dtype=np.int64))
    apart = np.diff(of_body[state.contacts.bodies], axis=1)[:, 0] != 0
    for lines, kinds in (
        (failure.hinge_lines, [InterfaceMode.HINGE]),
        (failure.sliding_planes, [InterfaceMode.SLIDE, InterfaceMode.TWIST]),
        (failure.cracks, [InterfaceMode.OPEN]),
    ):
        members = [int(i) for line in lines for i in line.interfaces]
        assert sorted(members) == np.flatnonzero(np.isin(modes, kinds) & apart).tolist()


def told(state: State) -> tuple[Collapse, Failure]:
    collapse = collapse_of(Assembly(state.model, state.contacts), state.load_case, state.mechanics)
    return collapse, failure_of(state.model, state.contacts, collapse, state.mechanics)


def check_reactions(state: State) -> None:
    """By support and by group they sum to one force and moment."""
    forces = state.mechanics.contact_forces
    sums: list[FloatArray] = [
        np.sum([reaction.wrench for reaction in reactions(state.model, state.contacts, forces)], axis=0)
        for reactions in (support_reactions, group_reactions)
    ]
    assert sums[0] == pytest.approx(sums[1], abs=1e-9 * max(float(np.abs(sums[0]).max(initial=0.0)), 1e-300))


def check_degree(state: State, degree: int | None) -> None:
    """Unknown resultants less the rank of their equations, by all singular values."""
    if degree is None:
        return
    bodies = rigid_bodies(state.model, state.contacts)
    model, contacts, mechanism = bodies.model, bodies.contacts, state.mechanics.mechanism
    rows = _plane_rows(contacts, mechanism) if state.dimension == 2 else np.eye(6)
    assert rows is not None
    bases, owner = _resultants(model, contacts, state.mechanics, rows)
    matrix = _equilibrium(model, contacts, bases, owner, rows).toarray()
    assert degree == matrix.shape[1] - np.linalg.matrix_rank(matrix, tol=1e-5)


@pytest.mark.parametrize("seed", FEW)
def test_a_few(seed: int) -> None:
    check(seed)


@pytest.mark.parametrize("seed", MANY)
def test_many(seed: int) -> None:
    check(seed)
