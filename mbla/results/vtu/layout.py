"""What the files for ParaView hold, as one table: it feeds the section of schemas/results.md, and a test the writers.

``ANIMATION`` and ``SUPPORTS`` are files of their own kind beside those of ``MESH_FILES``.
"""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck.sections.selectors import POSITIONS

ANIMATION, SUPPORTS = "frame_NNN", "supports"


@dataclass(frozen=True)
class Array:
    """One array of a file.

    on    : points or cells
    shape : components, 1 or 3
    unit  : in which the numbers are; 1 for pure numbers and for codes
    """

    file: str
    on: str
    name: str
    shape: int
    unit: str
    content: str


def _arrays(file: str, on: str, *rows: tuple[str, int, str, str]) -> tuple[Array, ...]:
    return tuple(Array(file, on, *row) for row in rows)


CELLS = {
    "blocks": "blocks as tetrahedra, wedges, hexahedra, or all of them as polyhedra; no two share a point",
    ANIMATION: "the same blocks after a finite motion, from as built (000) to as drawn; STEM_CASE.pvd plays them",
    "contacts": "contact points as vertices",
    "interfaces": "interfaces as polygons, by their outer boundary",
    "thrust": "points of application of resultants as vertices, outside a joint its edge; thrust lines between them",
    "hinges": "axes of interfaces that open about one, as lines where they stay closed; about a corner as points",
    "loads": "loads and reactions as vertices where they act",
    SUPPORTS: "ground planes as slabs under what stands on them, fixed blocks, guided blocks, as polyhedra",
}
"""files by what their names end in, and their cells"""

_DISPLACEMENT = ("displacement", 3, "length", "motion as drawn, to a scale that can be seen; for Warp By Vector")
_MEAN = ("displacement", 3, "length", "motion as drawn, the mean of both bodies")
_RESULT = ("result", 1, "1", "1 forces and motion are a result, 0 the best iterate or forces that lock")
_BODIES = (
    ("interface", 1, "1", "number of the interface"),
    ("body_a", 1, "1", "body a: block, or number of blocks + number of the ground plane"),
    ("body_b", 1, "1", "body b; forces act on it"),
)
_LABELS = (
    ("member", 1, "1", "member that items give their blocks, in alphabetical order from 1; 0 none"),
    *((name, 1, "1", "as items number their blocks; -1 none") for name in POSITIONS),
)
_BLOCK = (
    ("block", 1, "1", "number of the block"),
    ("group", 1, "1", "group, in alphabetical order from 0"),
    ("fixed", 1, "1", "1 does not move"),
    ("part", 1, "1", "blocks with one number move together; 0 at rest"),
)
_USE = (
    (
        "eccentricity",
        1,
        "1",
        "of the resultant: 0 central, 1 at the edge, more only with tension; nan where not pressed",
    ),
    ("friction_use", 1, "1", "shear over what friction and cohesion allow, without torsion; nan where nothing acts"),
    ("torsion_use", 1, "1", "shear and torsion together over what the interface carries of both; nan as above"),
)
_THRUST = (
    ("resultant_force", 3, "force", "on body b"),
    ("normal_force", 1, "force", "compression positive"),
    ("shear_force", 1, "force", "size of the resultant along the interface"),
    ("torsion", 1, "force length", "moment about the normal through the centroid"),
    *_USE,
)

