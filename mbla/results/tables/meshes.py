"""A load case as meshes that move: blocks, interfaces and contact points with the columns of their tables as data.

Meshes hold no text: groups are numbered in alphabetical order, joint laws by their row in the table of contacts, modes
as :class:`ContactMode` and :class:`InterfaceMode`; columns without a single value are left out. ``figures`` says on
every cell what its forces and velocities are: 1 the result, 2 the best that was reached where there is none, 0 nothing.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, starts
from mbla.results.collapse.finite_motion import finite_motion
from mbla.results.collapse.motion import drawn_motion, moved_contact_points, moved_vertices
from mbla.results.hdf5.field import unit_text
from mbla.results.hdf5.result_file import write_hdf5
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.tables.case_rows import BEST_ITERATE, NONE, RESULT, CaseRows
from mbla.results.tables.column import Values
from mbla.results.tables.table import table_of
from mbla.results.tables.tables import TABLES
from mbla.results.vtu.cells import block_cells
from mbla.results.vtu.pvd import frame_times
from mbla.results.vtu.vtkhdf import CELL_TYPES, Arrays, Faces, Grid, vtkhdf_content
from mbla.results.vtu.vtu import group_numbers

FIGURES = (NONE, RESULT, BEST_ITERATE)
"""what forces and velocities are, by number"""
CORNER_ORDER = {"wedge": [0, 2, 1, 3, 5, 4]}
"""cells are listed as meshio wants them, which turns wedges around before VTK sees them"""
FRAMES = 11
"""steps of the motion, as many as a deck has frames by default"""


def case_vtkhdf(results: Results, case: CaseResult) -> bytes:
    """The file ``STEM_CASE.vtkhdf``: grids ``blocks``, ``interfaces`` and ``points``, at steps from 0 to 1.

    At step 0 it stands as built, at 1 it has moved as drawn (:mod:`mbla.results.collapse.finite_motion`), with finite
    rotations; interfaces and points halfway between their bodies. A case without motion has one step.
    """
    rows = CaseRows(results, case)
    times = frame_times(FRAMES) if drawn_motion(rows.model, case).any() else [0.0]
    motions = [finite_motion(rows.model, rows.contacts, case, time) for time in times]
    grids = [_blocks(rows, motions)]
    if len(rows.contacts):
        between = np.array([_between(rows, moved) for moved in motions])
        grids += [_interfaces(rows, between), _points(rows, between)]
    mechanics = result_of(case)
    notes = {
        "deck": results.deck.name,
        "case": case.load_case.name,
        "status": case.status.value,
        "figures": rows.figures or "none",
        "load_factor": np.nan if mechanics is None else mechanics.load_factor,
    }
    return write_hdf5(vtkhdf_content(grids, times, notes))


def _blocks(rows: CaseRows, motions: Sequence[FloatArray]) -> Grid:
    blocks = rows.model.blocks
    points = np.array([moved_vertices(blocks, moved) for moved in motions])
    data, units = _cell_data(rows, "blocks")
    data["group"] = group_numbers(rows.model)
    cells = block_cells(blocks)
    kinds = [kind for kind, _ in cells.cells]
    if kinds == ["polyhedron"]:
        types = np.full(len(blocks), CELL_TYPES["polyhedron"])
        corners, corner_start = np.arange(len(blocks.vertices)), blocks.vertex_start
        faces = Faces(blocks.loops, blocks.loop_start, blocks.face_start)
        return Grid("blocks", points, types, corners, corner_start, data, faces, units)
    order = np.concatenate(cells.rows)
    types = np.concatenate([np.full(len(r), CELL_TYPES[k]) for k, r in zip(kinds, cells.rows, strict=True)])
    corners = np.concatenate(
        [np.ravel(connectivity[:, CORNER_ORDER.get(kind, ...)]) for kind, connectivity in cells.cells]
    )
    counts = np.concatenate([np.full(len(connectivity), connectivity.shape[1]) for _, connectivity in cells.cells])
    data = {name: values[order] for name, values in data.items()}
    return Grid("blocks", points, types, corners, starts(counts), data, None, units)


def _interfaces(rows: CaseRows, points: FloatArray) -> Grid:
    """Polygons by their outer boundary."""
    contacts = rows.contacts
    data, units = _cell_data(rows, "interfaces")
    data["joint"] = contacts.joints
    if rows.collapse is not None:
        data["mode"] = rows.collapse.interfaces.modes
    outer = np.arange(len(contacts.points)) - contacts.point_start[contacts.interface_of_point]
    corners = np.flatnonzero(outer < contacts.outline[contacts.interface_of_point])
    types = np.full(len(contacts), CELL_TYPES["polygon"])
    return Grid("interfaces", points, types, corners, starts(contacts.outline), data, None, units)


def _points(rows: CaseRows, points: FloatArray) -> Grid:
    data, units = _cell_data(rows, "points")
    if rows.mechanics is not None:
        data["mode"] = rows.mechanics.modes
    count = points.shape[1]
    types = np.full(count, CELL_TYPES["vertex"])
    return Grid("points", points, types, np.arange(count), np.arange(count + 1), data, None, units)


def _between(rows: CaseRows, motion: FloatArray) -> FloatArray:
    """Contact points halfway between where the two bodies carry them, (n_points, 3)."""
    sides = [moved_contact_points(rows.model, rows.contacts, motion, side) for side in (0, 1)]
    return np.asarray((sides[0] + sides[1]) / 2)


def _cell_data(rows: CaseRows, name: str) -> tuple[Arrays, dict[str, str]]:
    """Numbers of a table as arrays, three columns ``NAME_x`` and so on as one of vectors; units by name."""
    table = table_of(TABLES[name], rows.results, (rows.case,))
    columns = {c.name: (c, v) for c, v in zip(table.kind.columns, table.values, strict=True) if c.kind != "text"}
    data: Arrays = {}
    units = {"displacement": unit_text("length", table.units)}
    for column, values in columns.values():
        stem, _, axis = column.name.rpartition("_")
        is_vector = all(f"{stem}_{each}" in columns for each in "xyz") and axis in tuple("xyz")
        if is_vector and axis != "x":
            continue
        named = stem if is_vector else column.name
        array = np.column_stack([columns[f"{stem}_{each}"][1] for each in "xyz"]) if is_vector else _plain(values)
        if array is not None and not _empty(array):
            data[named] = array
            units[named] = column.unit_in(table.units)
    data["figures"] = np.full(len(table), FIGURES.index(rows.figures))
    return data, units


def _plain(values: Values) -> Values | None:
    """Truth as 0 and 1, whole numbers that are missing as -1; None where all are."""
    if values.dtype == bool:
        return values.astype(np.int8)
    mask = np.ma.getmaskarray(values)
    return None if mask.all() and len(mask) else np.ma.getdata(np.ma.filled(values, -1))


def _empty(array: Values) -> bool:
    return bool(array.dtype.kind == "f" and np.isnan(array).all())
