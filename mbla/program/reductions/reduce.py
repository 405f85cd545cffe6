"""What a scene requires: the program of a load case as programs of its parts, each as small as it may be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.lift import Lift
from mbla.program.program import Program
from mbla.program.reductions.mirror import MirrorPlane, half_of, mirror_about, mirror_candidates
from mbla.program.reductions.planar import is_planar, planar_program
from mbla.program.reductions.points import program_by_shares, without_inner_points
from mbla.program.reductions.restrict import guided_program, tidy
from mbla.program.reductions.scene import ProgramGeometry, scene_of, split_into_parts
from mbla.program.reductions.steps import ModelSize, ReductionStep, ReductionSwitches, size_of


@dataclass(frozen=True)
class Reduced:
    """The programs of the parts, in the order of their first blocks, and what was left out.

    interface_of_point : (n_points of the full program,)
    steps              : what each reduction did, in the order in which they were applied
    """

    parts: tuple[Program, ...]
    size: ModelSize
    interface_of_point: IntArray
    steps: tuple[ReductionStep, ...] = ()


def reduce_program(
    model: Model,
    contacts: Contacts,
    program: Program,
    switches: ReductionSwitches,
    *,
    associative: bool,
    by_interfaces: bool = False,
) -> Reduced:
    """Find and apply the reductions that are switched on.

    associative : only then may points inside the hull of others and one of two symmetric halves be left out, since
                  the answer is unique. A half is left out as well about a plane that the deck says to mirror it
    by_interfaces : conditions hold on interfaces: no half is left out whose interfaces are not images of one another
    """
    # guides come last, on what the other reductions leave; they have the same points
    scene, steps = _with_fewer_points(scene_of(model, contacts, program.full), switches, associative)
    scenes = split_into_parts(scene) if switches.on else [scene]
    steps += _steps_of_parts(scene, scenes, switches)
    smaller = [_reduced_part(part, switches, associative, model.mirrors, by_interfaces) for part in scenes]
    steps += _steps_of_planes(scenes, smaller, switches, associative or bool(model.mirrors))
    parts = [  # in the motions that guides allow, and forces by their shares of the area
        program_by_shares(part, _guided(part, own), own.way) for part, own in zip(scenes, smaller, strict=True)
    ]
    size = _model_size(scenes, [own.mirror for own in smaller], parts, program.n_points)
    return Reduced(tuple(parts), size, contacts.interface_of_point, tuple(steps))


def reduced_whole(scene: ProgramGeometry, switches: ReductionSwitches, given: Mirrors) -> Program:
    """The program of a structure that moves on: parts that cannot interact now may meet later.

    given : planes about which the deck says to mirror it
    """
    return _guided(scene, _reduced_part(scene, switches, False, given))


@dataclass(frozen=True)
class _Smaller:
    """The program of a part in the unknowns that planes of symmetry leave.

    way    : back from it to that of the part
    mirror : about which one half of it was left out; None for none
    """

    program: Program
    way: Lift
    mirror: MirrorPlane | None = None


def _with_fewer_points(
    scene: ProgramGeometry, switches: ReductionSwitches, associative: bool
) -> tuple[ProgramGeometry, list[ReductionStep]]:
    """Contact points that cannot matter left out."""
    allowed = switches.points and associative
    left = without_inner_points(scene) if allowed and switches.on else scene
    found = len(scene.points) - len(left.points)
    return left, [switches.step("points", allowed, found, size_of([scene.program]), size_of([left.program]))]


def _steps_of_parts(
    scene: ProgramGeometry, scenes: Sequence[ProgramGeometry], switches: ReductionSwitches
) -> list[ReductionStep]:
    """Parts without live load left out, blocks counted; parts with live load taken apart, parts counted."""
    before = size_of([scene.program])
    split = size_of([part.program for part in scenes])
    loaded = replace(split, largest=split.unknowns)
    n_loaded = sum(bool(np.any(part.program.live_load)) for part in scenes)
    left_out = len(scene.centroids) - sum(
        len(part.centroids) for part in scenes if np.any(part.program.live_load) or not n_loaded
    )
    return [
        switches.step("unloaded", True, left_out, before, loaded),
        switches.step("parts", True, n_loaded if n_loaded > 1 else 0, loaded, split),
    ]


def _steps_of_planes(
    scenes: Sequence[ProgramGeometry],
    smaller: Sequence[_Smaller],
    switches: ReductionSwitches,
    mirrored: bool,
) -> list[ReductionStep]:
    """Parts that are planar, and parts of which one half is solved, both counted.

    mirrored : halves may be left out at all
    """
    full = [part.program for part in scenes]
    left = [own.program for own in smaller]
    planar = [own if own.components == 2 else part for part, own in zip(full, left, strict=True)]
    n_planar = sum(program.components == 2 for program in planar)
    n_halved = sum(own.mirror is not None for own in smaller)
    sizes = size_of(full), size_of(planar), size_of(left)
    return [
        switches.step("planar", True, n_planar, sizes[0], sizes[1]),
        switches.step("mirror", switches.mirror and mirrored, n_halved, sizes[1], sizes[2]),
    ]


def _model_size(
    scenes: Sequence[ProgramGeometry], mirrors: Sequence[MirrorPlane | None], parts: Sequence[Program], n_points: int
) -> ModelSize:
    """What reaches the solver of a model with n_points contact points."""
    blocks = 0
    for scene, mirror in zip(scenes, mirrors, strict=True):
        own = np.arange(len(scene.centroids))
        blocks += len(own) if mirror is None else int(np.sum(mirror.block_of >= own))
    points = sum(part.n_points for part in parts)
    dimension = 2 if all(part.components == 2 for part in parts) else 3
    planes = int(any(mirror is not None for mirror in mirrors))
    return ModelSize(dimension, planes, len(parts), blocks, points, n_points - points)


def _reduced_part(
    part: ProgramGeometry, switches: ReductionSwitches, associative: bool, given: Mirrors, by_interfaces: bool = False
) -> _Smaller:
    """The planar program, that of one half with its mirror, or the part's own."""
    mirror = _first_mirror(part, given) if switches.on and len(part.points) else None
    if mirror is not None and is_planar(part, mirror):
        return _Smaller(*planar_program(part, mirror))
    if mirror is not None and by_interfaces and not mirror.keeps_interfaces(part.interfaces):
        mirror = None
    if mirror is not None and switches.mirror and (associative or _is_given(part, mirror.normal, given)):
        return _Smaller(*half_of(part, mirror), mirror)
    return _Smaller(part.program, Lift.identity(part.program))


