"""A sweep made by hand: friction in a grid with a sample of thickness and a seed, one point of it left out."""

from typing import Any

from mbla.deck.units import Units
from mbla.sweeps.design.design import Design, DesignDimension, DesignPoint, SweepColumn
from mbla.sweeps.plan import DONE, FAILED, Plain, PointOutcome
from mbla.sweeps.results import result_columns
from mbla.sweeps.tables.sweep_json import sweep_json
from mbla.sweeps.tables.sweep_table import SweepTable, sweep_table

CREATED = "2026-11-21T10:00:00Z"
ABOUT: dict[str, Any] = {"sweep": "wall.sweep.yaml", "deck": "wall.yaml", "created": CREATED, "exit_code": 8}
RESULTS = ("status", "load_factor", "verified", "mechanism.hinges", "model.total_weight", "time.solve/standing")
FRICTION, THICKNESS = (0.5, 0.7), (0.1, 0.2, 1 / 3)
LEFT_OUT = (1, 2)


def design() -> Design:
    columns = (
        SweepColumn("mu", "", "friction", "float", "parameter", "mu"),
        SweepColumn("t", "m", "thickness", "float", "parameter", "sobol", random=True),
        SweepColumn("seed", "", "seed of the bond", "int", "parameter", "sobol"),
    )
    places = [(i, j) for i in range(2) for j in range(3) if (i, j) != LEFT_OUT]
    points = tuple(
        DesignPoint(number, (i, j), (FRICTION[i], THICKNESS[j], j + 4), {"parameters.mu": FRICTION[i]})
        for number, (i, j) in enumerate(places, 1)
    )
    levels: tuple[tuple[Plain, ...], ...] = (FRICTION, THICKNESS, (4, 5, 6))
    return Design(columns, (DesignDimension("mu", 2), DesignDimension("sobol", 3)), points, levels, 1, "sobol", "sobol")


def keys() -> list[str]:
    return [f"key{point.number}" for point in design().points]


def outcomes() -> dict[str, PointOutcome]:
    """Solved, without equilibrium, solved, failed; the fifth has what the fourth has not."""
    solved: dict[str, Plain] = {
        "status": "solved",
        "load_factor": 0.1 + 0.2,
        "verified": True,
        "mechanism.hinges": 4,
        "model.total_weight": 65.0,
        "time.solve/standing": 0.25,
    }
    none: dict[str, Plain] = dict.fromkeys(solved)
    found: list[tuple[str, int, str, dict[str, Plain]]] = [
        (DONE, 0, "", solved),
        (DONE, 5, 'a block, "the top", falls\nby itself', {**none, "status": "no_equilibrium", "verified": True}),
        (DONE, 0, "", {**solved, "load_factor": 1e-300, "mechanism.hinges": 0}),
        (FAILED, 4, "not verified", {**none, "status": "not_verified", "verified": False}),
        (DONE, 0, "", solved),
    ]
    return {
        key: PointOutcome(key, state, code, reason, results, 1, 0.25)
        for key, (state, code, reason, results) in zip(keys(), found, strict=True)
    }


def table(*without: str) -> SweepTable:
    """The table; points with these keys have not been solved yet."""
    columns = result_columns(RESULTS, ("push",), Units(force="kN"))
    known = {key: outcome for key, outcome in outcomes().items() if key not in without}
    return sweep_table("Wände", design(), columns, known, keys())


def record(**changes: Any) -> dict[str, Any]:
    """The record of the whole table."""
    return sweep_json(table(), **ABOUT, left_out=1, seconds=3.5) | changes
