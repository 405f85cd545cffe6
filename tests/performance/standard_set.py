"""The standard set: the structures on which time and accuracy are measured, the same for every benchmark.

Walls in running bond from 5 × 5 to 100 × 100 units, planar and with all six unknowns a block, arches of 20 to 500
voussoirs, a dome, a cross vault and a house; each with associative flow and without dilatancy.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

DECKS = Path(__file__).parents[2] / "decks"
WALLS = (5, 10, 20, 40, 60, 100)
ARCHES = (20, 50, 100, 200, 500)
SPATIAL = ("analysis.reductions=false",)
FLOW_RULES = ("associative", "non_associative")


@dataclass(frozen=True)
class Structure:
    """One structure of the set under one load case.

    name      : in tables
    family    : structures of one kind and growing size
    deck      : path
    overrides : key paths with values, as of ``--set``
    load_case : the one that is solved
    """

    name: str
    family: str
    deck: Path
    overrides: tuple[str, ...]
    load_case: str


def _wall(courses: int, units: int, *, spatial: bool) -> Structure:
    family = "wall, spatial" if spatial else "wall, planar"
    overrides = (f"parameters.m={units}", f"parameters.n={courses}", *(SPATIAL if spatial else ()))
    return Structure(f"{family}, {courses} x {units}", family, DECKS / "tradeoff" / "wall.yaml", overrides, "in_plane")


def _arch(n: int) -> Structure:
    return Structure(f"arch, {n} voussoirs", "arch", DECKS / "tradeoff" / "arch.yaml", (f"parameters.n={n}",), "push_x")


STANDARD_SET = (
    *(_wall(n, n, spatial=False) for n in WALLS),
    *(_wall(n, n, spatial=True) for n in WALLS),
    _wall(40, 25, spatial=True),
    *(_arch(n) for n in ARCHES),
    Structure("dome", "dome", DECKS / "tutorials" / "dome.yaml", (), "push_x"),
    Structure("cross vault", "cross vault", DECKS / "tutorials" / "crossvault.yaml", (), "along_x"),
    Structure("house", "house", DECKS / "structures" / "house.yaml", (), "push_x"),
)
"""By family and size; the flow rule is set by who measures, ``analysis.flow_rule`` of :data:`FLOW_RULES`."""
