"""Marks of contact forces: resultants of interfaces, lines of thrust, joints that are used up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import IntArray
from mbla.questions.in_time import InTime
from mbla.results.collapse.interface_modes import within_soil
from mbla.results.collapse.thrust import OUTSIDE
from mbla.results.listing.text import number
from mbla.results.pictures.marks.marks import Mark, dots, interface_names, segments
from mbla.results.pictures.page import HINGE, ORANGE, OTHER_END, PURPLE, RESULTANT, SLIDE, THRUST
from mbla.results.pictures.scene import PictureScene

SIDE = 0.7
"""length of a resultant over the size of the smaller block at its joint"""
THICKEST = 2.2
"""of the largest resultant, over other marks"""
LONGEST = 0.2
"""length of the largest over the size of the structure, where lengths show sizes"""
LEAST, MOST = 0.01, 400
"""share of the largest resultant from which others are drawn, and how many of the largest"""
MIDDLE_THIRD, EDGE = 1 / 3, 0.99
"""eccentricity beyond which a joint without tension is not pressed all over, and from which the force is at its edge"""
USED = 0.999
"""share of the friction from which all of it counts as used: forces are known to about a thousandth of it"""


def force_marks(scene: PictureScene, *, proportional: bool = False) -> list[Mark]:
    """Resultants of interfaces, the thicker, or the longer, the larger; lines of thrust; joints that are used up."""
    thrust, use = scene.thrust, scene.torsion_use
    if thrust is None or use is None or not thrust.carried.any():
        return []
    contacts, rows = scene.contacts, drawn_resultants(scene)
    texts = force_texts(scene)
    sizes = np.linalg.norm(thrust.forces, axis=1)
    blocks = np.append(scene.model.blocks.sizes, np.full(len(scene.model.grounds), np.inf))
    sides = np.minimum(blocks[contacts.bodies[rows]].min(axis=1), 0.2 * scene.size)
    half = SIDE / 2 * sides[:, None] * thrust.forces[rows] / sizes[rows, None]
    if proportional:
        half = LONGEST / 2 * scene.size * thrust.forces[rows] / sizes.max()
    ends = np.stack([scene.thrust_points[rows] - half, scene.thrust_points[rows] + half], axis=1)
    largest = f"resultant, section in proportion to the force, largest {number(float(sizes.max()))}"
    labels, widths = [texts[row] for row in rows.tolist()], THICKEST * np.sqrt(sizes[rows] / sizes[rows].max())
    name = f"{largest} {scene.model.units.force}"
    rods = segments(name, RESULTANT, ends, contacts.bodies[rows], labels, widths)
    found = [replace(rods, inside=True), *thrust_lines(scene, texts)]
    off = thrust.eccentricity
    for label, colour, chosen in (
        ("outside the middle third", ORANGE, (off > MIDDLE_THIRD) & (off < EDGE)),
        ("at the edge of the joint", HINGE, (off >= EDGE) & (off <= OUTSIDE)),
        ("outside the joint (tension), drawn at its edge", PURPLE, off > OUTSIDE),
        ("all friction used", SLIDE, use >= USED),
    ):
        at = np.flatnonzero(chosen & thrust.carried & ~within_soil(scene.model, scene.contacts))
        found.append(dots(label, colour, scene.thrust_points[at], contacts.bodies[at], [texts[row] for row in at]))
    return [mark for mark in found if len(mark.pairs)]


def drawn_resultants(scene: PictureScene) -> IntArray:
    """Interfaces whose resultants are drawn, (n,), in their order: the largest ones above the least share.

    Of soil of cells those on blocks and ground: what it presses on.
    """
    assert scene.thrust is not None  # asked for where there are forces
    sizes = np.where(scene.thrust.carried, np.linalg.norm(scene.thrust.forces, axis=1), 0.0)
    sizes[within_soil(scene.model, scene.contacts)] = 0.0
    order = np.argsort(-sizes, kind="stable")[:MOST]
    return np.sort(order[sizes[order] > LEAST * sizes.max(initial=0.0)])


def thrust_lines(scene: PictureScene, texts: Sequence[str]) -> list[Mark]:
    """Lines of thrust; of a force that is sought those of its other end as well, between which all others lie."""
    question, other = scene.case.load_case.question, scene.other_end
    if question.collapses:
        return [thrust_line(scene, texts, "line of thrust", THRUST)]
    if isinstance(question, InTime):
        return [thrust_line(scene, texts, "line of thrust, dead load", THRUST)]
    found = [thrust_line(scene, texts, f"line of thrust, {question.what}", THRUST)]
    if other is not None and other.thrust is not None:
        name = f"line of thrust, {other.case.load_case.question.what}"
        found.append(thrust_line(other, force_texts(other), name, OTHER_END, OTHER_LINE))
    return found


LINE, OTHER_LINE = 0.4, 1.0
"""thickness of lines of thrust that run inside resultants, and of those beside them"""


def thrust_line(scene: PictureScene, texts: Sequence[str], name: str, colour: str, width: float = LINE) -> Mark:
    """Lines of thrust along chains of blocks."""
    none = np.zeros((0, 2), dtype=np.int64)
    steps = np.concatenate([none, *(np.column_stack([line[:-1], line[1:]]) for line in scene.lines)])
    steps = steps[~within_soil(scene.model, scene.contacts)[steps].any(axis=1)]
    used, row = np.unique(steps, return_inverse=True)
    pairs = row.reshape(steps.shape)
    labels = tuple(texts[i] for i in used.tolist())
    points, bodies = scene.thrust_points[used], scene.contacts.bodies[used]
    return Mark(name, colour, points, bodies, pairs, np.full(len(pairs), width), labels, inside=True)


def force_texts(scene: PictureScene) -> list[str]:
    """Of every interface its forces in words."""
    thrust, unit = scene.thrust, scene.model.units.force
    assert thrust is not None  # asked for where there are forces
    columns = (thrust.normal_forces.tolist(), thrust.shear_forces.tolist(), thrust.eccentricity.tolist())
    return [
        f"{name}: normal force {number(normal)} {unit}, shear {number(shear)} {unit}, eccentricity {number(off)}"
        for name, normal, shear, off in zip(interface_names(scene.model, scene.contacts), *columns, strict=True)
    ]
