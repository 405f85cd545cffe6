"""Drawings in space of each kind: model, forces, mechanism."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.collapse.motion import largest_displacements
from mbla.results.collapse.thrust import OUTSIDE, Thrust
from mbla.results.listing.text import counted, number
from mbla.results.pictures.page import FIXED_BLOCK, GHOST, PURPLE, REST, SKY, THRUST, group_colours, pale
from mbla.results.pictures.scene import OUTSIDE_WORDS, Scene, named_groups, part_colours
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.loads import load_shapes
from mbla.results.pictures.space.shapes import (
    SLAB,
    ColourScale,
    Drawing,
    Faces,
    Shape,
    ghost_lines,
    interface_faces,
    rgb,
    rods,
    structure,
)


def model_drawing(scene: Scene) -> Drawing:
    """The structure at rest with everything that holds and loads it."""
    blocks, fixed = scene.model.blocks, scene.results.model.fixed
    tint = group_colours(blocks.groups)
    colours = [FIXED_BLOCK if held else tint[group] for group, held in zip(blocks.groups, fixed, strict=True)]
    free = {group for group, held in zip(blocks.groups, fixed, strict=True) if not held}
    legend, more = named_groups({group: colour for group, colour in tint.items() if group in free})
    legend += [("fixed blocks", FIXED_BLOCK)] * bool(fixed.any()) + [("ground", SLAB)] * bool(scene.slabs)
    marks, entries = load_shapes(scene, "model")
    solid = structure(scene, blocks.vertices, colours)
    extent = np.vstack([blocks.vertices, *scene.slabs, *(shape.points for shape in marks)])
    return Drawing(solid, tuple(marks), 0.5, extent, tuple(legend + entries), notes=(more,) * bool(more))


# --- Forces in space ------------------------------------------------------------------------------------------------


ECCENTRICITY = ("#FCE9A8", "#F6B73C", "#C8500F", "#5A1400")
"""from the middle of an interface to its edge; darker and darker, so that it reads in grey too"""
STEPS = 64
THICKEST = 0.011
"""radius of the rod of a large resultant over the diagonal of the structure"""
LIFT = 2e-4
"""distance of coloured interfaces from the faces of blocks, over the same"""
USUAL = 0.9
"""share of the rods that are thinner than that; the few largest forces, as in a corner, would make the rest threads"""
MOST_FACES = 60
"""interfaces up to which they are coloured themselves; of more the rods are, else there is nothing but faces to see"""
LEAST = 0.01
"""share of the largest resultant below which no rod is drawn: a tenth of the thickness, and it hides what matters"""
MOST_RODS = 400
"""rods of the largest resultants; more are a thicket in which none is seen"""


def forces_drawing(scene: Scene) -> Drawing:
    """Forces of the case at its load factor; where no load factor exists, those that lock the structure; else none."""
    thrust = scene.thrust
    vertices = scene.model.blocks.vertices
    colours = [pale(FIXED_BLOCK, 0.5) if fixed else pale(REST, 0.5) for fixed in scene.model.fixed]
    solid = structure(scene, vertices, colours, "#777777")
    marks: list[Shape] = []
    legend: list[tuple[str, str]] = []
    notes: tuple[str, ...] = ()
    scale = None
    if thrust is not None and thrust.carried.any():
        scale = ColourScale("eccentricity, 0 in the middle, 1 at the edge", 0.0, 1.0, ramp(np.linspace(0, 1, STEPS)))
        few = int(thrust.carried.sum()) <= MOST_FACES
        marks += [eccentricity_faces(scene, thrust)] * few + [resultant_rods(scene, thrust, few)]
        legend += [("resultant", SKY)] * few
        outside = thrust.eccentricity[drawn_resultants(thrust)] > OUTSIDE
        legend += [(OUTSIDE_WORDS, PURPLE)] * bool(outside.any())
        notes = (_sections(scene, thrust),)
        lines = thrust_tubes(scene)
        if lines is not None:
            marks.append(lines)
            legend.append(("line of thrust", THRUST))
    loads, entries = load_shapes(scene, "forces")
    legend += entries
    if scene.model.fixed.any():
        legend.append(("support", FIXED_BLOCK))
    extent = np.vstack([vertices, *scene.slabs, *(shape.points for shape in loads)])
    return Drawing(solid, tuple(marks + loads), 0.85, extent, tuple(legend), scale, notes)


def ramp(values: FloatArray) -> FloatArray:
    """Colours of eccentricities, (n, 3); beyond 1, which takes tensile strength, that of 1."""
    stops = np.array([rgb(colour) for colour in ECCENTRICITY])
    at = np.linspace(0, 1, len(stops))
    return np.column_stack([np.interp(values, at, stops[:, i]) for i in range(3)])


def eccentricity_faces(scene: Scene, thrust: Thrust) -> Faces:
    """Interfaces that carry a force, coloured by its eccentricity."""
    rows = np.flatnonzero(thrust.carried)
    points, start, loops = interface_faces(scene.contacts, scene.contacts.points, rows, np.zeros((len(rows), 3)))
    return Faces(points, start, loops, ramp(thrust.eccentricity[rows]), lit=False)


def resultant_rods(scene: Scene, thrust: Thrust, plain: bool) -> Faces:
    """Rods along resultants, through the points where they are drawn, with sections in proportion to the forces.

    They are as long as the blocks on both sides are large, so that they do not run into each other.

    plain : of one colour; else by the eccentricity of the force
    """
    sizes = np.linalg.norm(thrust.forces, axis=1)
    rows = drawn_resultants(thrust)
    half = 0.35 * _block_size(scene, rows)
    step = thrust.forces[rows] / sizes[rows, None] * half[:, None]
    usual = float(np.quantile(sizes[rows], USUAL))
    radii = np.minimum(THICKEST * scene.size, 0.25 * np.median(half)) * np.sqrt(sizes[rows] / usual)
    colours = np.tile(rgb(SKY), (len(rows), 1)) if plain else ramp(thrust.eccentricity[rows])
    colours[thrust.eccentricity[rows] > OUTSIDE] = rgb(PURPLE)
    points = scene.thrust_points[rows]
    return rods(points - step, points + step, radii, colours)


def _block_size(scene: Scene, rows: IntArray) -> FloatArray:
    """Of the smaller block of each interface, (n,) m."""
    sizes = np.append(scene.model.blocks.sizes, np.full(len(scene.model.grounds), np.inf))
    return np.asarray(sizes[scene.contacts.bodies[rows]].min(axis=1))


def thrust_tubes(scene: Scene) -> Faces | None:
    """Lines of thrust along chains of blocks as thin tubes."""
    if not scene.thrust_lines:
        return None
    starts = np.vstack([line[:-1] for line in scene.thrust_lines])
    ends = np.vstack([line[1:] for line in scene.thrust_lines])
    radii = np.full(len(starts), 0.0028 * scene.size)
    return rods(starts, ends, radii, np.tile(rgb(THRUST), (len(starts), 1)))


def drawn_resultants(thrust: Thrust) -> IntArray:
    """Interfaces whose resultants are drawn, (n,), in their order: the largest ones above the least share."""
    sizes = np.where(thrust.carried, np.linalg.norm(thrust.forces, axis=1), 0.0)
    order = np.argsort(-sizes, kind="stable")[:MOST_RODS]
    return np.sort(order[sizes[order] > LEAST * sizes.max()])


def _sections(scene: Scene, thrust: Thrust) -> str:
    """What the thickness of rods means, and which are left out."""
    sizes = np.linalg.norm(thrust.forces, axis=1)
    rows = drawn_resultants(thrust)
    small = int(thrust.carried.sum()) - len(rows)
    left = ""
    if small:
        most = float(sizes[np.setdiff1d(np.flatnonzero(thrust.carried), rows)].max() / sizes.max())
        left = f"; {counted(small, 'force')} up to {100 * most:.2g} % of it not drawn"
    largest = f"{number(float(sizes.max()))} {scene.model.units.force}"
    return f"section of rods in proportion to the force, largest {largest}{left}"


# --- The collapse mechanism in space --------------------------------------------------------------------------------


PARTS = ("#7FB2D6", "#F2C36B", "#B7DDF2", "#F4EE9B", "#5E97BF", "#E8A87C")
"""tints of parts that move; of more parts neighbours get different ones"""
STILL = 1e-4
"""displacement over the largest up to which a block is drawn as one at rest"""


def mechanism_drawing(scene: Scene, widest: Scene | None = None, seen: FloatArray | None = None) -> Drawing:
    """The structure as moved; at rest where no motion is known.

    widest : the same with the greatest displacement, where this is a frame of a film: marks keep its sizes
    seen   : (n, 3) m, what fills the picture, for the size of marks; the whole structure by itself
    """
    widest = widest or scene
    moving = moving_blocks(widest)
    legend: list[tuple[str, str]] = []
    notes: tuple[str, ...] = ()
    still = [FIXED_BLOCK if fixed else REST for fixed in scene.model.fixed]
    coloured = zip(part_colours(widest, PARTS), still, moving, strict=True)
    solid = list(structure(scene, scene.moved, [own if moves else rest for own, rest, moves in coloured]))
    marks: list[Shape] = []
    if moving.any():
        solid.append(ghost_lines(scene, moving))
    if moving.any() and len(scene.contacts):
        gaps, lines, legend, notes = joint_marks(scene, widest, widest.moved if seen is None else seen)
        solid += gaps
        marks += lines
    extent = np.vstack([scene.moved, scene.model.blocks.vertices, *scene.slabs])
    loads, entries = load_shapes(scene, "mechanism")
    extent = np.vstack([extent, *(shape.points for shape in loads)])
    legend += entries
    if moving.any():
        rests = (widest.clusters == 0) & ~scene.model.fixed
        legend += [("at rest", REST)] * bool(rests.any()) + [("before", GHOST)]
    if scene.model.fixed.any():
        legend.append(("support", FIXED_BLOCK))
    notes = (*_parts_note(widest), *notes)
    return Drawing(tuple(solid), tuple(marks), 0.6, extent, tuple(legend), notes=notes, loads=tuple(loads))


def moving_blocks(scene: Scene) -> BoolArray:
    """Blocks that are drawn away from their place, (n_blocks,)."""
    distance = largest_displacements(scene.model.blocks, scene.motion)
    return np.asarray(distance > STILL * distance.max(initial=0.0))


def _parts_note(scene: Scene) -> tuple[str, ...]:
    """What counts as one part, where that is not the exact motion."""
    failure = scene.failure
    if failure is None or not failure.merged or not scene.motion.any():
        return ()
    count = len(failure.main.motions)
    told = f"coloured as {count} parts" if count > 1 else "coloured as one part"
    if failure.spreads:
        return (f"{told}, as in the listing: {100 * failure.main.explained:.3g} % of the motion is explained by that",)
    return (
        f"{told}: less than {100 * failure.merged:g} % of the fastest contact counts as no motion, as in the listing",
    )
