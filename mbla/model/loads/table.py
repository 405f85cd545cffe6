"""Load `table`: forces and moments on single blocks from a table of text (CSV), one row for each."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.suggestions import did_you_mean, listed
from mbla.errors import DeckError, Message
from mbla.model.applied_load import AppliedLoad, sum_on_blocks, wrenches_of
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.soil.names import counted_with_soil
from mbla.model.tables import CsvTable, TableRefused, read_table
from mbla.model.wording import counted

FORCE, POINT, MOMENT = ("fx", "fy", "fz"), ("x", "y", "z"), ("mx", "my", "mz")


def table_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """Rows with group, index, force, and optionally a point where it acts, a moment, or both.

    A force without a point acts at the centroid. A moment is added to what the force brings about the centroid.

    blocks : (n,) or None, those that other kinds of load act on; the rows name theirs
    """
    here = (*entry.path, "table")
    try:
        table = read_table(site.resolve_file(here, entry.value), ("group", "index", *FORCE), (*POINT, *MOMENT))
        forces, points, moments = _numbers(table)
        rows = _blocks(table, site)
        table.check()
    except DeckError as error:
        site.selection.faults.extend(error.faults)
        return None
    except TableRefused as refused:
        for finding in refused.findings(*here):
            site.refuse(finding)
        return None
    if rows is None:
        return None
    centroids = site.blocks.centroids[rows]
    wrenches = wrenches_of(forces, centroids if points is None else points, centroids)
    wrenches[:, 3:6] += moments
    acted_on, total = sum_on_blocks(rows, wrenches)
    words = f"{counted(len(rows), 'row')} of {entry.value}: forces on {counted_with_soil(acted_on, site.blocks)}"
    return AppliedLoad(acted_on, total, words)


def _numbers(table: CsvTable) -> tuple[FloatArray, FloatArray | None, FloatArray]:
    """Forces, points where they act unless at the centroids, and moments; (n, 3) each."""
    given = [name for name in POINT if name in table.columns]
    if given and len(given) < len(POINT):
        words = f"{table.file}: columns x, y, z go together, only {listed(given, 'and')} is there"
        raise TableRefused(Message("table-columns", words))
    moments = np.zeros((len(table), 3))
    for axis, name in enumerate(MOMENT):
        if name in table.columns:
            moments[:, axis] = table.numbers([name])[:, 0]
    return table.numbers(FORCE), table.numbers(POINT) if given else None, moments


def _blocks(table: CsvTable, site: LoadSite) -> IntArray | None:
    """Block of each row, (n,); None where a group could not be built."""
    found: list[int | None] = []
    groups = site.selection.members
    for row, group in enumerate(table.columns["group"]):
        if group in groups:
            otherwise = f"{group} has blocks 0 to {len(groups[group]) - 1}"
            found.append(table.place_in("index", row, groups[group], otherwise))
        elif group not in site.selection.partial:
            table.refuse(row, f"unknown group {group}{did_you_mean(group, groups)}")
    if site.selection.partial.intersection(table.columns["group"]):
        return None
    return np.array([block or 0 for block in found], dtype=np.int64)


register_load(
    LoadKind(
        name="table",
        section=Annotated[str, Field(min_length=1)],
        description="CSV file, relative to the deck: a header line with the columns group,index,fx,fy,fz, optionally "
        "x,y,z (where the force acts; default: the centroid) and mx,my,mz (moment); then a row for each force",
        after="tilt",
        refuses={"on": "a table, whose rows name their blocks"},
        is_file=True,
        build=table_load,
        may_cancel=True,
    )
)
