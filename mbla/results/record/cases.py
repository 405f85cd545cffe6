"""Columns of load cases, one value each: what was found, how well it is verified, and what it took."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.rigid_parts import moving_blocks, moving_share
from mbla.results.outcome import (
    angle_bounds,
    angle_of,
    associative_of,
    best_iterate,
    factor_unique,
    least_and_greatest,
    range_of,
    result_of,
)
from mbla.results.record.quantity import Quantity, flag, real, text, whole
from mbla.results.record.scene import FIGURES, FIGURES_TOLD, Column, Scene, Values, as_text, column
from mbla.results.results import CaseResult
from mbla.solution.solution import Checks, Mechanics

BOTH = "table json"


def _column(quantity: Quantity | str, of: Callable[[CaseResult], Any], files: str = BOTH) -> Column:
    """From a load case: a number, text or truth, one for each component; None: there is none."""
    return _of_scene(quantity, lambda scene: None if scene.case is None else of(scene.case), files)


def _of_scene(
    quantity: Quantity | str, of: Callable[[Scene], Any], files: str = BOTH, names: tuple[str, ...] = ()
) -> Column:
    def values(scene: Scene) -> Values | None:
        value = of(scene)
        return as_text([value]) if isinstance(value, str) else None if value is None else np.array([value])

    return column(_placed(quantity), values, files, (lambda _: names) if names else None)


def _placed(quantity: Quantity | str) -> Quantity | str:
    return quantity if isinstance(quantity, str) or quantity.place else replace(quantity, place="cases/*")


def _texts(name: str, words: str, of: Callable[[CaseResult], tuple[str, ...]]) -> Column:
    """Several sentences."""
    return column(
        _placed(text(name, words, "sentence")),
        lambda scene: None if scene.case is None else as_text(of(scene.case)),
        BOTH,
    )


def _check(name: str) -> Column:
    assert name in Checks.__dataclass_fields__
    return _column(f"cases/*/{name}", lambda case: getattr(case.checks, name))


def _factor(mechanics: Mechanics | None) -> float | None:
    return None if mechanics is None else mechanics.load_factor


def _reaction(case: CaseResult, turns: bool) -> float | None:
    settlement, found = case.load_case.settlement, result_of(case)
    if settlement is None or found is None or settlement.turns != turns:
        return None
    return settlement.reaction(found.load_factor)


def _unique(scene: Scene) -> bool | None:
    return None if scene.case is None else factor_unique(scene.model, scene.case)


def _extent(end: int) -> Callable[[Scene], float | None]:
    return lambda scene: None if scene.case is None else least_and_greatest(scene.model, scene.case)[end]


def _bounds_of_angle(case: CaseResult) -> tuple[float, float] | None:
    return None if case.load_case.tilt is None else angle_bounds(case)


def _standing(case: CaseResult) -> str | None:
    standing = case.solution.standing
    return None if standing is None else standing.verdict.value


def _modes(mode: InterfaceMode) -> Column:
    name = mode.name.lower()
    quantity = whole(f"{name}_interfaces", f"interfaces of mode {name}")
    return _of_scene(quantity, lambda s: None if s.interfaces is None else s.interfaces.count(mode), "table")


def _in_mechanism(quantity: Quantity, of: Callable[[Scene], Any]) -> Column:
    return _of_scene(replace(quantity, place="cases/*/mechanism"), of, "table")


CASE_COLUMNS: tuple[Column, ...] = (
    _column("cases/*/status", lambda case: case.status.value),
    _column("cases/*/reason", lambda case: case.solution.reason),
    _texts("remarks", "what a reader of the figure must know", lambda case: case.solution.remarks),
    _column("cases/*/flow_rule", lambda case: case.solution.flow_rule),
    _column("cases/*/scheme", lambda case: case.solution.scheme),
    _column("cases/*/contact_model", lambda case: case.solution.contact_model),
    _column(text("standing", "whether it stands under its dead load alone; empty: not assessed"), _standing, "table"),
    _column("cases/*/load_factor", lambda case: _factor(result_of(case))),
    _of_scene("cases/*/least_load_factor", _extent(0)),
    _of_scene("cases/*/greatest_load_factor", _extent(1)),
    _of_scene(flag("factor_unique", "whether the load factor is the only one, if known"), _unique, BOTH, ("no", "yes")),
    _column(
        real("associative_load_factor", "load factor by associative flow"), lambda case: _factor(associative_of(case))
    ),
    _column(
        real("best_iterate_load_factor", "where the case has no result: the best that was reached, which is none"),
        lambda case: _factor(best_iterate(case)),
        "table",
    ),
    *(_check(name) for name in ("static_bound", "kinematic_bound", "gap")),
    _column("cases/*/range", range_of),
    _check("peak_load_factor"),
    _column("cases/*/spread", lambda case: case.solution.spread),
    _column("cases/*/tolerance_requested", lambda case: case.solution.tolerance_requested),
    _column(real("angle", "tilting table: angle of collapse", "degree"), angle_of),
    _column(
        real("angle_bounds", "tilting table: angle certainly borne, angle certainly not", "degree", "end"),
        _bounds_of_angle,
    ),
    _column(
        real("reaction_force", "settlement: reaction of the support, positive against its motion", "force"),
        lambda case: _reaction(case, turns=False),
        "table",
    ),
    _column(
        real("reaction_moment", "the same of a support that turns", "moment"),
        lambda case: _reaction(case, turns=True),
        "table",
    ),
    _check("verified"),
    _texts("failures", "what is not within tolerance, in words", lambda case: case.checks.failures),
    *(
        _check(name)
        for name in (
            "equilibrium_residual",
            "yield_violation",
            "tension_violation",
            "penetration",
            "complementarity_residual",
            "slip_residual",
            "live_power",
            "power_balance",
        )
    ),
    column(
        replace(FIGURES_TOLD, place="cases/*"),
        lambda scene: np.array([FIGURES.index(scene.figures)]),
        "table",
        lambda _: FIGURES,
    ),
    _in_mechanism(
        real("moving_weight_share", "share of the weight of the free blocks that moves"),
        lambda scene: None if scene.collapse is None else moving_share(scene.model, scene.collapse.parts),
    ),
    _in_mechanism(
        whole("moving_blocks", "free blocks that move"),
        lambda scene: None if scene.collapse is None else moving_blocks(scene.model, scene.collapse.parts),
    ),
    _in_mechanism(
        whole("moving_parts", "rigid parts that move"),
        lambda scene: None if scene.collapse is None else len(scene.collapse.motions),
    ),
    *(_modes(mode) for mode in InterfaceMode),
    _column(whole("programs", "programs solved"), lambda case: len(case.solution.programs)),
    _column(whole("iterations", "their iterations"), lambda case: sum(p.iterations for p in case.solution.programs)),
    _column("cases/*/seconds", lambda case: case.solution.seconds, "table"),
    _column(
        real("solver_seconds", "time of the programs in it", "time"),
        lambda case: float(sum(program.seconds for program in case.solution.programs)),
        "table",
    ),
)
