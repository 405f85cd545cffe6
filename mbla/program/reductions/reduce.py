"""What a scene requires: the program of a load case as programs of its parts, each as small as it may be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.deck.analysis import ReductionSwitches
from mbla.model.model import Model
from mbla.program.program import Program
from mbla.program.reductions.guided import guided_program
from mbla.program.reductions.half import half_of
from mbla.program.reductions.mirror import SYMMETRIC, Mirror, mirror_about, mirror_candidates
from mbla.program.reductions.parts import split_into_parts
from mbla.program.reductions.planar import is_planar, planar_program
from mbla.program.reductions.points import without_inner_points
from mbla.program.reductions.restrict import tidy
from mbla.program.reductions.scene import Scene, scene_of
from mbla.program.reductions.shares import program_by_shares


@dataclass(frozen=True)
class ModelSize:
    """What reached the solver.

    dimension     : 2 where the structure was solved as planar, else 3
    mirror_planes : planes of symmetry that were used besides, largest number of any part
    parts         : parts that cannot interact, solved apart
    free_blocks   : blocks with unknowns
    contact_points: points with unknowns
    dropped_points: points of the model that cannot matter, or follow from others by symmetry
    """

    dimension: int
    mirror_planes: int
    parts: int
    free_blocks: int
    contact_points: int
    dropped_points: int


@dataclass(frozen=True)
class Reduced:
    """The programs of the parts, in the order of their first blocks, and what was left out.

    interface_of_point : (n_points of the whole program,)
    point_areas        : (n_points of the whole program,)
    """

    parts: tuple[Program, ...]
    size: ModelSize
    interface_of_point: IntArray
    point_areas: FloatArray


def reduce_program(
    model: Model, contacts: Contacts, program: Program, switches: ReductionSwitches, *, associative: bool
) -> Reduced:
    """Find and apply the reductions that are switched on.

    associative : only then may points inside the hull of others and one of two symmetric halves be left out, since
                  the answer is unique. A half is left out as well about a plane that the deck says to mirror it
    """
    if program.guided and program.reduction is not None:
        program = program.reduction.full  # guides come last, on what the other reductions leave
    scene = scene_of(model, contacts, program)
    if switches.points and associative:
        scene = without_inner_points(scene)
    parts = split_into_parts(scene) if switches.parts else [scene]
    reduced, planes, blocks = [], 0, 0
    for part in parts:
        smaller, mirror = _reduced_part(part, switches, associative, model.mirrors)
        reduced.append(program_by_shares(part, _guided(part, smaller)))
        planes = max(planes, int(mirror is not None))
        own = np.arange(len(part.centroids))
        blocks += len(own) if mirror is None else int(np.sum(mirror.block_of >= own))
    points = sum(part.n_points for part in reduced)
    dimension = 2 if all(part.components == 2 for part in reduced) else 3
    size = ModelSize(dimension, planes, len(parts), blocks, points, program.n_points - points)
    return Reduced(tuple(reduced), size, contacts.interface_of_point, contacts.point_areas)


def _reduced_part(
    part: Scene, switches: ReductionSwitches, associative: bool, given: Mirrors
) -> tuple[Program, Mirror | None]:
    """The planar program, that of one half with its mirror, or the part's own."""
    mirror = _first_mirror(part, switches, given) if len(part.points) else None
    if mirror is None:
        return part.program, None
    if switches.planar and is_planar(part, mirror):
        return planar_program(part, mirror), None
    if switches.mirror and (associative or _is_given(part, mirror.normal, given)):
        return half_of(part, mirror), mirror
    return part.program, None


def _guided(part: Scene, smaller: Program) -> Program:
    """The reduced program of a part, in the motions that its guides allow."""
    if part.allowed is None:
        return smaller
    allowed = part.allowed
    if smaller is not part.program and smaller.reduction is not None:
        own = smaller.reduction.velocities
        allowed = tidy(own.T @ allowed @ own)
    return guided_program(smaller, allowed)


OFF_PLANE = 1e-6
"""Distance of the middle of a part from a plane of symmetry, relative to block size, that is rounding: a part beside
the plane that happens to be symmetric about a parallel one is apart from it by the size of blocks."""

Mirrors = tuple[tuple[float, float, float, float], ...]


def _is_given(part: Scene, normal: FloatArray, given: Mirrors) -> bool:
    """Whether the plane of that unit normal through the middle of a part is one of those given, up to rounding."""
    middle = part.centroids.mean(axis=0)
    for *direction, offset in given:
        along = float(normal @ np.array(direction))
        away = abs(float(np.array(direction) @ middle) - offset)
        if abs(abs(along) - 1.0) <= SYMMETRIC and away <= OFF_PLANE * part.length:
            return True
    return False


def _first_mirror(part: Scene, switches: ReductionSwitches, given: Mirrors) -> Mirror | None:
    """The first plane that makes the part planar, else the first plane of symmetry, those given before all others."""
    first = None
    for normal in (*(np.array(plane[:3]) for plane in given), *mirror_candidates(part)):
        mirror = mirror_about(part, normal)
        if mirror is None:
            continue
        if switches.planar and is_planar(part, mirror):
            return mirror
        first = first or mirror
    return first


def unreduced(program: Program, contacts: Contacts) -> Reduced:
    """The program as it is."""
    size = ModelSize(3, 0, 1, len(program.free), program.n_points, 0)
    return Reduced((program,), size, contacts.interface_of_point, contacts.point_areas)
