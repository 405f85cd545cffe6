"""Ties, and fill that holds faces, in the listing: what they are, and what they do at collapse."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.model.model import Model
from mbla.model.ties.ties import FILL, OF_FILL
from mbla.results.collapse.ties import TieRow, TieState, tie_rows
from mbla.results.listing.blocks import GAP, MOST_ROWS, Block, Paragraph, table_of
from mbla.results.listing.text import counted, number, vector
from mbla.solution.solution import Mechanics


def tie_title(model: Model) -> str:
    """Of what the following list."""
    return "Ties and soil" if model.ties.of_fill.any() else "Ties"


def tie_blocks(model: Model) -> list[Block]:
    """The ties of a model with their limits, then what fill does on faces; nothing without any."""
    ties, soil = _parted(tie_rows(model, None))
    blocks = _tie_blocks(model, ties) if ties else []
    if soil:
        words = f"Fill pushes on {counted(_on_faces(soil), 'face')}, each between two limits; a push is negative"
        head = ["face", "of", f"at [{model.units.length}]", f"force [{model.units.force}]"]
        size = float(np.abs(model.blocks.vertices).max(initial=0.0))
        table = [[row.name, row.from_body, vector(row.from_place, size), _limits(row)] for row in soil[:MOST_ROWS]]
        blocks += [GAP] * bool(ties)
        blocks += table_of(head, table, left=3, caption=words, total=len(soil), flush=True)
    return blocks


def _parted(rows: Sequence[TieRow]) -> tuple[list[TieRow], list[TieRow]]:
    """Ties, and what fill does on faces."""
    return [row for row in rows if row.form not in OF_FILL], [row for row in rows if row.form in OF_FILL]


def _on_faces(rows: Sequence[TieRow], state: TieState | None = None) -> int:
    """How many faces fill holds, or holds in one state; cohesion, which is listed by itself, counts with its face."""
    return sum(row.form == FILL and state in (None, row.state) for row in rows)


def _tie_blocks(model: Model, rows: Sequence[TieRow]) -> list[Block]:
    size, units = float(np.abs(model.blocks.vertices).max(initial=0.0)), model.units
    head = ["tie", "from", "to", f"from [{units.length}]", f"to [{units.length}]", f"force [{units.force}]"]
    table = [
        [row.name, row.from_body, row.to_body, vector(row.from_place, size), vector(row.to_place, size), _limits(row)]
        for row in rows[:MOST_ROWS]
    ]
    length = f"{number(float(model.ties.lengths.sum()))} {units.length} in all; tension is positive"
    caption = f"{counted(len(rows), 'tie')}, {length}"
    blocks = table_of(head, table, left=5, caption=caption, total=len(rows), flush=True)
    fitted = float(model.ties.prestress.max())
    if fitted > 0.0:
        count = int((model.ties.prestress > 0.0).sum())
        words = f"{counted(count, 'tie')} of these prestressed, by up to {number(fitted)} {units.force}"
        says = f"{words}: that counts in whether the structure stands and in no load factor."
        blocks.append(Paragraph(says, flush=True))
    return blocks


def _limits(row: TieRow) -> str:
    return f"{number(row.least)} .. {number(row.greatest)}"


def tie_force_blocks(model: Model, mechanics: Mechanics) -> list[Block]:
    """Forces of ties at collapse, those that yield first, then by how much of their capacity they use; then of fill."""
    ties, soil = _parted(tie_rows(model, mechanics))
    blocks: list[Block] = []
    if ties:
        yielding = sum(row.state is TieState.YIELDS for row in ties)
        slack = sum(row.state is TieState.SLACK for row in ties)
        words = (
            f"{yielding} of {counted(len(ties), 'tie')} yield, {slack} are slack. Forces of ties that do neither are "
            "those of the state shown; others are possible. Elongation rates are scaled as the mechanism"
        )
        blocks += _force_table(model, ties, ("tie", "of capacity"), TieState.YIELDS, words)
    if soil:
        passive, active = (_on_faces(soil, state) for state in (TieState.PASSIVE, TieState.ACTIVE))
        words = (
            f"Fill is at its passive limit on {passive} of {counted(_on_faces(soil), 'face')}, at its active limit on "
            f"{active}. Pushes of the others are those of the state shown; others are possible. Faces move away where "
            "it elongates, at rates scaled as the mechanism"
        )
        blocks += [GAP] * bool(ties) + _force_table(model, soil, ("face", "of passive"), TieState.PASSIVE, words)
    return blocks


def _force_table(
    model: Model, rows: Sequence[TieRow], names: tuple[str, str], state: TieState, caption: str
) -> list[Block]:
    """Rows with this state first."""
    order = sorted(rows, key=lambda row: (row.state is not state, -float(np.nan_to_num(row.use))))
    what, limit = names
    head = [what, "from", "to", f"force [{model.units.force}]", limit, "", "elongates"]
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
    return table_of(head, shown, left=3, caption=caption, total=len(rows))
