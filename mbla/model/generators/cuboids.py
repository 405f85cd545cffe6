"""Generators of single blocks, stacks of equal cuboids, and trilithons.

Harmonic overhang of a stack: with blocks of length l, the k-th from the top is shifted over the one below by s l/(2 k);
at s = 1 the blocks above each joint have their centre of gravity exactly over its edge.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.cuboids import BoxItem, PolyhedronItem, StackItem, TrilithonItem
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import cuboids, polyhedra_from_lists


def generate_box(item: BoxItem, site: Site) -> Generated:
    """The cuboid between two corners."""
    return Generated((Part(cuboids(np.array([item.min]), np.array([item.max]))),))


def generate_polyhedron(item: PolyhedronItem, site: Site) -> Generated:
    """The polyhedron as listed; faces in any orientation."""
    return Generated((Part(polyhedra_from_lists([item.vertices], [item.faces])),))


def generate_stack(item: StackItem, site: Site) -> Generated:
    """Blocks from the bottom."""
    shifts = np.concatenate([np.zeros((1, 2)), np.cumsum(_shifts(item), axis=0)])
    heights = item.block[2] * np.arange(item.count + 1)
    least = np.column_stack([shifts, heights[:-1]])
    greatest = np.column_stack([shifts + item.block[:2], heights[1:]])
    return Generated((Part(cuboids(least, greatest), labels={"drum": np.arange(item.count)}),))


def _shifts(item: StackItem) -> FloatArray:
    """Displacement along x and y of each block but the lowest from the one below, (count - 1, 2)."""
    shifts = np.zeros((item.count - 1, 2))
    if item.shift is not None:
        shifts[:] = item.shift
    elif item.offsets is not None:
        shifts[:, 0] = item.offsets
    elif item.overhang is not None:
        shifts[:, 0] = item.overhang * item.block[0] / (2.0 * np.arange(item.count - 1, 0, -1))
    return shifts


def generate_trilithon(item: TrilithonItem, site: Site) -> Generated:
    """Left upright, right upright, lintel."""
    upright, lintel = np.array(item.upright), np.array(item.lintel)
    left = np.array([[0.0, 0.0, 0.0], [upright[0] + item.opening, 0.0, 0.0]])
    middle = np.array([upright[0] + item.opening / 2, upright[1] / 2, upright[2] + lintel[2] / 2])
    least = np.array([middle - lintel / 2])
    least[0, 2] = upright[2]
    return Generated(
        (
            Part(cuboids(left, left + upright), member="upright", labels={"unit": np.arange(2)}),
            Part(cuboids(least, least + lintel), member="lintel"),
        )
    )
