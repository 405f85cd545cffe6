"""Models moved, turned, mirrored, renumbered and under other loads: every array and vector of them in its own way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.join import polyhedra_of
from mbla.model.model import Ground, LoadCase, Model
from mbla.model.solids.blocks import BlockLabels, Blocks
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.polyhedra import Polyhedra, take_polyhedra, turn_faces
from mbla.model.ties.ties import OUTSIDE
from mbla.questions.angle import Angle
from mbla.questions.force import Force
from mbla.questions.reaction import Reaction
from mbla.questions.travel import Travel
from tests.asked import with_loads
from tests.properties.scenes import Scene, with_section


def rebuilt(blocks: Blocks, polyhedra: Polyhedra, tolerance: float) -> Blocks:
    """Blocks measured anew from other polyhedra of the same number, names and densities."""
    labels = Labels(blocks.groups, blocks.densities, blocks.labels)
    built = build_blocks(polyhedra, labels, tolerance)
    assert not built.defects, built.defects
    return built.blocks


def moved_scene(scene: Scene, matrix: FloatArray, shift: FloatArray) -> Scene:
    """The whole, x -> matrix x + shift; ``matrix`` orthogonal, of determinant 1 or -1 (the mirror image)."""
    model, side = scene.model, float(np.sign(np.linalg.det(matrix)))
    polyhedra = polyhedra_of(model.blocks)
    polyhedra = replace(polyhedra, vertices=polyhedra.vertices @ matrix.T + shift)
    if side < 0:
        polyhedra = turn_faces(polyhedra, np.ones(len(polyhedra.block_of_face), dtype=bool))
    blocks = rebuilt(model.blocks, polyhedra, scene.deck.contacts.tolerance)
    points = model.blocks.added_mass_points @ matrix.T + shift
    blocks = replace(blocks, added_masses=model.blocks.added_masses, added_mass_points=points)
    grounds = tuple(_moved_ground(ground, matrix, shift, side) for ground in model.grounds)
    mirrors = []
    for *normal, offset in model.mirrors:
        turned = matrix @ np.array(normal)
        mirrors.append((*turned.tolist(), offset + float(turned @ shift)))
    guides = replace(model.guides, motions=_wrenches(model.guides.motions, matrix, side))
    ties = replace(model.ties, places=model.ties.places @ matrix.T + shift, pulls=model.ties.pulls @ matrix.T)
    cases = tuple(_moved_case(case, matrix, side) for case in model.load_cases)
    model = replace(model, blocks=blocks, grounds=grounds, mirrors=tuple(mirrors), guides=guides, load_cases=cases)
    model = replace(model, ties=ties)
    if model.interfaces is not None:
        model = _moved_table(model, matrix, shift, side)
    return replace(_moved_overrides(scene, matrix, shift), model=model)


def _moved_ground(ground: Ground, matrix: FloatArray, shift: FloatArray, side: float) -> Ground:
    outline = ground.outline
    if outline is not None:  # counter-clockwise about the normal again
        outline = (outline @ matrix.T + shift)[:: 1 if side > 0 else -1]
    return replace(ground, point=matrix @ ground.point + shift, normal=matrix @ ground.normal, outline=outline)


def _moved_table(model: Model, matrix: FloatArray, shift: FloatArray, side: float) -> Model:
    given = model.interfaces
    assert given is not None
    corners = given.corners @ matrix.T + shift
    if side < 0:  # counter-clockwise about the normal again
        parts = [corners[a:b][::-1] for a, b in zip(given.corner_start[:-1], given.corner_start[1:], strict=True)]
        corners = np.vstack(parts)
    return replace(model, interfaces=replace(given, normals=given.normals @ matrix.T, corners=corners))


def _wrenches(values: FloatArray, matrix: FloatArray, side: float) -> FloatArray:
    """Forces and moments, or velocities and angular velocities, in the second axis of (n, 6, ...)."""
    turned = np.empty_like(values)
    turned[:, :3] = np.einsum("ij,nj...->ni...", matrix, values[:, :3])
    turned[:, 3:] = side * np.einsum("ij,nj...->ni...", matrix, values[:, 3:])
    return turned


def _moved_case(case: LoadCase, matrix: FloatArray, side: float) -> LoadCase:
    dead, live = (_wrenches(loads, matrix, side) for loads in (case.dead_load, case.live_load))
    match question := case.question:
        case Angle(tilt):
            turned = tilt.with_loads(lambda loads: _wrenches(loads, matrix, side))
            question = Angle(replace(turned, axis=side * (matrix @ tilt.axis)))
        case Force(_, objective):
            question = replace(question, objective=replace(objective, direction=matrix @ objective.direction))
        case Reaction(settlement):
            question = Reaction(replace(settlement, motions=_wrenches(settlement.motions, matrix, side)))
    return replace(case, dead_load=dead, live_load=live, question=question)


def _moved_overrides(scene: Scene, matrix: FloatArray, shift: FloatArray) -> Scene:
    overrides = []
    for override in scene.deck.contacts.overrides:
        changes: dict[str, object] = {}
        if override.orientation is not None and not isinstance(override.orientation, str):
            normal = tuple((matrix @ np.array(override.orientation.normal)).tolist())
            changes["orientation"] = override.orientation.model_copy(update={"normal": normal})
        if override.box is not None:
            ends = np.array(override.box) @ matrix.T + shift
            changes["box"] = (tuple(ends.min(axis=0).tolist()), tuple(ends.max(axis=0).tolist()))
        overrides.append(override.model_copy(update=changes))
    return with_section(scene, overrides=overrides)


def taken_blocks(blocks: Blocks, order: IntArray, tolerance: float) -> Blocks:
    """Blocks in another order."""
    labels = BlockLabels(tuple(blocks.labels.members[b] for b in order), blocks.labels.positions[order])
    named = Labels(tuple(blocks.groups[b] for b in order), blocks.densities[order], labels)
    built = build_blocks(take_polyhedra(polyhedra_of(blocks), order), named, tolerance)
    assert not built.defects, built.defects
    return replace(
        built.blocks,
        group_indices=blocks.group_indices[order],
        added_masses=blocks.added_masses[order],
        added_mass_points=blocks.added_mass_points[order],
    )


def renumbered(scene: Scene, order: IntArray) -> Scene:
    """Blocks in another order; block ``order[k]`` becomes block k."""
    model = scene.model
    new = np.empty(len(order), dtype=np.int64)
    new[order] = np.arange(len(order))
    cases = []
    for case in model.load_cases:
        question = case.question.on_bodies(new, lambda loads: loads[order], 0.0)
        match question:
            case Force(_, objective):
                of_blocks, of_grounds = np.split(objective.sides, [len(order)])
                sides = np.append(of_blocks[order], of_grounds)
                question = replace(question, objective=replace(objective, sides=sides))
            case Travel(place):
                question = Travel(replace(place, blocks=np.where(place.blocks < 0, -1, new[place.blocks])))
        dead, live = case.dead_load[order], case.live_load[order]
        cases.append(replace(case, dead_load=dead, live_load=live, question=question))
    grounds = tuple(
        ground if ground.blocks is None else replace(ground, blocks=np.sort(new[ground.blocks]))
        for ground in model.grounds
    )
    model = replace(
        model,
        blocks=taken_blocks(model.blocks, order, scene.deck.contacts.tolerance),
        fixed=model.fixed[order],
        grounds=grounds,
        guides=replace(model.guides, blocks=new[model.guides.blocks]),
        ties=model.ties.with_bodies(np.where(model.ties.bodies == OUTSIDE, OUTSIDE, new[model.ties.bodies])),
        load_cases=tuple(cases),
    )
    return replace(scene, model=model)


def with_forces(model: Model, times: float) -> Model:
    """Loads and strengths times a factor."""
    cases = []
    for case in model.load_cases:
        case = with_loads(case, lambda loads: times * loads)
        if isinstance(question := case.question, Reaction):
            own = question.settlement
            settlement = replace(own, unit=times * own.unit, reference=times * own.reference)
            case = replace(case, question=replace(question, settlement=settlement))
        cases.append(case)
    joints = {
        name: replace(
            joint,
            cohesion=times * joint.cohesion,
            tensile_strength=times * joint.tensile_strength,
            compressive_strength=times * joint.compressive_strength,
        )
        for name, joint in model.joints.items()
    }
    limits = {name: times * getattr(model.ties, name) for name in ("least", "greatest", "prestress")}
    return replace(model, load_cases=tuple(cases), joints=joints, ties=replace(model.ties, **limits))
