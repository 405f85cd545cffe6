"""What ties do at collapse: their forces, how much of their capacity that is, and which of them yield."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Message
from mbla.model.model import Model
from mbla.model.ties.ties import OUTSIDE
from mbla.solution.full_model.contact_modes import AT_REST
from mbla.solution.solution import Mechanics, Solution


class TieState(StrEnum):
    """What a tie does in the mechanism; empty where it neither yields nor goes slack. Fill is at one of its limits."""

    YIELDS = "yields"
    SLACK = "slack"
    PASSIVE = "passive limit"
    ACTIVE = "active limit"
    HOLDS = ""


@dataclass(frozen=True)
class TieRow:
    """One tie, tension positive.

    from_place, to_place : (3,) m, first and last point
    from_body, to_body   : names of the blocks there
    use    : force over what it may have in its sense; nan without a force or without a limit
    rate   : elongation rate, scaled as the mechanism
    power  : that it dissipates, live load power = 1
    """

    name: str
    form: str
    from_body: str
    to_body: str
    from_place: FloatArray
    to_place: FloatArray
    length: float
    least: float
    greatest: float
    prestress: float
    force: float
    use: float
    rate: float
    power: float
    state: TieState


def tie_rows(model: Model, mechanics: Mechanics | None) -> tuple[TieRow, ...]:
    """All ties of a model, with what they do in a mechanism where there is one."""
    ties = model.ties
    if not len(ties):
        return ()
    unknown = np.full(len(ties), np.nan)
    forces = unknown if mechanics is None or mechanics.tie_forces is None else mechanics.tie_forces
    rates = unknown if mechanics is None or mechanics.tie_rates is None else mechanics.tie_rates
    states = _states(model, mechanics)
    limit = np.where(forces < 0.0, ties.least, ties.greatest)
    use = np.divide(forces, limit, out=unknown.copy(), where=np.isfinite(limit) & (limit != 0.0))
    use = np.where(forces == 0.0, 0.0, use)
    first, last, lengths = ties.start[:-1], ties.start[1:] - 1, ties.lengths
    return tuple(
        TieRow(
            name=ties.names[row],
            form=ties.forms[row],
            from_body=_body(model, int(ties.bodies[first[row]])),
            to_body=_body(model, int(ties.bodies[last[row]])),
            from_place=ties.places[first[row]],
            to_place=ties.places[last[row]],
            length=float(lengths[row]),
            least=float(ties.least[row]),
            greatest=float(ties.greatest[row]),
            prestress=float(ties.prestress[row]),
            force=float(forces[row]),
            use=float(use[row]),
            rate=float(rates[row]),
            power=float(forces[row] * rates[row]),
            state=states[row],
        )
        for row in range(len(ties))
    )


def _body(model: Model, body: int) -> str:
    return "outside" if body == OUTSIDE else model.blocks.name(body)


def _states(model: Model, mechanics: Mechanics | None) -> list[TieState]:
    """As of contact points: a tie yields where its rate over the greatest exceeds what it has left over the largest."""
    ties = model.ties
    if mechanics is None or mechanics.tie_forces is None or mechanics.tie_rates is None:
        return [TieState.HOLDS] * len(ties)
    forces, rates = mechanics.tie_forces, mechanics.tie_rates
    speeds = np.append(np.linalg.norm(mechanics.contact_velocities, axis=1), np.abs(rates[np.isfinite(rates)]))
    share = rates / (float(speeds.max(initial=0.0)) or 1.0)
    size = float(np.abs(forces[np.isfinite(forces)]).max(initial=0.0)) or 1.0
    longer = share > np.maximum((ties.greatest - forces) / size, AT_REST)
    shorter = -share > np.maximum((forces - ties.least) / size, AT_REST)
    soil = ties.of_fill
    found = {
        TieState.PASSIVE: soil & shorter,
        TieState.ACTIVE: soil & longer,
        TieState.YIELDS: ~soil & ((longer & (ties.greatest > 0.0)) | (shorter & (ties.least < 0.0))),
        TieState.SLACK: ~soil & ((longer & (ties.greatest <= 0.0)) | (shorter & (ties.least >= 0.0))),
    }
    return [next((state for state, rows in found.items() if rows[row]), TieState.HOLDS) for row in range(len(ties))]


def brittle_remarks(model: Model, solution: Solution) -> tuple[Message, ...]:
    """A remark where several ties yield together of which some break as soon as they do."""
    if solution.mechanics is None or not len(model.ties) or solution.further.pushover.rows is not None:
        return ()
    rows = tie_rows(model, solution.mechanics)
    yielding = [number for number, row in enumerate(rows) if row.state is TieState.YIELDS]
    brittle = sum(float(model.ties.breaks_at[number]) == 0.0 for number in yielding)
    if not brittle or len(yielding) < 2:
        return ()
    words = (
        f"{brittle} of the {len(yielding)} ties that yield are brittle: the load factor has all of them at their "
        "capacity at once, which they need not be when the first one breaks"
    )
    return (Message("brittle-ties", words),)


def tie_power(mechanics: Mechanics) -> float:
    """Power that ties dissipate, with unit power of the live load; those of constant force among them."""
    if mechanics.tie_forces is None or mechanics.tie_rates is None:
        return 0.0
    return float(np.nansum(mechanics.tie_forces * mechanics.tie_rates))


def acting_with_ties(model: Model, acting: FloatArray, mechanics: Mechanics) -> FloatArray:
    """Forces and moments about centroids, (n_blocks, 6) N, N m, with those of ties on the blocks added."""
    if mechanics.tie_forces is None:
        return acting
    bodies, pulls = pulls_of_ties(model, mechanics.tie_forces)
    on_blocks = bodies != OUTSIDE
    block, about, total = bodies[on_blocks], pulls[on_blocks], acting.copy()
    about[:, 3:] -= np.cross(model.blocks.centroids[block], about[:, :3])
    np.add.at(total, block, about)
    return total


def pulls_of_ties(model: Model, tie_forces: FloatArray) -> tuple[IntArray, FloatArray]:
    """Block at each point of all ties, or OUTSIDE, (m,), and force and moment about the origin on it, (m, 6) N, N m.

    tie_forces : (n_ties,) N, nan where not known
    """
    ties = model.ties
    forces = np.nan_to_num(tie_forces)[ties.tie_of_point, None] * ties.pulls
    return ties.bodies, np.hstack([forces, np.cross(ties.places, forces)])
