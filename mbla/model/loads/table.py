"""Load `table`: forces and moments on single blocks from a table of text (CSV), one row for each."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.loads import Load
from mbla.deck.suggestions import did_you_mean, listed
from mbla.deck.tree import KeyPath
from mbla.errors import DeckError, Message
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, wrenches_of
from mbla.model.tables import Table, TableRefused, read_table
from mbla.model.wording import counted

FORCE, POINT, MOMENT = ("fx", "fy", "fz"), ("x", "y", "z"), ("mx", "my", "mz")


def table_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Rows with group, index, force, and optionally a point where it acts, a moment, or both.

    A force without a point acts at the centroid. A moment is added to what the force brings about the centroid.
    """
    assert load.table is not None  # what makes it this kind
    here = (*path, "table")
    try:
        file = site.resolve_file(here, load.table)
        table = read_table(file, ("group", "index", *FORCE), (*POINT, *MOMENT))
        wrenches, rows = _wrenches(table, site)
    except DeckError as error:
        site.faults.extend(error.faults)
        return None
    except TableRefused as refused:
        for fault in refused.faults:
            site.refuse(here, fault)
        return None
    if rows is None:
        return None
    acted_on = np.unique(rows)
    total = np.zeros((len(site.blocks), 6))
    np.add.at(total, rows, wrenches)
    words = f"{counted(len(rows), 'row')} of {load.table}: forces on {counted(len(acted_on), 'block')}"
    return AppliedLoad(acted_on, total[acted_on], words)


def _wrenches(table: Table, site: LoadSite) -> tuple[FloatArray, IntArray | None]:
    """Force and moment of each row about the centroid of its block, (n, 6), and the blocks; None if not built."""
    faults: list[Message] = []
    forces = table.numbers(FORCE, faults)
    given = [name for name in POINT if name in table.columns]
    if given and len(given) < len(POINT):
        raise TableRefused(
            [
                Message(
                    "table-columns", f"{table.file}: columns x, y, z go together, only {listed(given, 'and')} is there"
                )
            ]
        )
    given_moments = [name for name in MOMENT if name in table.columns]
    moments = np.zeros((len(table), 3))
    moments[:, [MOMENT.index(name) for name in given_moments]] = table.numbers(given_moments, faults)
    rows = _blocks(table, site, faults)
    points = table.numbers(POINT, faults) if given else None
    if faults:
        raise TableRefused(faults)
    if rows is None:
        return np.zeros((0, 6)), None
    centroids = site.blocks.centroids[rows]
    wrenches = wrenches_of(forces, centroids if points is None else points, centroids)
    wrenches[:, 3:] += moments
    return wrenches, rows


def _blocks(table: Table, site: LoadSite, faults: list[Message]) -> IntArray | None:
    """Block of each row; None where a group could not be built."""
    found = np.zeros(len(table), dtype=np.int64)
    built = True
    groups = site.roster.members
    for row, (group, index) in enumerate(zip(table.columns["group"], table.columns["index"], strict=True)):
        if group in site.roster.partial:
            built = False
        elif group not in groups:
            faults.append(
                Message("table-row", f"{table.place(row)}: unknown group {group}{did_you_mean(group, groups)}")
            )
        elif not index.isdecimal() or int(index) >= len(groups[group]):
            last = len(groups[group]) - 1
            faults.append(
                Message(
                    "table-row", f"{table.place(row)}: index = {index or '(empty)'}: {group} has blocks 0 to {last}"
                )
            )
        else:
            found[row] = groups[group][int(index)]
    return found if built else None
