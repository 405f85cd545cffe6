"""The capacity curve of a load case and remarks on it, from its rows alone.

Every row is judged as what it is, a pose at which joints with their law and their history balance the loads
(:mod:`mbla.solution.verification.pushed_rows`). Row 0 is the structure as it starts to move, whose state is that of the
load factor. How much the curve depends on the size of its steps: :mod:`mbla.solution.pushover.followed`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.pushover.control import MOVES, Control
from mbla.solution.pushover.curve_rows import CurveRow
from mbla.solution.pushover.followed import STEP_DEPENDENCE, step_dependence
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.solution.pushover.start import factor_at_start, speeds_at_start, start_of
from mbla.solution.solution import Solution
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.pushed_rows import row_residuals
from mbla.solution.verification.verify import residual_of

BY_ITSELF_SHARE, NOTABLE_DROP = 3.0, 0.02
"""Energy that the dead load loses between two rows over the live work from which blocks drop there, and over the
greatest live work of the curve from which that is said."""

ALIKE = 0.9
"""Cosine between the motions to two rows below which they are two mechanisms."""


def curve_of(assembly: Assembly, case: LoadCase, solution: Solution, rows: PushedRows) -> tuple[CurveRow, ...]:
    """Rows of the curve from poses, points, forces and history on record; row 0 is that of the load factor."""
    model = assembly.model.of_case(case)
    control = Control.of(model, case, start_of(solution).mechanism)
    found = row_residuals(assembly, case, solution.flow_rule, rows)
    poses, factors, start = list(rows.poses), rows.load_factors, "mechanics"
    if solution.least is not None and start_of(solution) is solution.least:
        start = "least"
    begins = residual_of(assembly, case, solution, start)
    curve, figures = list[CurveRow](), [case.question.value_at(float(factor)) for factor in factors]
    motions = [np.zeros((len(model.blocks), 6))]
    for number, pose in enumerate(poses):
        if number:
            motions.append(poses[number - 1].motion_to(pose))
        broken = int((~model.ties.of_fill).sum()) - _ties_left(model, rows.points_of(number)) if number else 0
        curve.append(
            CurveRow(
                step=number,
                displacement=control.displacement(model, pose),
                load_factor=float(factors[number]),
                reaction=figures[number] if case.question.group == "reaction" else np.nan,
                angle=figures[number] if case.question.group == "angle" else np.nan,
                error=float(rows.errors[number]),
                residual=found[number].largest if number else begins,
                overlap=found[number].overlap if number else 0.0,
                live_work=float(rows.energies[number, 0]),
                friction=float(rows.energies[number, 1]),
                tie_work=float(rows.energies[number, 2]),
                crushing=float(rows.energies[number, 3]),
                potential=float(rows.energies[number, 4]),
                new_mechanism=number > 1 and _alike(model, motions[number - 1], motions[number]) < ALIKE,
                jumps=int(rows.jumps[number]),
                unsolved=int(rows.unsolved[number]),
                debris=int(rows.fallen[number].sum()),
                broken=broken,
            )
        )
    return tuple(curve)


def _ties_left(model: Model, points: RowPoints) -> int:
    """Ties, but for those of fill, that a row has."""
    own = points.laws[points.bodies[:, 0] < 0]
    return int((~model.ties.of_fill[own]).sum())


def dropped(curve: Sequence[CurveRow]) -> tuple[float, float] | None:
    """Where blocks first drop by a notable energy of the dead load without live work, and all that is lost so.

    Displacement of the control point, m, and energy over the greatest live work; None where nothing does.
    """
    size = max((abs(row.live_work) for row in curve), default=0.0)
    falls = [
        (before.displacement, lost)
        for before, after in pairwise(curve)
        if (lost := before.potential - after.potential - _taken(before, after))
        > BY_ITSELF_SHARE * abs(after.live_work - before.live_work)
    ]
    lost = sum(energy for _, energy in falls)
    return (falls[0][0], lost / size) if lost > NOTABLE_DROP * size else None


def _taken(before: CurveRow, after: CurveRow) -> float:
    """What ties and joints that crush take from one row to the next."""
    return after.tie_work - before.tie_work + after.crushing - before.crushing


def _alike(model: Model, one: FloatArray, other: FloatArray) -> float:
    """Cosine between two motions, (n_blocks, 6), rotations with half the block size as arm, by volume."""
    scale = np.sqrt(model.blocks.volumes)[:, None] * np.repeat([[1.0, 1.0]], len(one), axis=0)
    scale[:, 1] *= model.blocks.sizes / 2
    first, second = (each * np.repeat(scale, 3, axis=1) for each in (one, other))
    size = float(np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.vdot(first, second)) / size if size > 0.0 else 1.0


def begun_by(case: LoadCase, solution: Solution, rows: PushedRows) -> PushedRows:
    """Rows of a pushover with the load factor at which the structure starts to move in row 0, as it must be."""
    factors, shifts = rows.load_factors.copy(), rows.shifts.copy()
    turns, fallen = rows.turns.copy(), rows.fallen.copy()
    factors[0], shifts[0], turns[0], fallen[0] = factor_at_start(case, solution), 0.0, 0.0, False
    return replace(rows, load_factors=factors, shifts=shifts, turns=turns, fallen=fallen)


def pushover_remarks(model: Model, case: LoadCase, solution: Solution, pushover: Pushover) -> tuple[Message, ...]:
    """What a reader of a capacity curve must know, from its rows and its first mechanism.

    model : as it may move under the load case
    """
    curve, remarks = pushover.curve, list[Message]()
    speed, greatest = speeds_at_start(model, case, solution)
    if not speed > MOVES * greatest:
        words = "the control point of the pushover does not go the way in which its displacement counts at first"
        remarks.append(Message("control-point-at-rest", words))
    if fall := dropped(curve):
        words = f"blocks drop without the live load where the control point has moved by {fall[0]:.6g}, and lose "
        words += f"{fall[1]:.2g} of the greatest live work: what is pushed on may fall there"
        remarks.append(Message("pushover-drops", words))
    rough = [row for row in curve[1:] if row.residual > SOLVED_RESIDUAL]
    if rough:
        worst = max(rough, key=lambda row: row.residual)
        words = f"{len(rough)} of {len(curve) - 1} steps of the pushover violate the joint law by more than "
        words += f"{SOLVED_RESIDUAL:g}, step {worst.step} the most, by {worst.residual:.2g}"
        remarks.append(Message("pushover-rough", words))
    return (*remarks, *_step_remarks(case, pushover))


def _step_remarks(case: LoadCase, pushover: Pushover) -> Iterator[Message]:
    """The remark where the curve depends on its step."""
    curve, share, end = pushover.curve, step_dependence(case, pushover), pushover.curve_end_error
    if share > STEP_DEPENDENCE:
        words = f"with steps of twice the size figures of the pushover change by up to {share:.2g} of the greatest"
        words += f", and its end by {end:.2g} from {curve[-1].displacement:.3g}" if np.isfinite(end) else ""
        yield Message("pushover-depends-on-step", words)
