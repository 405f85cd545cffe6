"""The same mechanics stated in another way: place, direction, order, sizes of loads, ways of solving."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts import Contacts
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.loads import Load
from mbla.model import build_model
from mbla.model.solids.ragged import items_of_rows
from tests.properties.rigid_motions import moved_scene, renumbered, with_forces
from tests.properties.scenes import Scene, Solved, with_analysis


def rotation(axis: tuple[float, float, float], degrees: float) -> FloatArray:
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross, angle = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]), np.deg2rad(degrees)
    turn: FloatArray = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return turn


def _size(scene: Scene) -> float:
    return float(np.ptp(scene.model.blocks.vertices, axis=0).max())


def translate(scene: Scene, _: Solved) -> Scene:
    """By some lengths of the structure."""
    return moved_scene(scene, np.eye(3), _size(scene) * np.array([3.7, -2.3, 1.9]))


def rotate(scene: Scene, _: Solved) -> Scene | None:
    """With its loads; about the vertical where beds are told from heads, not where places are told by boxes."""
    if '"box"' in scene.section_text:
        return None
    return moved_scene(scene, turn_of(scene), np.zeros(3))


def turn_of(scene: Scene) -> FloatArray:
    """The rotation of ``rotate``."""
    level = '"bed"' in scene.section_text or '"head"' in scene.section_text
    return rotation((0, 0, 1), 33.0) if level else rotation((1, 2, -1), 71.0)


def reflection(_: Scene) -> FloatArray:
    """Of ``mirror``."""
    return np.diag([-1.0, 1.0, 1.0])


def mirror(scene: Scene, _: Solved) -> Scene:
    """In a plane across x: loads, moments, axes and guides with it."""
    return moved_scene(scene, reflection(scene), np.zeros(3))


def renumber(scene: Scene, _: Solved) -> Scene | None:
    """Blocks in a random order."""
    if '"index"' in scene.section_text or scene.model.interfaces is not None:
        return None
    order = np.random.default_rng(7).permutation(len(scene.model.blocks))
    return renumbered(scene, order)


def taken(contacts: Contacts, rows: IntArray) -> Contacts:
    """Some of the interfaces, in the order given."""
    points = items_of_rows(contacts.point_start, rows)
    return replace(
        contacts,
        bodies=contacts.bodies[rows],
        normals=contacts.normals[rows],
        areas=contacts.areas[rows],
        centroids=contacts.centroids[rows],
        gaps=contacts.gaps[rows],
        joints=contacts.joints[rows],
        point_start=starts(np.diff(contacts.point_start)[rows]),
        outline=contacts.outline[rows],
        points=contacts.points[points],
        frames=contacts.frames[points],
        point_areas=contacts.point_areas[points],
    )


def reverse_interfaces(scene: Scene, _: Solved) -> Scene:
    """The last interface first."""
    return replace(scene, change=lambda contacts: taken(contacts, np.arange(len(contacts))[::-1]))


def unloaded_by_scale(scene: Scene) -> bool:
    """A settlement or a tilting table: there is no live load to be scaled."""
    return any(case.question.tilts or not case.question.multiplies for case in scene.model.load_cases)


def live_load_times(scale: float) -> Callable[[Scene, Solved], Scene | None]:
    """A stronger live load."""

    def make(scene: Scene, _: Solved) -> Scene | None:
        if unloaded_by_scale(scene):
            return None
        cases = tuple(replace(case, live_load=scale * case.live_load) for case in scene.model.load_cases)
        return replace(scene, model=replace(scene.model, load_cases=cases))

    return make


PARTS_OF_A_LOAD = (0.3, 0.7)
"""factors of the two named loads that a load is divided into"""


def named_loads(scene: Scene, _: Solved) -> Scene | None:
    """In the deck: every load of every list as two named ones with a share each, and each list the two together.

    Loads at one position after another, and a table that tilts, are whole; a support that gives way has no live loads.
    """
    content = scene.deck.content
    kept = {case.name for case in scene.model.load_cases}
    if not kept <= set(content.load_cases) or any(_cannot_be_shared(case) for case in content.load_cases.values()):
        return None
    named, cases = dict(content.loads), {}
    for name, case in content.load_cases.items():
        lists = {side: loads for side in ("dead", "live") if (loads := getattr(case, side))}
        both = {side: [Load.model_validate({"loads": f"{name}_{side}_{part}"}) for part in range(2)] for side in lists}
        for side, loads in lists.items():
            for part, share in enumerate(PARTS_OF_A_LOAD):
                shared = [load.model_copy(update={"factor": share * load.factor}) for load in loads]
                named[f"{name}_{side}_{part}"] = shared
        cases[name] = case.model_copy(update=both)
    deck = replace(scene.deck, content=content.model_copy(update={"loads": named, "load_cases": cases}))
    model = build_model(deck)
    chosen = tuple(case for case in model.load_cases if case.name in kept)
    return replace(scene, deck=deck, model=replace(model, load_cases=chosen))


def _cannot_be_shared(case: LoadCaseSection) -> bool:
    return any(load.facts.live_only for load in case.live or [])


def heavier(scene: Scene, _: Solved) -> Scene:
    """All densities, forces and strengths times 37: accelerations stay as they are."""
    blocks = scene.model.blocks
    blocks = replace(blocks, densities=37.0 * blocks.densities, added_masses=37.0 * blocks.added_masses)
    return replace(scene, model=with_forces(replace(scene.model, blocks=blocks), 37.0))


def unreduced(scene: Scene, _: Solved) -> Scene:
    """Nothing left out before the solver."""
    return with_analysis(scene, reductions=False)


def other_solver(scene: Scene, solved: Solved) -> Scene | None:
    """Clarabel in place of the program's own method, or the other way round."""
    if solved.conditions:
        return None  # clarabel alone takes their cones
    taken_before = {program.solver for case in solved.cases for program in case.solution.programs}
    return with_analysis(scene, solver="mbla" if "clarabel" in taken_before else "clarabel")