ARRAYS: tuple[Array, ...] = (
    *_arrays("blocks", "points", _DISPLACEMENT),
    *_arrays(
        "blocks",
        "cells",
        *_BLOCK,
        ("weight", 1, "force", "under standard gravity"),
        ("guided", 1, "1", "1 may move in given ways only, a support that gives way included"),
        ("moves", 1, "1", "1 moves"),
        ("velocity", 3, "length", "displacement of the centroid as drawn"),
        ("rotation", 3, "rad", "rotation vector as drawn"),
        ("largest_eccentricity", 1, "1", "over the interfaces of the block"),
        ("largest_friction_use", 1, "1", "over the interfaces of the block"),
        ("largest_torsion_use", 1, "1", "over the interfaces of the block"),
        *_LABELS,
    ),
    *_arrays(ANIMATION, "points", ("displacement", 3, "length", "what the point has moved so far")),
    *_arrays(ANIMATION, "cells", *_BLOCK, *_LABELS),
    *_arrays(
        "contacts",
        "points",
        *_BODIES,
        _MEAN,
        ("contact_force", 3, "force", "on body b"),
        ("normal_force", 1, "force", "compression positive"),
        ("shear_force", 1, "force", "size of the force along the interface"),
        ("friction_use", 1, "1", "shear over what friction and cohesion allow; not with contact_model convex"),
        ("contact_velocity", 3, "velocity", "of b relative to a, where the power of the live load is 1"),
        ("opening", 1, "velocity", "its normal part, opening positive"),
        ("sliding", 1, "velocity", "size of its part along the interface"),
        ("mode", 1, "1", "0 stick, 1 slide, 2 open, 3 crush"),
        _RESULT,
    ),
    *_arrays("interfaces", "points", _MEAN),
    *_arrays(
        "interfaces",
        "cells",
        *_BODIES,
        ("area", 1, "length^2", "of the common surface"),
        ("gap", 1, "length", "greatest distance between the faces, negative where they overlap"),
        ("joint", 1, "1", "joint law, row of contacts/joint_names in the HDF5 file"),
        ("normal", 3, "1", "unit, from a to b"),
        ("resultant_moment", 3, "force length", "on body b about the centroid"),
        ("thrust_point", 3, "length", "where the resultant acts; nan where the interface is not pressed"),
        *_THRUST,
        ("mode", 1, "1", "0 stick, 1 slide, 2 open, 3 hinge, 4 twist, 5 crush"),
        ("slides", 1, "1", "1 closed points slide, whatever the mode"),
        ("crushes", 1, "1", "1 closed points crush, whatever the mode"),
        ("work", 1, "1", "power dissipated; that of the live load is the load factor"),
        _RESULT,
    ),
    *_arrays("thrust", "points", *_BODIES, *_THRUST, _MEAN, _RESULT),
    *_arrays(
        "thrust",
        "cells",
        ("kind", 1, "1", "0 point of application, 1 piece of a thrust line"),
        ("line", 1, "1", "number of the thrust line from 0, -1 for points"),
    ),
    *_arrays("hinges", "points", _MEAN),
    *_arrays(
        "hinges", "cells", *_BODIES, ("rotation", 1, "rad", "of b relative to a about the axis, as drawn"), _RESULT
    ),
    *_arrays(
        "loads",
        "points",
        ("dead_load", 3, "force", "zero where the vertex is of another kind"),
        ("live_load", 3, "force", "for load factor 1; zero where the vertex is of another kind"),
        ("reaction", 3, "force", "of supports and guides on the structure; zero where the vertex is of another kind"),
        ("moment", 3, "force length", "beside the force, about the point"),
        ("kind", 1, "1", "0 dead load, 1 live load, 2 reaction of a support, 3 of a guide"),
        ("body", 1, "1", "block that it acts on"),
        ("fixed", 1, "1", "1 that block does not move, and its load goes into its support"),
        _DISPLACEMENT,
        _RESULT,
    ),
    *_arrays(
        SUPPORTS,
        "cells",
        ("kind", 1, "1", "0 ground plane, 1 fixed block, 2 guided block"),
        ("body", 1, "1", "block, or number of blocks + number of the ground plane"),
    ),
)
"""every array that a file may hold; a file without forces or without a mechanism holds fewer"""


def arrays_of(file: str, on: str) -> dict[str, Array]:
    """Arrays of a file by name."""
    return {array.name: array for array in ARRAYS if array.file == file and array.on == on}


def arrays_table() -> str:
    """The tables of schemas/results.md."""
    lines = ["| file | cells |", "|---|---|"]
    lines += [f"| …_{file}.vtu | {cells} |" for file, cells in CELLS.items()]
    lines += ["", "| file, on | array | components | units | content |", "|---|---|---|---|---|"]
    for each in ARRAYS:
        lines.append(f"| {each.file}, {each.on} | `{each.name}` | {each.shape} | {each.unit} | {each.content} |")
    return "\n".join(lines) + "\n"
