"""How far equilibrium determines the forces, and what of a model counts for its load factor."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.contacts import find_contacts
from mbla.errors import MblaError
from mbla.program import assemble
from mbla.results.collapse.force_freedom import ForceFreedom, enough_of, force_freedom
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.solution.solution import Mechanics, Status
from tests.analytic.planar import GROUND, Rectangle, force_range, rectangles_in_contact
from tests.line import BLOCK, HEAD, Line, case_of, line_of, line_of_file, verified
from tests.properties.random_decks import random_deck
from tests.results.no_contacts import without_contacts
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

WALL = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.6, courses: 4}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)
BEAM = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
  - box: {group: pier, material: stone, min: [4, 0, 0], max: [5, 1, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [5, 1, 3]}
  - box: {group: top, material: stone, min: [2, 0, 3], max: [3, 1, 3.5]}
supports: [{blocks: pier}]
load_cases:
  push: {live: [{force: [100, 0, 0], on: top}]}
analysis: {flow_rule: associative}
"""
)


def freedom(text: str, *overrides: str, dimension: int = 2) -> tuple[int, list[bool]]:
    line = line_of(text, *overrides)
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    found = force_freedom(rigid_bodies(line.model, line.contacts), solution.mechanics, dimension)
    assert isinstance(found, ForceFreedom)
    return found.degree, found.determined.tolist()


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_block_on_one_face_is_determinate(dimension: int) -> None:
    assert freedom(BLOCK, dimension=dimension) == (0, [True])


def test_a_beam_on_two_piers_is_indeterminate_in_the_plane_to_the_third_degree() -> None:
    """Only the small block on top slides; the beam rests on two faces, 6 resultants against 3 equations."""
    degree, determined = freedom(BEAM)
    assert degree == 3
    assert sorted(determined) == [False, False, True]


@pytest.mark.parametrize("overrides", [(), ("units.length=mm",)])
def test_in_space_the_same_beam_has_twelve_resultants_against_six_equations(overrides: tuple[str, ...]) -> None:
    """Four corners of the top block that slide one way carry N and two moments: its own equations fix these."""
    degree, determined = freedom(BEAM, *overrides, dimension=3)
    assert sum(determined) == 1
    assert degree == 6


def test_interfaces_called_determined_have_no_range() -> None:
    """Each range is the answer of two linear programs, next to the load factor; what is not determined has a width."""
    model, result = case_of(WALL)
    contacts, mechanics = line_of(WALL).contacts, result.solution.mechanics
    assert mechanics is not None
    found = force_freedom(rigid_bodies(model, contacts), mechanics, 2)
    assert isinstance(found, ForceFreedom)
    bricks = [Rectangle(*ends[[0, 2]].ravel()) for ends in np.stack(model.blocks.boxes, axis=2)]
    joints = rectangles_in_contact(bricks, 0.65)
    of_bodies = {frozenset((joint.a, joint.b)): number for number, joint in enumerate(joints)}
    weights, centroids = np.array([brick.area for brick in bricks]), np.array([brick.centroid for brick in bricks])
    loads = np.outer(weights, [(1.0 - 1e-9) * mechanics.load_factor, -1.0])
    ranges = []
    for bodies in contacts.bodies.tolist():
        joint = of_bodies[frozenset(body if body < len(bricks) else GROUND for body in bodies)]
        ranges.append(force_range(joints, centroids, loads, {joint: 1.0}, joints[joint].normal))
    widths = np.diff(ranges, axis=1).ravel()
    scale = float(np.abs(np.array(ranges)[np.isfinite(ranges)]).max())
    assert widths[found.determined].max() <= 1e-5 * scale < widths[~found.determined].min()
    assert found.determined.any()
    assert not found.determined.all()
    assert found.degree > 0


def test_what_is_guided_or_without_contact_is_not_judged() -> None:
    line = line_of_file(Path("decks/benchmarks/closed_forms/guided_blocks.yaml"))
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    assert len(line.model.guides.blocks)
    assert "guided" in str(force_freedom(rigid_bodies(line.model, line.contacts), solution.mechanics, 3))


def test_without_contacts_there_is_nothing_to_determine() -> None:
    contacts = without_contacts(tower_contacts())
    assert force_freedom(rigid_bodies(tower_model(), contacts), tower_mechanics(), 3) == "there are no contacts"


# --- Fixing what rests leaves the load factor: the smaller model is built and solved --------------------------------


DECKS = Path("decks")
ASSOCIATIVE = "analysis.flow_rule=associative"


def solved(line: Line) -> Mechanics:
    solution, checks, _ = verified(line)
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    return solution.mechanics


def with_rest_fixed(line: Line, mechanics: Mechanics) -> tuple[Line, int]:
    """The same line with every block at rest fixed, and how many free blocks are left."""
    parts = rigid_parts(line.model, rigid_bodies(line.model, line.contacts), mechanics.mechanism)
    guides = line.model.guides
    guided = parts[guides.blocks] > 0
    bodies = np.unique(guides.bodies[guided], return_inverse=True)[1].astype(np.int64)
    guides = replace(guides, blocks=guides.blocks[guided], bodies=bodies, motions=guides.motions[guided])
    model = replace(line.model, fixed=line.model.fixed | (parts == 0), guides=guides)
    contacts = find_contacts(model, line.deck.contacts)
    enough = enough_of(line.model, line.contacts, parts)
    assert len(contacts) == len(enough.interfaces)
    assert len(model.free) == len(enough.moving)
    assert len(enough.moving) + len(enough.bearing) + len(enough.left_out) == len(line.model.free)
    return replace(line, model=model, contacts=contacts, program=assemble(model, contacts, line.load_case)), len(
        model.free
    )


def test_blocks_by_what_they_do_for_what_moves() -> None:
    """The tower turns on its base, which is fixed; the brick rests by itself."""
    model, contacts = tower_model(), tower_contacts()
    enough = enough_of(model, contacts, rigid_parts(model, rigid_bodies(model, contacts), tower_mechanics().mechanism))
    assert enough.moving.tolist() == [1]
    assert enough.interfaces.tolist() == [0]
    assert enough.bearing.tolist() == []
    assert enough.left_out.tolist() == [2]


def same_with_rest_fixed(seed: int) -> bool:
    """Whether the deck had a verified answer; it must be that of the smaller model too."""
    deck = random_deck(seed) | {"output": {"vtu": False}, "analysis": {"flow_rule": "associative"}}
    try:
        line = line_of("\n" + json.dumps(deck))
    except MblaError:  # some say what cannot be
        return False
    if not len(line.contacts) or len(line.model.blocks) > 60 or not line.load_case.live_load[line.model.free].any():
        return False
    solution, _, status = verified(line)
    if status is not Status.SOLVED or solution.mechanics is None:
        return False
    smaller, _ = with_rest_fixed(line, solution.mechanics)
    assert solved(smaller).load_factor == pytest.approx(solution.mechanics.load_factor, rel=1e-6, abs=1e-9), seed
    return True


@pytest.mark.long
def test_random_decks_have_the_same_load_factor_with_the_rest_fixed() -> None:
    assert sum(map(same_with_rest_fixed, range(12))) >= 4


@pytest.mark.long
def test_many_random_decks_have_the_same_load_factor_with_the_rest_fixed() -> None:
    assert sum(map(same_with_rest_fixed, range(12, 120))) >= 40
