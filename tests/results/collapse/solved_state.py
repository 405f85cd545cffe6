"""Model, contacts, forces and velocities of a load case, and the same moved, scaled, swapped and renumbered."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

import mbla
from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.contacts import Contacts
from mbla.errors import DeckError
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import BlockLabels, Blocks
from mbla.model.solids.ragged import items_of_rows
from mbla.solution.solution import Mechanics
from tests.properties.random_decks import random_deck
from tests.properties.random_items import Tree


@dataclass(frozen=True)
class State:
    """One load case; ``contact_model`` and ``dimension`` as it was solved."""

    model: Model
    contacts: Contacts
    load_case: LoadCase
    mechanics: Mechanics
    contact_model: str
    dimension: int


def states_of(seed: int) -> Iterator[State]:
    """Load cases of a random deck that have forces and a mechanism, solved to draft accuracy or better."""
    try:
        yield from states_of_deck(random_deck(seed) | {"output": {"vtu": False}})
    except DeckError:  # some say what cannot be
        return


def states_of_deck(deck: Tree) -> Iterator[State]:
    """The same of any deck."""
    results = mbla.run("\n" + json.dumps(deck)).records
    for case in results.cases:
        solution = case.solution
        if solution.mechanics is not None and len(results.contacts):
            model = results.model.of_case(case.load_case)
            size = solution.size
            dimension = 3 if size is None else size.dimension
            yield State(model, results.contacts, case.load_case, solution.mechanics, solution.contact_model, dimension)


# --- the same elsewhere -------------------------------------------------------------------------------------------


def moved(state: State, turn: FloatArray, shift: FloatArray) -> State:
    """Turned, then shifted; what is written in the frames of contact points stays."""
    model, contacts = state.model, state.contacts
    blocks = replace(
        model.blocks,
        vertices=model.blocks.vertices @ turn.T + shift,
        centroids=model.blocks.centroids @ turn.T + shift,
        added_mass_points=model.blocks.added_mass_points @ turn.T + shift,
        face_normals=model.blocks.face_normals @ turn.T,
    )
    grounds = tuple(
        replace(ground, point=turn @ ground.point + shift, normal=turn @ ground.normal) for ground in model.grounds
    )
    motions = model.guides.motions.copy()
    for part in (slice(3), slice(3, 6)):
        motions[:, part] = turn @ motions[:, part]
    mirrors = tuple(
        (*(turn @ plane[:3]).tolist(), plane[3] + float(turn @ plane[:3] @ shift)) for plane in model.mirrors
    )
    return replace(
        state,
        model=replace(
            model, blocks=blocks, grounds=grounds, guides=replace(model.guides, motions=motions), mirrors=mirrors
        ),
        contacts=replace(
            contacts,
            normals=contacts.normals @ turn.T,
            centroids=contacts.centroids @ turn.T + shift,
            points=contacts.points @ turn.T + shift,
            frames=contacts.frames @ turn.T,
        ),
        load_case=_with_loads(state.load_case, lambda loads: _turned(loads, turn)),
        mechanics=replace(state.mechanics, mechanism=_turned(state.mechanics.mechanism, turn)),
    )


def _turned(vectors: FloatArray, turn: FloatArray) -> FloatArray:
    return np.hstack([vectors[:, :3] @ turn.T, vectors[:, 3:] @ turn.T])


def _with_loads(load_case: LoadCase, change: object) -> LoadCase:
    assert callable(change)
    return replace(load_case, dead_load=change(load_case.dead_load), live_load=change(load_case.live_load))


def scaled(state: State, length: float, force: float) -> State:
    """In other units: lengths and forces multiplied, velocities such that the power of the live load stays 1."""
    model, contacts, mechanics = state.model, state.contacts, state.mechanics
    blocks = replace(
        model.blocks,
        vertices=model.blocks.vertices * length,
        centroids=model.blocks.centroids * length,
        added_mass_points=model.blocks.added_mass_points * length,
        volumes=model.blocks.volumes * length**3,
        densities=model.blocks.densities * force / length**3,
        added_masses=model.blocks.added_masses * force,
    )
    stress = force / length**2
    joints = {
        name: replace(
            law,
            cohesion=law.cohesion * stress,
            tensile_strength=law.tensile_strength * stress,
            compressive_strength=law.compressive_strength * stress,
        )
        for name, law in model.joints.items()
    }
    grounds = tuple(replace(ground, point=ground.point * length) for ground in model.grounds)
    loads = np.array([force] * 3 + [force * length] * 3)
    motions = model.guides.motions / np.array([1.0] * 3 + [length] * 3)[:, None]
    return replace(
        state,
        model=replace(
            model,
            blocks=blocks,
            joints=joints,
            grounds=grounds,
            guides=replace(model.guides, motions=motions),
            mirrors=tuple((*plane[:3], plane[3] * length) for plane in model.mirrors),
        ),
        contacts=replace(
            contacts,
            centroids=contacts.centroids * length,
            points=contacts.points * length,
            gaps=contacts.gaps * length,
            areas=contacts.areas * length**2,
            point_areas=contacts.point_areas * length**2,
        ),
        load_case=_with_loads(state.load_case, lambda values: values * loads),
        mechanics=replace(
            mechanics,
            contact_forces=mechanics.contact_forces * force,
            contact_velocities=mechanics.contact_velocities / force,
            mechanism=mechanics.mechanism / loads,
        ),
    )


# --- the same by other names --------------------------------------------------------------------------------------


def swapped(state: State, interfaces: IntArray) -> State:
    """Bodies a and b of some interfaces exchanged: normal, first tangent kept, second tangent turned round."""
    contacts, mechanics = state.contacts, state.mechanics
    chosen = np.zeros(len(contacts), dtype=bool)
    chosen[interfaces] = True
    point = np.arange(len(contacts.points))
    for i in interfaces.tolist():
        first = contacts.point_start[i]
        outline = slice(first, first + contacts.outline[i])
        point[outline] = point[outline][::-1]
    of_point = chosen[contacts.interface_of_point]
    signs = np.where(of_point[:, None], [-1.0, 1.0, -1.0], 1.0)
    across = np.where(of_point[:, None], [1.0, -1.0, 1.0], 1.0)
    return replace(
        state,
        contacts=replace(
            contacts,
            bodies=np.where(chosen[:, None], contacts.bodies[:, ::-1], contacts.bodies),
            normals=np.where(chosen[:, None], -1.0, 1.0) * contacts.normals,
            points=contacts.points[point],
            frames=signs[:, :, None] * contacts.frames[point],
            point_areas=contacts.point_areas[point],
        ),
        mechanics=replace(
            mechanics,
            contact_forces=across * mechanics.contact_forces[point],
            contact_velocities=across * mechanics.contact_velocities[point],
            modes=mechanics.modes[point],
        ),
    )


def renumbered(state: State, order: IntArray) -> State:
    """Block i of the new state is block ``order[i]`` of the old one."""
    model, contacts, mechanics = state.model, state.contacts, state.mechanics
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.arange(len(order))
    body = np.concatenate([number, len(order) + np.arange(len(model.grounds))])
    solids = contacts.solid_of_block
    if solids is not None:
        _, first, label = np.unique(solids[order], return_index=True, return_inverse=True)
        rank = np.empty(len(first), dtype=np.int64)
        rank[np.argsort(first)] = np.arange(len(first))
        solids = rank[label]
    load_case = _with_loads(state.load_case, lambda loads: loads[order])
    return replace(
        state,
        model=replace(
            model,
            blocks=_permuted(model.blocks, order),
            fixed=model.fixed[order],
            guides=replace(model.guides, blocks=number[model.guides.blocks]),
            grounds=tuple(
                ground if ground.blocks is None else replace(ground, blocks=np.sort(number[ground.blocks]))
                for ground in model.grounds
            ),
        ),
        contacts=replace(contacts, bodies=body[contacts.bodies], solid_of_block=solids),
        load_case=load_case,
        mechanics=replace(mechanics, mechanism=mechanics.mechanism[order]),
    )


def _permuted(blocks: Blocks, order: IntArray) -> Blocks:
    vertices, faces = items_of_rows(blocks.vertex_start, order), items_of_rows(blocks.face_start, order)
    number = np.empty(len(vertices), dtype=np.int64)
    number[vertices] = np.arange(len(vertices))
    corners = items_of_rows(blocks.loop_start, faces)
    return replace(
        blocks,
        vertices=blocks.vertices[vertices],
        vertex_start=starts(np.diff(blocks.vertex_start)[order]),
        loops=number[blocks.loops[corners]],
        loop_start=starts(np.diff(blocks.loop_start)[faces]),
        face_start=starts(np.diff(blocks.face_start)[order]),
        facet_of_face=blocks.facet_of_face[faces],
        face_normals=blocks.face_normals[faces],
        convex=blocks.convex[order],
        volumes=blocks.volumes[order],
        centroids=blocks.centroids[order],
        densities=blocks.densities[order],
        added_masses=blocks.added_masses[order],
        added_mass_points=blocks.added_mass_points[order],
        groups=tuple(blocks.groups[i] for i in order),
        group_indices=blocks.group_indices[order],
        labels=BlockLabels(tuple(blocks.labels.members[i] for i in order), blocks.labels.positions[order]),
    )