def _guided(part: ProgramGeometry, smaller: _Smaller) -> Program:
    """The reduced program of a part, in the motions that its guides allow."""
    own, allowed = smaller.way.velocities, part.allowed
    if allowed is not None and smaller.program is not part.program:
        allowed = tidy(own.T @ allowed @ own)
    return guided_program(smaller.program, allowed)


OFF_PLANE = 1e-6
"""Distance of the middle of a part from a plane of symmetry, relative to block size, that is rounding: a part next to
the plane that happens to be symmetric about a parallel one is apart from it by the size of blocks."""

Mirrors = tuple[tuple[float, float, float, float], ...]


def _is_given(part: ProgramGeometry, normal: FloatArray, given: Mirrors) -> bool:
    """Whether the plane of that unit normal through the middle of a part is one of those given, up to rounding."""
    middle = part.centroids.mean(axis=0)
    for *direction, offset in given:
        along = float(normal @ np.array(direction))
        away = abs(float(np.array(direction) @ middle) - offset)
        if abs(abs(along) - 1.0) <= part.symmetric and away <= OFF_PLANE * part.length:
            return True
    return False


def _first_mirror(part: ProgramGeometry, given: Mirrors) -> MirrorPlane | None:
    """The first plane that makes the part planar, else the first plane of symmetry, those given before all others."""
    first = None
    for normal in (*(np.array(plane[:3]) for plane in given), *mirror_candidates(part)):
        mirror = mirror_about(part, normal)
        if mirror is None:
            continue
        if is_planar(part, mirror):
            return mirror
        first = first or mirror
    return first
