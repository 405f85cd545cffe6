"""A load case as an object of the JSON record; the load factor and the mechanism only where they are results."""

from __future__ import annotations

from mbla.model.model import Model
from mbla.program.reductions import ReductionStep
from mbla.results.assessment import Assessment
from mbla.results.collapse.mechanics import reactions_of
from mbla.results.collapse.ties import TieRow, tie_rows
from mbla.results.outcome import associative_of, dimension_of, result_of
from mbla.results.quantities.registry import CASE_COLUMNS
from mbla.results.record.case_parts import (
    ASSESSMENT,
    BEST,
    CURVE,
    GEOMETRIC_SAFETY,
    OTHER_PATH,
    PATH,
    REACTION,
    REACTIONS,
    REDUCTION,
    SENSITIVITY,
    SIZE,
    SOLVER,
    STANDING,
    TIE,
    TIME,
    Reactions,
    residuals_of,
)
from mbla.results.record.mechanism_json import MECHANISM, Mechanism
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene
from mbla.results.results import CaseResult
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.pushover.curve_rows import CurveRow
from mbla.solution.solution import PathByStiffness, PathPoint
from mbla.solution.verification.statics import power

CASE = Object[Scene]()


@CASE.key()
def name(scene: Scene) -> str:
    """Load case."""
    return scene.solved.load_case.name


CASE.columns(quantity for quantity in CASE_COLUMNS if "json" in quantity.files)


@CASE.key(inside=REACTION)
def reaction(scene: Scene) -> Scene | None:
    """Settlement: reaction of the support; forces, or moments where it turns; objective: the force."""
    return scene if scene.solved.load_case.question.group == "reaction" else None


@CASE.key(inside=BEST)
def best_iterate(scene: Scene) -> Scene | None:
    """The best iterate where the case has no result."""
    return None if scene.best is None else scene


@CASE.key("factors acting together, each times this, add up to kinematic_bound at most")
def powers(scene: Scene) -> dict[str, float | None] | None:
    """Powers of live loads in the associative mechanism, by load case; 1 of its own."""
    return powers_of(scene.model, scene.solved)


@CASE.key("equilibrium, yield, tension, penetration, complementarity, slip")
def residuals(scene: Scene) -> dict[str, float | None]:
    """The first six of these once more."""
    return residuals_of(scene)


@CASE.key(inside=STANDING)
def standing(scene: Scene) -> Scene | None:
    """Assessment of the dead load alone."""
    return None if scene.solved.solution.standing is None else scene


@CASE.key()
def certificate(scene: Scene) -> str | None:
    """What proves that there is no load factor: motion or forces."""
    solution = scene.solved.solution
    if solution.certificate is not None:
        return "motion"
    return "forces" if solution.lock is not None and solution.mechanics is None else None


@CASE.key(inside=SOLVER)
def solver(scene: Scene) -> Scene:
    """Solvers of the programs."""
    return scene


@CASE.key(inside=SIZE)
def size(scene: Scene) -> Scene | None:
    """What reached the solver."""
    return None if scene.solved.solution.size is None else scene


@CASE.key("a reduction", inside=REDUCTION)
def reductions(scene: Scene) -> list[ReductionStep]:
    """What each reduction left out, in the order in which they are applied."""
    return list(scene.solved.solution.reductions)


@CASE.key("a step", inside=PATH)
def path(scene: Scene) -> list[PathPoint]:
    """Steps of the path of elastic joints that was followed."""
    return list(scene.solved.solution.path)


@CASE.key("a path", inside=OTHER_PATH)
def path_by_stiffness(scene: Scene) -> list[PathByStiffness]:
    """Other paths that were followed, of joints of another stiffness in shear: two with accuracy: reference, one where
    the stiffness may decide.
    """
    return list(scene.solved.solution.path_by_stiffness)


@CASE.key("a step", inside=CURVE)
def curve(scene: Scene) -> list[CurveRow]:
    """Steps of the pushover."""
    return list(scene.solved.solution.further.pushover.curve)


@CASE.key("across, then along", unit="bedding")
def curve_stiffness(scene: Scene) -> list[float] | None:
    """How stiff its joints are; null without one."""
    rows = scene.solved.solution.further.pushover.rows
    return None if rows is None else list(rows.stiffness)


@CASE.key()
def curve_end(scene: Scene) -> str:
    """Why it ends; empty without one."""
    return scene.solved.solution.further.pushover.curve_end


@CASE.key(unit="length")
def curve_end_error(scene: Scene) -> float | None:
    """Change of the displacement there with steps of twice the size."""
    return scene.solved.solution.further.pushover.curve_end_error


@CASE.key()
def curve_last_error(scene: Scene) -> float | None:
    """Change of the load factor there with steps of twice the size."""
    return scene.solved.solution.further.pushover.curve_last_error


@CASE.key("a parameter", inside=SENSITIVITY)
def sensitivity(scene: Scene) -> list[Slope]:
    """How the associative load factor changes with parameters; empty where the deck does not ask."""
    return list(scene.solved.solution.further.sensitivity)


@CASE.key(inside=GEOMETRIC_SAFETY)
def geometric_safety(scene: Scene) -> Scene | None:
    """By how much the joints may shrink about their middles before the dead load falls; null where the deck does not
    ask.
    """
    return None if scene.solved.solution.further.geometric_safety is None else scene


@CASE.key(inside=ASSESSMENT)
def assessment(scene: Scene) -> Assessment | None:
    """What a code says."""
    return scene.solved.assessment


@CASE.key(inside=TIME)
def time(scene: Scene) -> Scene:
    """What it took."""
    return scene


@CASE.key(inside=MECHANISM)
def mechanism(scene: Scene) -> Mechanism | None:
    """How it fails; null where the case has no result."""
    found, case = result_of(scene.solved), scene.solved
    return None if found is None else Mechanism(scene.assembly, case.load_case, found, dimension_of((case,)))


@CASE.key("a tie", inside=TIE)
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
