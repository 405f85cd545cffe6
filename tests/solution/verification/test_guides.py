"""What the verification knows of guides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model
from mbla.model.supports.guides import Guides, joined, rigid_motions, slide, turn
from mbla.program import assemble
from mbla.solution.settings import solver_settings
from mbla.solution.solve import solve_parts
from mbla.solution.verification.statics import allowed_motion, left_to_balance, off_guides
from mbla.solution.verification.verify import verify
from tests.decks.folder import BENCHMARKS
from tests.line import unreduced
from tests.results.synthetic import tower_model

ARMS = np.array([1.0, 2.0, 0.5])


def guided(motions: np.typing.NDArray[np.float64], blocks: list[int], bodies: list[int]) -> Model:
    return replace(tower_model(), guides=Guides(np.array(blocks), np.array(bodies), motions))


def motions_of(*ways: np.typing.NDArray[np.float64]) -> np.typing.NDArray[np.float64]:
    motions = np.zeros((len(ways[0]), 6, 6))
    motions[:, :, : len(ways)] = np.stack(ways, axis=2)
    return motions


def test_what_a_guide_takes_does_not_count() -> None:
    ways = np.zeros((1, 6, 6))
    ways[0, [1, 2, 3], [0, 1, 2]] = 1.0
    model = guided(ways, [1], [0])
    wrenches = np.arange(1.0, 19.0).reshape(3, 6)
    left = left_to_balance(model, wrenches, ARMS)
    np.testing.assert_allclose(left[[0, 2]], wrenches[[0, 2]])
    np.testing.assert_allclose(left[1], [0, 8, 9, 10, 0, 0], atol=1e-12)


def test_a_turning_block_balances_the_moment_about_its_axis() -> None:
    axis, about = np.array([0.0, 1, 0]), np.array([1.0, 0, 1])
    model = tower_model()
    centroid = model.blocks.centroids[1]
    model = guided(motions_of(turn(axis, about, centroid[None])), [1], [0])
    force = np.array([0.0, 0, -3])
    through_axis = np.concatenate([force, np.cross(about - centroid, force)])
    wrenches = np.zeros((3, 6))
    wrenches[1] = through_axis
    np.testing.assert_allclose(left_to_balance(model, wrenches, ARMS), 0.0, atol=1e-12)
    wrenches[1, 4] += 2.0
    assert np.abs(left_to_balance(model, wrenches, ARMS)).max() > 0.1


def test_motions_are_projected_on_the_ways_of_the_body() -> None:
    model = tower_model()
    centroids = model.blocks.centroids[[1, 2]]
    model = guided(motions_of(slide(np.array([1.0, 0, 0]), 2), slide(np.array([1.0, 1, 0]), 2)), [1, 2], [0, 0])
    mechanism = np.zeros((3, 6))
    mechanism[1, :3], mechanism[2, :3] = [2, 1, 5], [4, 3, -5]
    moved = allowed_motion(model, mechanism, ARMS)
    np.testing.assert_allclose(moved[1:, :3], [[3, 2, 0], [3, 2, 0]], atol=1e-12)
    assert off_guides(model, moved, ARMS) < 1e-12
    assert off_guides(model, mechanism, ARMS) == 1.0
    whole = guided(rigid_motions(centroids.mean(axis=0), centroids), [1, 2], [0, 0])
    spinning = np.zeros((3, 6))
    spinning[1:] = turn(np.array([0.3, 0.4, 0.5]), np.array([7.0, 8, 9]), centroids)
    assert off_guides(whole, spinning, ARMS) < 1e-12
    spinning[1, 3] += 0.1
    assert off_guides(whole, spinning, ARMS) > 1e-3


def test_a_model_without_guides_is_left_alone() -> None:
    model, values = tower_model(), np.arange(18.0).reshape(3, 6)
    assert left_to_balance(model, values, ARMS) is values
    assert off_guides(model, values, ARMS) == 0.0


def test_joined_guides_keep_bodies_apart_and_blocks_once() -> None:
    ways = np.eye(6)[None].repeat(3, axis=0)
    first = Guides(np.array([4, 5, 6]), np.array([0, 1, 1]), ways, ("first",))
    second = Guides(np.array([5, 9, 8]), np.array([0, 0, 1]), 2 * ways, ("second",))
    both = joined(first, second)
    assert both.blocks.tolist() == [4, 6, 5, 9, 8]
    assert both.bodies.tolist() == [0, 1, 2, 2, 3]
    assert both.n_bodies == 4
    np.testing.assert_array_equal(both.motions[2:], 2 * ways)


def test_a_mechanism_against_a_guide_is_not_verified() -> None:
    """A solved case, with its mechanism turned across the guide by a thousandth."""
    deck = read_deck(BENCHMARKS["guided_blocks"])
    model = build_model(deck)
    contacts = find_contacts(model, deck.contacts)
    case = next(case for case in model.load_cases if case.name == "on_a_rail")
    solution = solve_parts(unreduced(assemble(model, contacts, case), contacts), solver_settings(deck.analysis))
    assert verify(Assembly(model, contacts), case, solution).verified
    assert solution.mechanics is not None
    mechanism = solution.mechanics.mechanism.copy()
    block = model.guides.blocks[[model.blocks.groups[b] == "on_a_rail" for b in model.guides.blocks]][0]
    mechanism[block, 1] += 1e-3 * np.abs(mechanism[block]).max()
    tampered = replace(solution, mechanics=replace(solution.mechanics, mechanism=mechanism))
    checks = verify(Assembly(model, contacts), case, tampered)
    assert not checks.verified
    assert checks.penetration > 5e-4
