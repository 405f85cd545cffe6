"""Slip lines in soil of cells: a table, and what each of them lies between."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.slip_lines import SlipLine, is_beside
from mbla.results.listing.blocks import MOST_ROWS, Block, table_of
from mbla.results.listing.places import point_words, soil_words
from mbla.results.listing.text import percent


def slip_table(model: Model, contacts: Contacts, lines: Sequence[SlipLine]) -> list[Block]:
    """What it lies between, how far it reaches and how much of the power its shear forces take."""
    rows = [
        [
            slip_words(model, contacts, line),
            f"{line.clusters[0]}/{line.clusters[1]}",
            point_words(model, line.start),
            point_words(model, line.end),
            f"{line.length:.4g}",
            percent(line.shear_power_share),
        ]
        for line in lines[:MOST_ROWS]
    ]
    length = model.units.length
    head = ["slip lines", "parts", f"from [{length}]", f"to [{length}]", f"length [{length}]", "shear work [%]"]
    return table_of(head, rows, left=4, total=len(lines))


def slip_words(model: Model, contacts: Contacts, line: SlipLine) -> str:
    """``in soil road``, ``soil road on arch``, ``soil road along walls``, ``in soil road and on ground``: by groups."""
    bodies = np.unique(contacts.bodies[line.interfaces])
    blocks = bodies[bodies < len(model.blocks)]
    soil = model.soil_of_block[blocks]
    others = list(dict.fromkeys(model.blocks.groups[block] for block in blocks[soil < 0].tolist()))
    others += ["ground"] if len(blocks) < len(bodies) else []
    name, cells = soil_words(model, soil[soil >= 0]), np.append(model.soil_of_block >= 0, [False] * len(model.grounds))
    if not others:
        return f"in {name}"
    inside = cells[contacts.bodies[line.interfaces]].all(axis=1).any()
    across = model.soils[int(soil.max())].axes[2]
    way = "along" if is_beside(contacts, line.interfaces, across).all() else "on"
    return f"in {name} and on {', '.join(others)}" if inside else f"{name} {way} {', '.join(others)}"
