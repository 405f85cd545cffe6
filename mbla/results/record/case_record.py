"""A load case as an object of the JSON record; the load factor and the mechanism only where they are results."""

from __future__ import annotations

from mbla.model.model import Model
from mbla.program.reductions import ReductionStep
from mbla.results.collapse.mechanics import reactions_of
from mbla.results.collapse.ties import TieRow, tie_rows
from mbla.results.outcome import associative_of, result_of
from mbla.results.quantities import further, solving, steps
from mbla.results.quantities import ties as quantities_of_ties
from mbla.results.quantities.group import Field
from mbla.results.quantities.registry import CASE_COLUMNS
from mbla.results.record.case_parts import (
    ASSESSMENT,
    BEST,
    GEOMETRIC_SAFETY,
    REACTION,
    REACTIONS,
    REDUCTION,
    SOLVER,
    STANDING,
    TIME,
    Reactions,
    residuals_of,
)
from mbla.results.record.earth_pressure import EARTH_PRESSURE, EarthPressure, earth_pressures
from mbla.results.record.history_record import TIME_HISTORY
from mbla.results.record.mechanism_json import MECHANISM
from mbla.results.record.modes_record import MODES, MODES_AFTER
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene
from mbla.results.record.unit_stress import UNIT_STRESS
from mbla.results.results import CaseResult
from mbla.solution.pushover.pushover import Pushover
from mbla.solution.verification.statics import power

CASE = Object[Scene]()
_PUSHOVER = CASE.of(lambda scene: scene.solved.solution.further.pushover)


@CASE.key()
def name(scene: Scene) -> str:
    """Load case."""
    return scene.solved.load_case.name


CASE.quantities += [quantity for quantity in CASE_COLUMNS if "json" in quantity.files]
CASE.holds(
    "reaction", REACTION, "settlement: reaction of the support; forces, or moments where it turns; objective: the force"
)
CASE.holds("best_iterate", BEST, "the best iterate where the case has no result")


@CASE.key("factors acting together, each times this, add up to kinematic_bound at most")
def powers(scene: Scene) -> dict[str, float | None] | None:
    """Powers of live loads in the associative mechanism, by load case; 1 of its own."""
    return powers_of(scene.model, scene.solved)


CASE.key(
    "equilibrium, yield, tension, penetration, complementarity, slip",
    name="residuals",
    words="the first six of these once more",
)(residuals_of)
CASE.holds("standing", STANDING, "assessment of the dead load alone")


@CASE.key()
def certificate(scene: Scene) -> str | None:
    """What proves that there is no load factor: motion or forces."""
    solution = scene.solved.solution
    if solution.certificate is not None:
        return "motion"
    return "forces" if solution.lock is not None and solution.mechanics is None else None


CASE.holds("solver", SOLVER, "solvers of the programs")
CASE.holds("size", solving.SIZE, "what reached the solver")


@CASE.key("a reduction", inside=REDUCTION)
def reductions(scene: Scene) -> list[ReductionStep]:
    """What each reduction left out, in the order in which they are applied."""
    return list(scene.solved.solution.reductions)


CASE.holds("path", solving.PATH, "steps of the path of elastic joints that was followed", "a step")
CASE.holds(
    "path_by_stiffness",
    solving.PATH_BY_STIFFNESS,
    "other paths that were followed, of joints of another stiffness in shear: two with accuracy: reference, one where "
    "the stiffness may decide",
    "a path",
)
CASE.holds("curve", steps.CURVE, "steps of the pushover", "a step")


@CASE.key("across, then along", unit="bedding")
def curve_stiffness(scene: Scene) -> list[float] | None:
    """How stiff its joints are; null without one."""
    rows = scene.solved.solution.further.pushover.rows
    return None if rows is None else list(rows.stiffness)


_PUSHOVER.fields(
    Pushover,
    curve_end=Field("why it ends; empty without one"),
    curve_end_error=Field("change of the displacement there with steps of twice the size", unit="length", rule="open"),
    curve_last_error=Field("change of the load factor there with steps of twice the size", rule="open"),
)
CASE.holds("time_history", TIME_HISTORY, "the structure in time; null where the deck does not ask")
CASE.holds(
    "sensitivity",
    further.SENSITIVITY,
    "how the associative load factor changes with parameters; empty where the deck does not ask",
    "a parameter",
)
CASE.holds(
    "geometric_safety",
    GEOMETRIC_SAFETY,
    "by how much the joints may shrink about their middles before the dead load falls; null where the deck does not "
    "ask",
)
CASE.holds("modes", MODES, "modes of vibration about the state at rest; null where not asked for, or there are none")
CASE.holds(
    "modes_after",
    MODES_AFTER,
    "the same about the state that a time history leaves: with them periods are longer where joints have opened or "
    "stones have slid; null where not asked for, or there are none",
)
CASE.holds(
    "soil_range",
    further.SOIL_RANGE,
    "load factors of soil that slides without dilatancy and with that of its friction angle; empty where not asked",
    "a path",
)
CASE.holds("assessment", ASSESSMENT, "what a code says")


CASE.holds("time", TIME, "what it took")
CASE.holds("mechanism", MECHANISM, "how it fails; null where the case has no result")
CASE.holds("unit_stress", UNIT_STRESS, "what its forces ask of the units; null where the case has no result")


@CASE.key("a tie", inside=quantities_of_ties.TIES)
def ties(scene: Scene) -> list[TieRow]:
    """Ties and what they do at collapse."""
    return list(tie_rows(scene.model, result_of(scene.solved)))


@CASE.key(inside=REACTIONS)
def reactions(scene: Scene) -> Reactions | None:
    """What the supports exert on the structure at collapse; null without a result."""
    found, case = result_of(scene.solved), scene.solved
    if found is None:
        return None
    rows = reactions_of(scene.model, scene.contacts, case.load_case, found, by_group=True)
    return Reactions({row.support: row.wrench for row in rows})


@CASE.key("a soil, or the water in it, on the blocks of a group", inside=EARTH_PRESSURE)
def earth_pressure(scene: Scene) -> list[EarthPressure]:
    """What soil of cells presses with, with the forces of the result and at rest."""
    return earth_pressures(scene)


def powers_of(model: Model, case: CaseResult) -> dict[str, float | None] | None:
    """Power of the live load of every load case in the mechanism behind a kinematic bound, by name.

    A mechanism u that the joints allow with associative flow bounds every live load at once. With the dead load G, the
    dissipation D and live loads L_c of the same structure, no factors x_c acting together are carried unless

        Σ x_c L_c·u ≤ D(u) − G·u.

    u is scaled so that the live load of its own case has unit power; the right side then is its kinematic bound k, and
    Σ x_c p_c ≤ k a half-space that contains the safe domain. Positions of travelling loads and settlements have none;
    None where there is no such mechanism.
    """
    associative = associative_of(case)
    if associative is None or not case.load_case.question.multiplies:
        return None
    own = power(case.load_case.live_load, associative.mechanism)
    if not own > 0.0:
        return None
    others = [one for one in model.load_cases if one.question.name == "load_factor"]
    return {one.name: power(one.live_load, associative.mechanism) / own for one in others}
