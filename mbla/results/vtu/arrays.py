"""What the files for ParaView hold: columns of the record as arrays, and what there is in them besides."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mbla.results.quantities.quantity import Quantity, flag, integer, real
from mbla.results.quantities.registry import BLOCK_COLUMNS, INTERFACE_COLUMNS, POINT_COLUMNS
from mbla.results.quantities.ties import TIES
from mbla.results.record.scene import Scene

Arrays = dict[str, np.typing.NDArray[Any]]

COLUMNS: dict[tuple[str, str], tuple[Quantity, ...]] = {
    ("blocks", "cells"): BLOCK_COLUMNS,
    ("frames", "cells"): BLOCK_COLUMNS,
    ("contacts", "points"): POINT_COLUMNS,
    ("interfaces", "cells"): INTERFACE_COLUMNS,
    ("thrust", "points"): INTERFACE_COLUMNS,
    ("hinges", "cells"): INTERFACE_COLUMNS,
}
"""what the cells or points of a file are"""
_MOTION = real("displacement", "motion as drawn, the mean of both bodies; for Warp By Vector", "length", "axis")
_LOADS = (
    real("dead_forces", "zero where the vertex is of another kind", "force", "axis"),
    real("live_forces", "for load factor 1; zero where the vertex is of another kind", "force", "axis"),
    real("reaction_forces", "of supports and guides; zero where the vertex is of another kind", "force", "axis"),
    real("moments", "about the point, with the force", "moment", "axis"),
    integer("kind", "0 dead load, 1 live load, 2 reaction of a support, 3 of a guide"),
    integer("body", "block that it acts on"),
    flag("fixed", "1 where that block does not move, and its load goes into its support"),
    integer("figures", "what reactions and motion are, as of interfaces"),
)
_TIES = {each.name: each for each in TIES.quantities}
_VELOCITY = real("velocity", "of states in time: relative to the base, after the step", "speed", "axis")
_FORCES_IN_TIME = (
    real("contact_force", "on the second body, in the axes of the deck", "force", "axis"),
    real("normal_force", "compression positive", "force"),
    real("shear_force", "along the joint", "force"),
)
OTHERS: dict[tuple[str, str], tuple[Quantity, ...]] = {
    **{(file, "points"): (_MOTION,) for file in ("blocks", "frames", "contacts", "interfaces", "thrust", "hinges")},
    ("frames", "points"): (_MOTION, _VELOCITY),
    ("forces", "points"): _FORCES_IN_TIME,
    ("thrust", "cells"): (
        integer("kind", "0 point of application, 1 piece of a thrust line"),
        integer("line", "number of the thrust line from 0, -1 for points"),
    ),
    ("hinges", "cells"): (real("rotation", "of b relative to a about the axis, as drawn", "radian"),),
    ("loads", "points"): (*_LOADS, _MOTION),
    ("ties", "points"): (_MOTION,),
    ("ties", "cells"): (
        integer("tie", "number of the tie, from 0"),
        *(_TIES[name] for name in ("least", "greatest", "prestress")),
        replace(_TIES["force"], name="tie_forces", words="force"),
        replace(_TIES["rate"], name="tie_rates"),
        _TIES["use"],
        integer("state", "0 holds, 1 yields, 2 slack, 3 fill at its passive limit, 4 at its active one"),
        integer("figures", "what forces and motion are, as of interfaces"),
    ),
    ("modes", "points"): (
        real(
            "mode_1",
            "displacement in the first mode as drawn, mode_2 in the second, and so on; Warp By Vector plays one with "
            "scale factors from -1 to 1",
            "length",
            "axis",
        ),
    ),
    ("modes_after", "points"): (
        real("mode_1", "the same after a time history, of blocks where it left them", "length", "axis"),
    ),
    ("supports", "cells"): (
        integer("kind", "0 ground plane, 1 fixed block, 2 guided block"),
        integer("body", "block, or number of blocks + number of the ground plane"),
    ),
}
"""what is in no column"""


def arrays_of(scene: Scene, file: str, on: str, rows: Any = slice(None)) -> Arrays:
    """Arrays by name of the columns of a file, of some rows: those that there are, vectors as (n, 3)."""
    found: Arrays = {}
    for quantity in COLUMNS[file, on]:
        values = quantity.of(scene) if file in quantity.files else None
        if values is not None and not (quantity.names and list(quantity.names(scene)) == [""]):
            plain = np.ma.filled(values, -1)[rows]
            plain = plain.astype(np.int8) if plain.dtype == bool else plain
            found |= {name: plain[(slice(None), *place)] for name, place in names_of_arrays(quantity)}
    return found


def names_of_arrays(quantity: Quantity) -> list[tuple[str, tuple[int, ...]]]:
    """Names of arrays of a quantity and what of its values they are: vectors are one array."""
    if "axis" in quantity.dims:
        return [(quantity.name, ())]
    return [(name, place) for place, name, _ in quantity.components()]
