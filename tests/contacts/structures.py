"""Small structures for the tests of the contacts stage."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts import Contacts, find_contacts
from mbla.deck.sections.contacts import ContactOverride, ContactsSection
from mbla.deck.units import Units
from mbla.model.model import Ground, Joint, Model
from mbla.model.solids.blocks import Blocks, labels_of
from mbla.model.solids.build import Labels, build_blocks
from mbla.model.solids.polyhedra import Polyhedra, cuboids, polyhedra_from_lists, take_polyhedra

DECKS = Path(__file__).parents[2] / "decks"


def blocks_of(polyhedra: Polyhedra, groups: Sequence[str] | None = None) -> Blocks:
    """Blocks of density 1."""
    names = tuple(groups) if groups is not None else ("block",) * len(polyhedra)
    built = build_blocks(polyhedra, Labels(names, np.ones(len(names)), labels_of(len(names))), 1e-3)
    assert not built.defects
    return built.blocks


def boxes(*extremes: tuple[Sequence[float], Sequence[float]]) -> Polyhedra:
    """Cuboids from pairs (least corner, greatest corner)."""
    array = np.array(extremes, dtype=np.float64)
    return cuboids(array[:, 0], array[:, 1])


def model_of(
    blocks: Blocks, fixed: Sequence[int] = (), grounds: tuple[Ground, ...] = (), units: Units | None = None
) -> Model:
    still = np.zeros(len(blocks), dtype=bool)
    still[list(fixed)] = True
    return Model(
        title="",
        units=units or Units(),
        blocks=blocks,
        fixed=still,
        grounds=grounds,
        joints={name: Joint(name, 0.65) for name in ("dry", "mortar", "lead")},
        load_cases=(),
        notices=(),
    )


def ground(
    point: Sequence[float] = (0, 0, 0),
    normal: Sequence[float] = (0, 0, 1),
    joint: str = "dry",
    blocks: Sequence[int] | None = None,
) -> Ground:
    direction = np.array(normal, dtype=np.float64)
    return Ground(
        point=np.array(point, dtype=np.float64),
        normal=direction / np.linalg.norm(direction),
        joint=joint,
        blocks=None if blocks is None else np.array(blocks, dtype=np.int64),
        label="ground",
    )


def section(tolerance: float = 1e-3, overrides: Sequence[tuple[str, str, str]] = ()) -> ContactsSection:
    return ContactsSection(
        joint="dry",
        tolerance=tolerance,
        overrides=[ContactOverride(between=(a, b), joint=joint) for a, b, joint in overrides],
    )


def contacts_of(
    polyhedra: Polyhedra,
    fixed: Sequence[int] = (),
    grounds: tuple[Ground, ...] = (),
    tolerance: float = 1e-3,
) -> Contacts:
    return find_contacts(model_of(blocks_of(polyhedra), fixed, grounds), section(tolerance))


def running_bond(units: int, courses: int) -> Polyhedra:
    """Wall of units 0.4 x 0.2 x 0.175, half units at the ends of odd courses; block 0 is the base slab."""
    length, thickness, height = 0.4, 0.2, 0.175
    least = [[0.0, 0.0, -height]]
    greatest = [[units * length, thickness, 0.0]]
    for course in range(courses):
        joints = np.arange(units + 1) * length if course % 2 == 0 else _half_bond(units, length)
        for left, right in itertools.pairwise(joints):
            least.append([left, 0.0, course * height])
            greatest.append([right, thickness, (course + 1) * height])
    return cuboids(np.array(least), np.array(greatest))


def _half_bond(units: int, length: float) -> FloatArray:
    return np.concatenate([[0.0], (np.arange(units) + 0.5) * length, [units * length]])


# Walls of Ferris and Tin-Loi by course, bottom to top, in units of 0.4 m; negative lengths are gaps.


def moved(
    polyhedra: Polyhedra, scale: float = 1.0, turn: FloatArray | None = None, shift: float | Sequence[float] = 0.0
) -> Polyhedra:
    """Scaled, turned by a rotation matrix, and shifted along (1, 1, 1) or by a vector."""
    rotation = np.eye(3) if turn is None else turn
    return Polyhedra(
        vertices=scale * polyhedra.vertices @ rotation.T + np.asarray(shift),
        vertex_start=polyhedra.vertex_start,
        loops=polyhedra.loops,
        loop_start=polyhedra.loop_start,
        face_start=polyhedra.face_start,
    )


def shuffled(polyhedra: Polyhedra, seed: int = 0) -> tuple[Polyhedra, IntArray]:
    """The polyhedra in another order, and the old number of each."""
    order = np.random.default_rng(seed).permutation(len(polyhedra))
    return take_polyhedra(polyhedra, order), order


def any_rotation(seed: int = 1) -> FloatArray:
    """A rotation matrix."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def prism(outline: Sequence[Sequence[float]], bottom: float, top: float) -> Polyhedra:
    """Vertical prism over a simple polygon."""
    n = len(outline)
    vertices = [[*p, z] for z in (bottom, top) for p in outline]
    faces: list[Sequence[int]] = [range(n), range(n, 2 * n)]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return polyhedra_from_lists([vertices], [faces])


def profile(outline: Sequence[Sequence[float]]) -> Polyhedra:
    """Prism from y = 0 to 1 over a simple polygon in the plane of x and z."""
    return moved(prism(outline, -1.0, 0.0), turn=np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]]))
