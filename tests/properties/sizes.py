"""Models of another size, in other units, or of coordinates that are a little off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.join import polyhedra_of
from mbla.model.model import LoadCase
from tests.properties.rigid_motions import rebuilt, with_forces
from tests.properties.scenes import Scene, with_section


def scaled(scene: Scene, length: float, force: float) -> Scene | None:
    """All lengths and all forces times a factor each, stresses with them; the load factor stays.

    None where the deck has what is not followed here: a support that gives way, a table that tilts, interfaces by
    their corners.
    """
    model = scene.model
    cases = model.load_cases
    if model.interfaces is not None or any(case.question.tilts or not case.question.multiplies for case in cases):
        return None
    model = with_forces(model, force)
    blocks, polyhedra = model.blocks, polyhedra_of(model.blocks)
    polyhedra = replace(polyhedra, vertices=length * polyhedra.vertices)
    larger = rebuilt(blocks, polyhedra, scene.deck.contacts.tolerance)
    larger = replace(
        larger,
        densities=blocks.densities * force / length**3,
        added_masses=force * blocks.added_masses,
        added_mass_points=length * blocks.added_mass_points,
    )
    joints = {
        name: replace(
            joint,
            cohesion=joint.cohesion / length**2,
            tensile_strength=joint.tensile_strength / length**2,
            compressive_strength=joint.compressive_strength / length**2,
        )
        for name, joint in model.joints.items()
    }
    grounds = tuple(
        replace(
            ground,
            point=length * ground.point,
            outline=None if ground.outline is None else length * ground.outline,
        )
        for ground in model.grounds
    )
    motions = model.guides.motions.copy()
    motions[:, :3] *= length
    model = replace(
        model,
        blocks=larger,
        joints=joints,
        grounds=grounds,
        guides=replace(model.guides, motions=motions),
        mirrors=tuple((x, y, z, length * offset) for x, y, z, offset in model.mirrors),
        ties=replace(model.ties, places=length * model.ties.places),
        load_cases=tuple(_with_longer_arms(case, length) for case in model.load_cases),
    )
    overrides = [
        override
        if override.box is None
        else override.model_copy(update={"box": tuple(tuple(length * part for part in end) for end in override.box)})
        for override in scene.deck.contacts.overrides
    ]
    points = scene.deck.contacts.points
    points = points.model_copy(
        update={
            "rounding": length * points.rounding,
            "spacing": None if points.spacing is None else length * points.spacing,
        }
    )
    return replace(with_section(scene, overrides=overrides, points=points), model=model)


def _with_longer_arms(case: LoadCase, length: float) -> LoadCase:
    def longer(loads: FloatArray) -> FloatArray:
        return np.asarray(loads * np.repeat([1.0, length], 3))

    return replace(case, dead_load=longer(case.dead_load), live_load=longer(case.live_load))


def roughened(scene: Scene, share: float, seed: int) -> Scene:
    """Every corner off by up to a share of the size, corners at one place by the same; loads stay as they are."""
    model, random = scene.model, np.random.default_rng(seed)
    polyhedra = polyhedra_of(model.blocks)
    size = float(np.ptp(polyhedra.vertices, axis=0).max())
    places = np.unique(np.round(polyhedra.vertices / size, 6), axis=0, return_inverse=True)[1].ravel()
    off = share * size * random.uniform(-1.0, 1.0, (int(places.max()) + 1, 3))
    polyhedra = replace(polyhedra, vertices=polyhedra.vertices + off[places])
    blocks = rebuilt(model.blocks, polyhedra, scene.deck.contacts.tolerance)
    points, masses = model.blocks.added_mass_points, model.blocks.added_masses
    blocks = replace(blocks, added_masses=masses, added_mass_points=points)
    return replace(scene, model=replace(model, blocks=blocks))
