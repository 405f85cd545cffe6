"""Models with more blocks that say the same: a block in two glued halves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.contacts import ContactOverride
from mbla.deck.sections.materials import GLUED
from mbla.deck.sections.selectors import SelectorTerm
from mbla.model.join import polyhedra_of
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import BlockLabels, Blocks, join_labels
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_lists, take_polyhedra
from mbla.questions.force import Force
from tests.asked import with_loads
from tests.properties.cells import below, indexed
from tests.properties.scenes import Scene, with_section


def movable(model: Model) -> IntArray:
    """Blocks that are free and neither guided nor part of a support that gives way, largest first."""
    bound = model.fixed.copy()
    bound[model.guides.blocks] = True
    for case in model.load_cases:
        bound[case.question.giving_way] = True
    free = np.flatnonzero(~bound)
    order: IntArray = free[np.argsort(-model.blocks.volumes[free], kind="stable")]
    return order


def split_in_two(scene: Scene, askew: float) -> Scene | None:
    """The largest convex block as two halves glued to each other; all loads on it stay where they are.

    askew : angle in radians of the cut from a right angle to the longest extent of the block
    """
    model = scene.model
    chosen = [int(block) for block in movable(model) if model.blocks.convex[block]]
    if not chosen or model.interfaces is not None or model.mirrors:
        return None
    block = chosen[0]
    blocks = model.blocks
    polyhedra = polyhedra_of(blocks)
    rows = slice(blocks.vertex_start[block], blocks.vertex_start[block + 1])
    own = blocks.vertices[rows] - blocks.centroids[block]
    axes = np.linalg.svd(own - own.mean(axis=0))[2]
    normal = np.cos(askew) * axes[0] + np.sin(askew) * axes[1]
    halves = [_half(polyhedra, block, blocks.centroids[block], side * normal) for side in (1.0, -1.0)]
    n = len(blocks)
    order = np.arange(n)
    order[block] = n
    everything = join_polyhedra([polyhedra, *halves])
    everything = take_polyhedra(everything, np.append(order, n + 1))
    group = blocks.groups[block]
    own_labels = BlockLabels((blocks.labels.members[block],), blocks.labels.positions[[block]])
    labels = join_labels([blocks.labels, own_labels])
    index = sum(name == group for name in blocks.groups)
    named = Labels((*blocks.groups, group), np.append(blocks.densities, blocks.densities[block]), labels)
    built = build_blocks(everything, named, scene.deck.contacts.tolerance)
    assert not built.defects, built.defects
    arm = blocks.centroids[block] - built.blocks.centroids[block]
    added = np.append(blocks.added_masses, 0.0)
    points = np.vstack([blocks.added_mass_points, built.blocks.centroids[-1:]])
    larger = _with_blocks(model, replace(built.blocks, added_masses=added, added_mass_points=points), 1)
    grounds = tuple(
        ground
        if ground.blocks is None or block not in ground.blocks
        else replace(ground, blocks=np.append(ground.blocks, n))
        for ground in larger.grounds
    )
    cases = tuple(_on_side_of(block, n, _with_loads_moved(case, block, arm)) for case in larger.load_cases)
    position = int(np.sum([name == group for name in blocks.groups[:block]]))
    first, second = (SelectorTerm.model_construct(group=group, index=number) for number in (position, index))
    glue = ContactOverride(joint=GLUED, between=(first, second))
    scene = with_section(scene, overrides=[*scene.deck.contacts.overrides, glue])
    return replace(scene, model=replace(larger, grounds=grounds, load_cases=cases))


def _half(polyhedra: Polyhedra, block: int, point: FloatArray, normal: FloatArray) -> Polyhedra:
    """What of a convex polyhedron lies on the side of a plane that its normal points to."""
    faces = range(polyhedra.face_start[block], polyhedra.face_start[block + 1])
    loops = [polyhedra.loops[slice(*polyhedra.loop_start[face : face + 2])] for face in faces]
    cell = [polyhedra.vertices[loop] for loop in loops]
    size = float(np.ptp(np.vstack(cell), axis=0).max())
    vertices, indices = indexed(below(cell, -normal, -float(normal @ point)), size)
    return polyhedra_from_lists([np.array(vertices)], [indices])


def _with_blocks(model: Model, blocks: Blocks, count: int, fixed: tuple[bool, ...] = (False,)) -> Model:
    """The model with some more blocks at the end, on which nothing acts."""

    def longer(loads: FloatArray) -> FloatArray:
        return np.vstack([loads, np.zeros((count, 6))])

    cases = []
    for case in model.load_cases:
        cases.append(with_loads(case, longer))
    return replace(model, blocks=blocks, fixed=np.append(model.fixed, fixed), load_cases=tuple(cases))


def _on_side_of(block: int, new: int, case: LoadCase) -> LoadCase:
    """The load case with a new block on the same side of the cut as another one; grounds follow the blocks."""
    if not isinstance(case.question, Force):
        return case
    objective = case.question.objective
    sides = np.insert(objective.sides, new, objective.sides[block])
    return replace(case, question=replace(case.question, objective=replace(objective, sides=sides)))


def _with_loads_moved(case: LoadCase, block: int, arm: FloatArray) -> LoadCase:
    """Loads on a block about another point, which lies at -arm from the one before."""

    def moved(loads: FloatArray) -> FloatArray:
        loads = loads.copy()
        loads[block, 3:] += np.cross(arm, loads[block, :3])
        return loads

    return with_loads(case, moved)
