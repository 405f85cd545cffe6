"""The table of load cases: one row each, with what was found, how well it is verified and what it took."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.rigid_parts import moving_share
from mbla.results.outcome import associative_of, best_iterate, factor_unique, least_and_greatest, range_of, result_of
from mbla.results.record.quantity import UnitKind
from mbla.results.tables.case_rows import CaseRows, case_rows
from mbla.results.tables.column import Column, Values, as_text, bools, floats, ints, texts
from mbla.results.tables.table import TableKind
from mbla.results.tilt_angle import angle_bounds, angle_of
from mbla.solution.solution import Mechanics


def _number(name: str, words: str, of: Callable[[CaseRows], float | None], unit: UnitKind = "1") -> Column[CaseRows]:
    """A single number of each case; None: there is none."""

    def values(rows: CaseRows) -> Values:
        value = of(rows)
        return np.array([np.nan if value is None else value])

    return floats(name, unit, words, values)


def _whole(name: str, words: str, of: Callable[[CaseRows], int | None]) -> Column[CaseRows]:
    def values(rows: CaseRows) -> Values:
        value = of(rows)
        return np.ma.array([value or 0], mask=[value is None])

    return ints(name, words, values)


def _text(name: str, words: str, of: Callable[[CaseRows], str]) -> Column[CaseRows]:
    return texts(name, words, lambda rows: as_text([of(rows)]))


def _check(name: str, words: str) -> Column[CaseRows]:
    return _number(name, words, lambda rows: getattr(rows.case.checks, name))


def _factor(mechanics: Mechanics | None) -> float | None:
    return None if mechanics is None else mechanics.load_factor


def _reaction(load_factor: float | None, rows: CaseRows, turns: bool) -> float | None:
    settlement = rows.case.load_case.settlement
    if settlement is None or load_factor is None or settlement.turns != turns:
        return None
    return settlement.reaction(load_factor)


def _unique(rows: CaseRows) -> str:
    unique = factor_unique(rows.model, rows.case)
    return "" if unique is None else "yes" if unique else "no"


def _standing(rows: CaseRows) -> str:
    standing = rows.case.solution.standing
    return "" if standing is None else standing.verdict.value


def _extent(end: int) -> Callable[[CaseRows], float]:
    return lambda rows: least_and_greatest(rows.model, rows.case)[end]


def _range_end(end: int) -> Callable[[CaseRows], float | None]:
    def value(rows: CaseRows) -> float | None:
        ends = range_of(rows.case)
        return None if ends is None else ends[end]

    return value


def _spread(end: int) -> Callable[[CaseRows], float | None]:
    def value(rows: CaseRows) -> float | None:
        spread = rows.case.solution.spread
        return None if spread is None else spread[end]

    return value


def _modes(mode: InterfaceMode) -> Column[CaseRows]:
    def count(rows: CaseRows) -> int | None:
        return None if rows.collapse is None else rows.collapse.interfaces.count(mode)

    return _whole(f"{mode.name.lower()}_interfaces", f"interfaces of mode {mode.name.lower()}", count)


def _moving_share(rows: CaseRows) -> float | None:
    return None if rows.collapse is None else moving_share(rows.model, rows.collapse.parts)


def _moving_blocks(rows: CaseRows) -> int | None:
    return None if rows.collapse is None else int(np.sum(~rows.model.fixed & (rows.collapse.parts > 0)))


VERDICT: tuple[Column[CaseRows], ...] = (
    _text("case", "load case", lambda rows: rows.case.load_case.name),
    _text("status", "status after verification", lambda rows: rows.case.status.value),
    _text("reason", "why it is not plainly solved, in words", lambda rows: rows.case.solution.reason),
    bools("verified", "everything is within tolerance", lambda rows: np.array([rows.case.checks.verified])),
    _text("failures", "what is not, in words", lambda rows: "; ".join(rows.case.checks.failures)),
    _text("remarks", "what a reader of the figure must know", lambda rows: "; ".join(rows.case.solution.remarks)),
    _text("flow_rule", "flow rule of the load factor", lambda rows: rows.case.solution.flow_rule),
    _text("scheme", "how a flow without normality was solved", lambda rows: rows.case.solution.scheme),
    _text("contact_model", "concave or convex", lambda rows: rows.case.solution.contact_model),
    _text("standing", "whether it stands under its dead load alone; empty: not assessed", _standing),
)

FACTORS: tuple[Column[CaseRows], ...] = (
    _number("load_factor", "load factor; empty where the case has no result", lambda r: _factor(result_of(r.case))),
    _number(
        "least_load_factor", "least load factor that was found; the load factor where that is the only one", _extent(0)
    ),
    _number("greatest_load_factor", "the greatest of them; inf: there is no limit", _extent(1)),
    _text("factor_unique", "whether it is the only one: yes, no, empty: not known", _unique),
    _number("associative_load_factor", "by associative flow", lambda r: _factor(associative_of(r.case))),
    _number(
        "best_iterate_load_factor",
        "where the case has no result: the best that was reached, which is none",
        lambda rows: _factor(best_iterate(rows.case)),
    ),
    _check("static_bound", "verified lower bound of the associative load factor"),
    _check("kinematic_bound", "verified upper bound of it"),
    _check("gap", "relative distance of the two bounds"),
    _number("range_lower", "verified least load factor for the mechanism found", _range_end(0)),
    _number("range_upper", "verified greatest load factor for it", _range_end(1)),
    _check("peak_load_factor", "verified greatest load factor of the load path, where it lies above load_factor"),
    _number("spread_lower", "least load factor of several tries that did not agree", _spread(0)),
    _number("spread_upper", "greatest of them", _spread(1)),
    _number("angle", "tilting table: angle of collapse", lambda rows: angle_of(rows.case), "degree"),
    _number("angle_lower", "tilting table: angle certainly borne", lambda rows: angle_bounds(rows.case)[0], "degree"),
    _number("angle_upper", "tilting table: angle certainly not", lambda rows: angle_bounds(rows.case)[1], "degree"),
    _number(
        "reaction_force",
        "settlement: reaction of the support as the structure follows it, positive against the motion",
        lambda rows: _reaction(_factor(result_of(rows.case)), rows, turns=False),
        "force",
    ),
    _number(
        "reaction_moment",
        "the same of a support that turns",
        lambda rows: _reaction(_factor(result_of(rows.case)), rows, turns=True),
        "moment",
    ),
)

RESIDUALS: tuple[Column[CaseRows], ...] = (
    _check("equilibrium_residual", "largest unbalanced force over mean block weight"),
    _check("yield_violation", "largest excess over the joint's strength over mean block weight"),
    _check("tension_violation", "largest tension beyond the tensile strength over mean block weight"),
    _check("penetration", "largest closing velocity over largest contact speed"),
    _check("complementarity_residual", "share of the power balance left unexplained under the flow rule"),
    _check("slip_residual", "the part of it that sliding against friction leaves unexplained"),
    _check("live_power", "live load times mechanism, should be 1"),
    _check("power_balance", "dissipation minus external power over the larger of the two"),
)

MECHANISM: tuple[Column[CaseRows], ...] = (
    _text(
        "figures",
        "what the mechanism told in the next columns is: result; best_iterate; empty: there is none",
        lambda rows: rows.figures,
    ),
    _number("moving_weight_share", "share of the weight of the free blocks that moves", _moving_share),
    _whole("moving_blocks", "free blocks that move", _moving_blocks),
    _whole("moving_parts", "rigid parts that move", lambda r: None if r.collapse is None else len(r.collapse.motions)),
    *(_modes(mode) for mode in InterfaceMode),
)

EFFORT: tuple[Column[CaseRows], ...] = (
    _whole("programs", "programs solved", lambda rows: len(rows.case.solution.programs)),
    _whole("iterations", "their iterations", lambda rows: sum(p.iterations for p in rows.case.solution.programs)),
    _number("time", "time of the solver stage", lambda rows: rows.case.solution.seconds, "time"),
    _number(
        "solver_time",
        "time of the programs in it",
        lambda rows: float(sum(program.seconds for program in rows.case.solution.programs)),
        "time",
    ),
)

CASES = TableKind("cases", "each load case", (*VERDICT, *FACTORS, *RESIDUALS, *MECHANISM, *EFFORT), case_rows)
