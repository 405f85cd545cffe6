"""A pushover in words, and its table: how far a structure moves, where it ends, and how well that is known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import evenly
from mbla.model.model import LoadCase, Model
from mbla.results.listing.answers import answer_head
from mbla.results.listing.text import MOST_ROWS, counted, long_table, number, sentence, small, within
from mbla.results.listing.verdict_words import load_factor_words
from mbla.results.outcome import curve_residual, ultimate_displacement
from mbla.results.results import CaseResult
from mbla.solution.pushover.followed import STEP_DEPENDENCE, step_dependence
from mbla.solution.pushover.pushed import CurveEnd, CurveRow
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, SOLVED_RESIDUAL

NOTABLE_MISS = 0.02
"""share of the energy whose loss is said in words"""


def curve_words(model: Model, case: CaseResult) -> str:
    """Greatest load factor, where it ends, and how well that is known; empty without a pushover."""
    curve, length = case.solution.curve, model.units.length
    if not curve:
        return ""
    last, words, end = curve[-1], case.solution.curve_end.value, case.solution.curve_end_error
    if case.load_case.settlement is not None:
        force = model.units.force
        reaction = within(last.reaction, case.solution.curve_last_error * case.load_case.settlement.unit)
        says = f"Followed over {counted(len(curve) - 1, 'step')}: a reaction of {reaction} {force} where "
        says += f"the support has moved by {within(last.displacement, end)} {length}, where {words}"
    else:
        top = max(curve, key=lambda row: row.load_factor)
        highest = row_words(model, case.load_case, top)
        says = (
            f"Pushover of {counted(len(curve) - 1, 'step')}: at most {highest} at {number(top.displacement)} {length}; "
        )
        ultimate = ultimate_displacement(case, sure=False)
        if case.solution.curve_end is CurveEnd.NOTHING_LEFT:
            says += f"nothing at {within(ultimate, end)} {length}"
        else:
            says += f"{row_words(model, case.load_case, last)} at {within(last.displacement, end)} {length}"
            says += f", where {words}"
    errors = np.array([row.error for row in curve])
    if np.isfinite(errors).any():
        settles = case.load_case.settlement
        values = [row.load_factor if settles is None else row.reaction / settles.unit for row in curve]
        says += (
            f"; steps of twice the size differ by up to {np.nanmax(errors) / np.abs(values).max():.1g} of the greatest"
        )
    if broken := curve[-1].broken:
        first = next(row.displacement for row in curve if row.broken)
        says += f"; {counted(broken, 'tie')} broken, the first at {number(first)} {length}"
    fallen = curve[-1].debris
    says += f"; {counted(fallen, 'block')} fell before the rest" if fallen else ""
    return f"{says}. {curve_verdict(case, length)}"


def row_words(model: Model, load_case: LoadCase, row: CurveRow) -> str:
    """The load factor of a row as that of its load case: ``0.145 g``; of a tilting table ``9.3 degrees of tilt``."""
    if load_case.tilt is not None:
        return f"{number(row.angle)} degrees of tilt"
    return load_factor_words(model, load_case, row.load_factor)


def curve_verdict(case: CaseResult, length: str) -> str:
    """How well the steps of a pushover meet the joint law, as code that did not solve them finds."""
    residuals = [row.residual for row in case.solution.curve[1:]]
    rough = sum(not residual <= SOLVED_RESIDUAL for residual in residuals)
    worst = curve_residual(case)
    if not residuals:
        return "No step could be made."
    if not rough and (share := step_dependence(case.load_case, case.solution)) > STEP_DEPENDENCE:
        says = f"Approximate: every step meets equilibrium and the joint law to {worst:.1g}, but figures depend on the "
        return f"{says}size of the steps: with twice the size they change by up to {share:.2g} of the greatest."
    if not rough:
        overlap = max(row.overlap for row in case.solution.curve)
        says = f"Verified: every step meets equilibrium and the joint law to {worst:.1g}"
        crushes = any(row.crushing for row in case.solution.curve)
        says += f", {'points are crushed' if crushes else 'blocks overlap'} by {overlap:.1g} {length} at most"
        missing = abs(energy_missing(case.solution.curve))
        return (
            f"{says}." if missing < NOTABLE_MISS else f"{says}; {missing:.2g} of the energy is lost where blocks drop."
        )
    name = "Not verified" if not worst <= APPROXIMATE_RESIDUAL else "Approximate"
    steps = "step misses" if rough == 1 else "steps miss"
    return f"{name}: {rough} of {len(residuals)} {steps} equilibrium or the joint law by up to {worst:.1g}."


def curve_lines(model: Model, case: CaseResult) -> list[str]:
    """The capacity curve: a sentence, and a table of steps evenly chosen; nothing without a pushover."""
    curve, units = case.solution.curve, model.units
    if not curve:
        return []
    tied, crushed = bool(len(model.ties)), any(row.crushing for row in curve)
    shown = [curve[row] for row in evenly(len(curve), MOST_ROWS)]
    rows = [
        [
            str(row.step),
            *(number(value) for value in (row.displacement, row.answer)),
            *(small(value) for value in (row.residual if row.step else np.nan, row.overlap)),
            *(number(value) for value in (row.live_work, row.friction + row.crushing, row.potential)),
            *([number(row.tie_work)] if tied else []),
            "new" if row.new_mechanism else "",
        ]
        for row in shown
    ]
    head = ["step", f"moved [{units.length}]", answer_head(model, case.load_case), "residual"]
    head += ["overlap", "live work", "friction", "dead load", *(["ties"] if tied else []), "motion"]
    says = [curve_words(model, case)]
    missing = energy_missing(curve)
    taken = "friction, ties" if tied else "friction"
    says.append(f"Live work less {taken} and what the dead load gained: {missing:.2g} of the live work.")
    says.append(f"Work and energies in {units.force} {units.length}, overlap of blocks in {units.length}.")
    says += ["Friction is with what crushing takes."] if crushed else []
    return ["", *(line for words in says for line in sentence(words)), *long_table(head, rows, len(curve))[1:]]


def energy_missing(curve: Sequence[CurveRow]) -> float:
    """Live work that neither friction, ties, crushing nor the dead load has taken, over the largest of these."""
    last = curve[-1]
    taken = last.friction, last.tie_work, last.crushing
    size = max(abs(last.live_work), *taken, abs(last.potential), 1e-300)
    return (last.live_work - sum(taken) - last.potential) / size
