"""Ties in the listing: what they are, and what they do at collapse."""

from __future__ import annotations

import numpy as np

from mbla.model.model import Model
from mbla.results.collapse.ties import TieRow, TieState, tie_rows
from mbla.results.listing.text import MOST_ROWS, counted, long_table, number, sentence, vector
from mbla.solution.solution import Mechanics


def tie_lines(model: Model) -> list[str]:
    """The ties of a model with their limits; nothing without any."""
    rows, size = tie_rows(model, None), float(np.abs(model.blocks.vertices).max(initial=0.0))
    if not rows:
        return []
    units = model.units
    head = ["tie", "from", "to", f"from [{units.length}]", f"to [{units.length}]", f"force [{units.force}]"]
    table = [
        [row.name, row.from_body, row.to_body, vector(row.from_place, size), vector(row.to_place, size), _limits(row)]
        for row in rows[:MOST_ROWS]
    ]
    length = f"{number(float(model.ties.lengths.sum()))} {units.length} in all; tension is positive"
    lines = sentence(f"{counted(len(rows), 'tie')}, {length}:", "")
    fitted = float(model.ties.prestress.max())
    lines += long_table(head, table, len(rows), left=5)[1:]
    if fitted > 0.0:
        count = int((model.ties.prestress > 0.0).sum())
        words = f"{counted(count, 'tie')} of these prestressed, by up to {number(fitted)} {units.force}"
        lines += sentence(f"{words}: that counts in whether the structure stands and in no load factor.", "")
    return lines


def _limits(row: TieRow) -> str:
    return f"{number(row.least)} .. {number(row.greatest)}"


def tie_force_lines(model: Model, mechanics: Mechanics) -> list[str]:
    """Forces of ties at collapse, those that yield first, then by how much of their capacity they use."""
    rows = tie_rows(model, mechanics)
    if not rows:
        return []
    yielding = sum(row.state is TieState.YIELDS for row in rows)
    slack = sum(row.state is TieState.SLACK for row in rows)
    order = sorted(rows, key=lambda row: (row.state is not TieState.YIELDS, -float(np.nan_to_num(row.use))))
    head = ["tie", "from", "to", f"force [{model.units.force}]", "of capacity", "", "elongates"]
    shown = [
        [
            row.name,
            row.from_body,
            row.to_body,
            "not known" if np.isnan(row.force) else number(row.force),
            "" if np.isnan(row.use) else f"{100 * row.use:.1f} %",
            row.state.value,
            "" if np.isnan(row.rate) else f"{row.rate:.3g}",
        ]
        for row in order[:MOST_ROWS]
    ]
    words = (
        f"{yielding} of {counted(len(rows), 'tie')} yield, {slack} are slack. Forces of ties that do neither are those "
        "of the state shown; others are possible. Elongation rates are scaled as the mechanism:"
    )
    return ["", *sentence(words), *long_table(head, shown, len(rows), left=3)[1:]]
