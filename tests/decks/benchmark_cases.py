"""What the table of formulations in decks/benchmarks/README.md compares: load cases, formulations, and which meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mbla.solution.solution import Solution


@dataclass(frozen=True)
class Formulation:
    """One way to the load factor.

    overrides : of the deck's ``analysis``
    shows     : whether a solution bears the mark of it, so that an option without effect cannot pass for a result
    """

    name: str
    overrides: tuple[str, ...]
    shows: Callable[[Solution], bool]


@dataclass(frozen=True)
class BenchmarkCase:
    """One load case of a deck.

    spatial      : solved in space although it is planar
    formulations : names of those that are compared on it
    overrides    : of the deck besides
    """

    name: str
    deck: str
    load_case: str
    formulations: tuple[str, ...]
    spatial: bool = False
    overrides: tuple[str, ...] = ()


def _used(*kinds: str) -> Callable[[Solution], bool]:
    """At least one program of these kinds was solved."""
    return lambda solution: any(program.kind in kinds for program in solution.programs)


def _by_rule(flow_rule: str, *kinds: str) -> Callable[[Solution], bool]:
    used = _used(*kinds)
    return lambda solution: solution.flow_rule == flow_rule and (not kinds or used(solution))


def _by_scheme(scheme: str) -> Callable[[Solution], bool]:
    return lambda solution: solution.scheme == scheme


def _polyhedral(solution: Solution) -> bool:
    """Two polyhedra in space; in a plane there is nothing to approximate."""
    return solution.outer is not None or (solution.size is not None and solution.size.dimension == 2)


def _resultants(solution: Solution) -> bool:
    return solution.mechanics is not None and solution.mechanics.resultants is not None


ASSOCIATIVE, NON_ASSOCIATIVE = "flow_rule=associative", "flow_rule=non_associative"
STEPS = ("exact step", "convex step")

FORMULATIONS = (
    Formulation("associative, kinematic form", (ASSOCIATIVE,), _by_rule("associative", "associative")),
    Formulation("associative, HiGHS", (ASSOCIATIVE, "solver=highs"), _by_rule("associative", "associative")),
    Formulation(
        "polyhedral, 8 sides",
        (ASSOCIATIVE, "friction_cone=polyhedral", "sides=8"),
        _by_rule("associative", "associative"),
    ),
    Formulation(
        "polyhedral, 32 sides",
        (ASSOCIATIVE, "friction_cone=polyhedral", "sides=32"),
        _by_rule("associative", "associative"),
    ),
    Formulation("convex, associative", (ASSOCIATIVE, "contact_model=convex"), _resultants),
    Formulation("livesley", ("flow_rule=livesley", "friction_cone=polyhedral"), _used("livesley")),
    Formulation("proximal", (NON_ASSOCIATIVE, "scheme=proximal"), _by_rule("non_associative", *STEPS)),
    Formulation("interior", (NON_ASSOCIATIVE, "scheme=interior"), _used("interior")),
    Formulation("auto", (NON_ASSOCIATIVE, "scheme=auto"), _by_rule("non_associative", *STEPS, "interior")),
    Formulation("path", (NON_ASSOCIATIVE, "scheme=path"), lambda solution: bool(solution.path)),
    Formulation("lowest", (NON_ASSOCIATIVE, "scheme=lowest", "lowest.seconds=10"), _by_scheme("lowest")),
    Formulation(
        "published, slope 0.01",
        (NON_ASSOCIATIVE, "scheme=published", "published.slope=0.01"),
        _used("published"),
    ),
    Formulation("dilatancy", ("flow_rule=dilatancy",), _by_rule("dilatancy")),
)

EXACT = ("associative, kinematic form", "polyhedral, 8 sides", "polyhedral, 32 sides")
PLANAR = (EXACT[0], "associative, HiGHS")
LOWER = ("proximal", "interior", "published, slope 0.01")
EVERY = tuple(each.name for each in FORMULATIONS if each.name not in ("dilatancy", "polyhedral, 32 sides"))
"""for planar walls, where friction polyhedra are two half-planes however many sides they have"""

FEW = ("associative, kinematic form", "convex, associative", "auto")

HALF_DILATANT = ("joints.dry.dilatancy=10",)
"""degrees; the friction angle of these walls is 33"""

CASES = (
    BenchmarkCase("block pushed at 30 degrees", "block_sliding", "push_30", (*EXACT, *FEW[1:])),
    BenchmarkCase("block rocking about a corner", "block_rocking", "corner", FEW),
    BenchmarkCase("block leaning on a rough wall", "leaning_block_rough_wall", "away", FEW),
    BenchmarkCase("block in a groove", "groove", "along", (*EXACT, "convex, associative", *LOWER, "auto")),
    BenchmarkCase("groove, half the friction angle as dilatancy", "groove_dilatancy", "along", ("dilatancy",)),
    BenchmarkCase("groove, friction beyond locking", "groove_steep_friction", "along", (EXACT[0], "interior", "auto")),
    BenchmarkCase("plank in a clamp", "plank_in_clamp", "pull", (EXACT[0], "proximal", "interior", "path", "auto")),
    BenchmarkCase("torque on a square joint", "torque", "couple", (*EXACT, "convex, associative")),
    BenchmarkCase("eccentric compression", "eccentric_compression", "eccentric", FEW),
    BenchmarkCase("Ferris and Tin-Loi, wall 1", "ferris_wall_1", "push_x", EVERY),
    BenchmarkCase("wall 1 in space", "ferris_wall_1", "push_x", ("associative, kinematic form", "auto"), spatial=True),
    BenchmarkCase("Ferris and Tin-Loi, wall 3", "ferris_wall_3", "push_x", EVERY),
    BenchmarkCase("wall 3 in space", "ferris_wall_3", "push_x", (*EXACT, *LOWER, "auto"), spatial=True),
    BenchmarkCase("wall 3, dilatancy 10 degrees", "ferris_wall_3", "push_x", ("dilatancy",), overrides=HALF_DILATANT),
    BenchmarkCase("Ferris and Tin-Loi, wall 5", "ferris_wall_5", "push_x", EVERY),
    BenchmarkCase("wall 5 in space", "ferris_wall_5", "push_x", ("associative, kinematic form", "auto"), spatial=True),
    BenchmarkCase("Cocchetti and Rizzi, mu 0.35", "cocchetti_rizzi_mu_350_stands", "push_x", (EXACT[0], "auto")),
    BenchmarkCase("Oppenheim's arch", "oppenheim_arch", "push_x", (EXACT[0], "convex, associative", *LOWER, "auto")),
    BenchmarkCase("arch of 50 voussoirs", "arch_50_voussoirs", "push_x", (EXACT[0], "auto")),
    BenchmarkCase("arch of 50 voussoirs in space", "arch_50_voussoirs", "push_x", FEW, spatial=True),
    BenchmarkCase("dome of 24 voussoirs", "dome_24_voussoirs", "push_x", (*EXACT[:2], *FEW[1:])),
    BenchmarkCase("wall of 10 x 10", "wall_10x10", "in_plane", (*PLANAR, "proximal", "interior", "path", "auto")),
    BenchmarkCase("wall of 10 x 10 in space", "wall_10x10", "in_plane", (*EXACT, "auto"), spatial=True),
    BenchmarkCase("wall of 10 x 10, out of plane", "wall_10x10", "out_of_plane", (*EXACT, *FEW[1:])),
    BenchmarkCase("wall of 20 x 20", "wall_20x20", "in_plane", (*PLANAR, "auto")),
    BenchmarkCase("wall of 20 x 20 in space", "wall_20x20", "in_plane", EXACT[:1], spatial=True),
)
"""cases of decks/benchmarks, the small ones first"""


def formulation(name: str) -> Formulation:
    """The formulation of that name."""
    return next(each for each in FORMULATIONS if each.name == name)


def overrides_of(case: BenchmarkCase, chosen: Formulation) -> tuple[str, ...]:
    """What ``--set`` would be given."""
    analysis = tuple(f"analysis.{override}" for override in chosen.overrides)
    return (*case.overrides, *analysis, *(("analysis.reductions=false",) if case.spatial else ()))
