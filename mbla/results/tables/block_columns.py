"""The table of blocks: one row for each block and load case."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.selectors import POSITIONS
from mbla.results.tables.case_rows import CaseRows, case_rows
from mbla.results.tables.column import Column, Values, as_text, bools, floats, ints, texts, vector, whole
from mbla.results.tables.table import TableKind


def _count(rows: CaseRows) -> int:
    return len(rows.model.blocks)


def _weights(rows: CaseRows) -> Values:
    units = rows.model.units
    return np.asarray(rows.model.blocks.masses * units.standard_gravity * units.force_per_mass_acceleration)


def _settles(rows: CaseRows) -> Values:
    settlement = rows.case.load_case.settlement
    blocks = np.arange(_count(rows))
    return np.isin(blocks, settlement.blocks) if settlement is not None else np.zeros(len(blocks), dtype=bool)


def _body(rows: CaseRows) -> Values:
    solids = rows.contacts.solid_of_block
    return whole(np.full(_count(rows), -1) if solids is None else solids)


def _mechanism(rows: CaseRows) -> FloatArray:
    mechanics = rows.mechanics
    return rows.given(None if mechanics is None else mechanics.mechanism, _count(rows), 6)


def _certificate(rows: CaseRows) -> FloatArray:
    return rows.given(rows.certificate, _count(rows), 6)


def _part(rows: CaseRows) -> Values:
    return whole(np.full(_count(rows), -1) if rows.collapse is None else rows.collapse.parts)


def _position(name: str) -> Column[CaseRows]:
    words = f"number of the {name} in its item, from 0; empty: none"
    return ints(name, words, lambda rows: whole(rows.model.blocks.labels.position(name)))


GEOMETRY: tuple[Column[CaseRows], ...] = (
    texts("case", "load case", lambda rows: rows.same(_count(rows), rows.case.load_case.name)),
    ints("block", "number of the block, from 0", lambda rows: np.arange(_count(rows))),
    texts(
        "name",
        "group and index, as selectors write it",
        lambda rows: as_text([rows.model.blocks.name(block) for block in range(_count(rows))]),
    ),
    texts("group", "group", lambda rows: as_text(rows.model.blocks.groups)),
    ints("index", "position in the group, from 0", lambda rows: rows.model.blocks.group_indices),
    texts(
        "member",
        "part of a composite item, such as lintel; empty: none",
        lambda rows: as_text(rows.model.blocks.labels.members),
    ),
    *(_position(name) for name in POSITIONS),
    *vector("centroid", "length", "centroid", lambda rows: rows.model.blocks.centroids),
    floats("volume", "volume", "volume", lambda rows: rows.model.blocks.volumes),
    floats("density", "density", "mass per volume", lambda rows: rows.model.blocks.densities),
    floats("added_mass", "mass", "mass carried along beside its own", lambda rows: rows.model.blocks.added_masses),
    floats("weight", "force", "weight under standard gravity, 9.81 m/s2, added mass included", _weights),
    bools("fixed", "does not move in this case", lambda rows: rows.model.fixed),
    bools(
        "guided",
        "moves in given ways only",
        lambda rows: np.isin(np.arange(_count(rows)), rows.model.guides.blocks),
    ),
    bools("settles", "belongs to the support that gives way in this case", _settles),
    ints("body", "rigid body of blocks glued to each other, from 0; empty: no block of the model is glued", _body),
)

LOADS: tuple[Column[CaseRows], ...] = (
    *vector("dead_force", "force", "dead load", lambda rows: rows.case.load_case.dead_load[:, :3]),
    *vector(
        "dead_moment", "moment", "its moment about the centroid", lambda rows: rows.case.load_case.dead_load[:, 3:]
    ),
    *vector("live_force", "force", "live load, at load factor 1", lambda rows: rows.case.load_case.live_load[:, :3]),
    *vector(
        "live_moment", "moment", "its moment about the centroid", lambda rows: rows.case.load_case.live_load[:, 3:]
    ),
)

MOTION: tuple[Column[CaseRows], ...] = (
    texts(
        "figures",
        "what forces and velocities of the row are: result; best_iterate where the case has no result; empty: none",
        lambda rows: rows.same(_count(rows), rows.figures),
    ),
    *vector(
        "velocity",
        "velocity",
        "velocity of the centroid in the mechanism, power of the live load 1",
        lambda rows: _mechanism(rows)[:, :3],
    ),
    *vector("rotation", "rotation", "angular velocity in the mechanism", lambda rows: _mechanism(rows)[:, 3:]),
    ints("part", "rigid part that the block moves with: 0 at rest, the heaviest 1; empty: no mechanism", _part),
    *vector(
        "certificate_velocity",
        "1",
        "no equilibrium: velocity of the centroid in the motion that proves it, to a scale of its own",
        lambda rows: _certificate(rows)[:, :3],
    ),
    *vector(
        "certificate_rotation",
        "per_length",
        "no equilibrium: angular velocity in that motion",
        lambda rows: _certificate(rows)[:, 3:],
    ),
)

BLOCKS = TableKind("blocks", "each block, for each load case", (*GEOMETRY, *LOADS, *MOTION), case_rows)
