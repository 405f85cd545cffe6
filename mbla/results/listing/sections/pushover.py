"""A pushover in words, and its table: how far a structure moves, where it ends, and how well that is known."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mbla.arrays import evenly
from mbla.model.model import LoadCase, Model
from mbla.results.listing.blocks import MOST_ROWS, Block, paragraphs, table_of
from mbla.results.listing.text import counted, full_sentence, number, small, within
from mbla.results.listing.verdict_words import load_factor_words
from mbla.results.outcome import curve_residual, ultimate_displacement
from mbla.results.results import CaseResult
from mbla.solution.pushover.curve_rows import CurveEnd, CurveRow
from mbla.solution.pushover.followed import STEP_DEPENDENCE, greatest_value, step_dependence
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, SOLVED_RESIDUAL

NOTABLE_MISS = 0.02
"""share of the energy whose loss is said in words"""


def curve_words(model: Model, case: CaseResult) -> str:
    """Greatest load factor, where it ends, and how well that is known; empty without a pushover."""
    pushed, length, question = case.solution.further.pushover, model.units.length, case.load_case.question
    curve, errors = pushed.curve, np.array([row.error for row in pushed.curve])
    if not curve:
        return ""
    last, words, end = curve[-1], pushed.curve_end.value, pushed.curve_end_error
    if question.group == "reaction":
        force, reaction = model.units.force, within(last.reaction, pushed.curve_last_error * question.scale)
        says = f"Followed over {counted(len(curve) - 1, 'step')}: a reaction of {reaction} {force} where "
        says += f"the support has moved by {within(last.displacement, end)} {length}, where {words}"
    else:
        top = max(curve, key=lambda row: row.load_factor)
        highest = row_words(model, case.load_case, top)
        says = f"Pushover of {counted(len(curve) - 1, 'step')}: at most {highest} at "
        says += f"{number(top.displacement)} {length}; "
        ultimate = ultimate_displacement(case, sure=False)
        if pushed.curve_end is CurveEnd.NOTHING_LEFT:
            says += f"nothing at {within(ultimate, end)} {length}"
        else:
            says += f"nothing at {number(ultimate)} {length}; " if last.load_factor < 0.0 else ""
            says += f"{row_words(model, case.load_case, last)} at {within(last.displacement, end)} {length}"
            says += f", where {words}"
    if np.isfinite(errors).any():
        share = np.nanmax(errors) / greatest_value(case.load_case, np.array([row.load_factor for row in curve]))
        says += f"; steps of twice the size differ by up to {share:.1g} of the greatest"
    if broken := curve[-1].broken:
        first = next(row.displacement for row in curve if row.broken)
        says += f"; {counted(broken, 'tie')} broken, the first at {number(first)} {length}"
    fallen = curve[-1].debris
    says += f"; {counted(fallen, 'block')} fell before the rest" if fallen else ""
    says += jumps_words(curve, length)
    stiff = f" {stiffness_words(model, case)}" if _in_space(case) else ""
    return f"{says}. {curve_verdict(case, length)}{stiff}"


def no_curve_words(case: CaseResult) -> str:
    """Why there is no pushover although one is asked for; empty where there is, or none is."""
    said = (remark for remark in case.solution.remarks if remark.identifier == "pushover-not-done")
    return next((full_sentence(remark.words) for remark in said), "")


def jumps_words(curve: Sequence[CurveRow], length: str) -> str:
    """How often the structure jumps and where first, and steps that were not found, to go on a sentence."""
    jumps, unsolved, says = sum(row.jumps for row in curve), sum(row.unsolved for row in curve), ""
    if jumps:
        first = next(before for before, row in pairwise(curve) if row.jumps)
        says += f"; {counted(jumps, 'jump')}, the first behind {number(first.displacement)} {length}"
    return says + (f"; {counted(unsolved, 'step')} between not found" if unsolved else "")


def stiffness_words(model: Model, case: CaseResult) -> str:
    """How stiff the joints of a pushover are; empty without one."""
    rows, units = case.solution.further.pushover.rows, model.units
    if rows is None:
        return ""
    across, along = rows.stiffness
    return f"Its joints are as stiff as {across:.3g} {units.force}/{units.length}3 across and {along:.3g} along."


def _in_space(case: CaseResult) -> bool:
    size = case.solution.size
    return size is not None and size.dimension == 3


def row_words(model: Model, load_case: LoadCase, row: CurveRow) -> str:
    """The load factor of a row as that of its load case: ``0.145 g``; of a tilting table ``9.3 degrees of tilt``."""
    if load_case.question.group == "angle":
        return load_case.question.told(row.angle, model.units)
    return load_factor_words(model, load_case, row.load_factor)


def curve_verdict(case: CaseResult, length: str) -> str:
    """How well the steps of a pushover meet the joint law, as code that did not solve them finds."""
    pushed = case.solution.further.pushover
    residuals = [row.residual for row in pushed.curve[1:]]
    rough = sum(not residual <= SOLVED_RESIDUAL for residual in residuals)
    worst = curve_residual(case)
    if not residuals:
        return "No step could be made."
    if not rough and (share := step_dependence(case.load_case, pushed)) > STEP_DEPENDENCE:
        says = f"Approximate: every step meets equilibrium and the joint law to {worst:.1g}, but figures depend on the "
        return f"{says}size of the steps: with twice the size they change by up to {share:.2g} of the greatest."
    if not rough:
        overlap = max(row.overlap for row in pushed.curve)
        says = f"Verified: every step meets equilibrium and the joint law to {worst:.1g}"
        crushes = any(row.crushing for row in pushed.curve)
        says += f", {'points are crushed' if crushes else 'blocks overlap'} by {overlap:.1g} {length} at most"
        missing = abs(energy_missing(pushed.curve, _small_energy(case)))
        return (
            f"{says}." if missing < NOTABLE_MISS else f"{says}; {missing:.2g} of the energy is lost where blocks drop."
        )
    name = "Not verified" if not worst <= APPROXIMATE_RESIDUAL else "Approximate"
    steps = "step misses" if rough == 1 else "steps miss"
    return f"{name}: {rough} of {len(residuals)} {steps} equilibrium or the joint law by up to {worst:.1g}."


def curve_blocks(model: Model, case: CaseResult) -> list[Block]:
    """The capacity curve: a sentence, and a table of steps evenly chosen; nothing without a pushover."""
    curve, units = case.solution.further.pushover.curve, model.units
    if not curve:
        return []
    question, tied, crushed = case.load_case.question, bool(len(model.ties)), any(row.crushing for row in curve)
    jumped = [row.step for row in curve if row.jumps][:MOST_ROWS]
    shown = [curve[row] for row in sorted({*evenly(len(curve), MOST_ROWS), *jumped})]
    rows = [
        [
            str(row.step),
            *(number(value) for value in (row.displacement, row.answer)),
            *(small(value) for value in (row.error * question.scale, row.residual if row.step else np.nan)),
            *(
                f"{value + 0.0:.4g}"
                for value in (row.live_work, row.friction + row.tie_work + row.crushing, row.potential)
            ),
            small(energy_missing(curve[: row.step + 1], _small_energy(case)) if row.step else np.nan),
            "jump" if row.jumps else "new" if row.new_mechanism else "",
        ]
        for row in shown
    ]
    head = ["step", f"moved [{units.length}]", question.head(units)]
    several = tied or crushed
    head += ["error", "residual", "live work", "lost" if several else "friction", "dead load", "left", "motion"]
    says = [curve_words(model, case), *([] if _in_space(case) else [stiffness_words(model, case)])]
    by = ["in friction", *(["by ties"] if tied else []), *(["by crushing"] if crushed else [])]
    lost = f"what is lost, {' and '.join(by)}," if several else "friction"
    says.append(
        f"Work and energies in {units.force} {units.length}; left is the live work less {lost} and what the dead load "
        "gained, over the greatest of these: what elastic joints store, and what goes where blocks drop."
    )
    if any(row.new_mechanism for row in curve):
        says.append("Behind a step that is marked new the structure has moved in another way than to the one before.")
    if any(row.jumps for row in curve):
        says.append(
            "Before a step that is marked jump no equilibrium is nearby: the structure moves in time to its next rest."
        )
    return [*paragraphs(*says), *table_of(head, rows, total=len(curve))]


SMALL_ENERGY = 1e-6
"""share of the dead load times the displacement, below which energies are rounding"""


def _small_energy(case: CaseResult) -> float:
    dead = float(np.abs(case.load_case.dead_load[:, :3]).sum())
    return SMALL_ENERGY * dead * abs(case.solution.further.pushover.curve[-1].displacement)


def energy_missing(curve: Sequence[CurveRow], least: float = 0.0) -> float:
    """Live work that neither friction, ties, crushing nor the dead load has taken, over the largest of these, or
    ``least``.
    """
    last = curve[-1]
    taken = last.friction, last.tie_work, last.crushing
    size = max(abs(last.live_work), *taken, abs(last.potential), least, 1e-300)
    return (last.live_work - sum(taken) - last.potential) / size
