"""What a load case has in the JSON record: reaction, standing, solver, reductions, assessment, ties, supports."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.reductions import ProgramSize, ReductionStep
from mbla.results.assessment import Assessment
from mbla.results.assessment import Figure as AssessmentFigure
from mbla.results.collapse.ties import TieRow
from mbla.results.listing.sections.figures import distinct
from mbla.results.outcome import RESIDUALS, answer_bounds, answer_of
from mbla.results.quantities import further, solving, steps, ties
from mbla.results.quantities.registry import STORED_BY_PATH
from mbla.results.record.objects import Item, Object
from mbla.results.record.scene import Scene
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.pushover.curve_rows import CurveRow
from mbla.solution.solution import PathByStiffness, PathPoint

REACTION, BEST, STANDING, SOLVER, SIZE = (
    Object[Scene](),
    Object[Scene](),
    Object[Scene](),
    Object[Scene](),
    Object[Scene](),
)
REDUCTION, PROGRAM_SIZE = Object[ReductionStep](), Object[ProgramSize]()
PATH, OTHER_PATH = Object[PathPoint](), Object[PathByStiffness]()
CURVE, SENSITIVITY = Object[CurveRow](), Object[Slope]()
GEOMETRIC_SAFETY, ASSESSMENT, FIGURE = Object[Scene](), Object[Assessment](), Object[AssessmentFigure]()
TIE, REACTIONS, TIME = Object[TieRow](), Object["Reactions"](), Object[Scene]()
WRENCH = Object[FloatArray]()


def residuals_of(scene: Scene) -> dict[str, float | None]:
    """Of forces and mechanism, in one object."""
    checks = scene.solved.checks
    return {each.split("_")[0]: getattr(checks, each) for each in RESIDUALS if each != "power_balance"}


@REACTION.key(name="value", unit="load")
def reaction_value(scene: Scene) -> float | None:
    """As the structure follows it, positive against the motion."""
    return answer_of(scene.solved)


@REACTION.key(unit="load")
def lower_bound(scene: Scene) -> float | None:
    """Verified lower bound by associative flow."""
    return answer_bounds(scene.solved)[0]


@REACTION.key(unit="load")
def upper_bound(scene: Scene) -> float | None:
    """Verified upper bound by associative flow."""
    return answer_bounds(scene.solved)[1]


@REACTION.key(unit="load")
def at_rest(scene: Scene) -> float | None:
    """Of the support that has not moved yet."""
    return scene.solved.load_case.question.value(0.0)


@REACTION.key(name="unit", unit="load")
def reaction_unit(scene: Scene) -> float | None:
    """What load factor 1 takes from it."""
    return scene.solved.load_case.question.scale


@REACTION.key()
def kind(scene: Scene) -> str:
    """Force or moment."""
    return scene.solved.load_case.question.kind


@BEST.key()
def load_factor(scene: Scene) -> float | None:
    """Its load factor, which is not a result."""
    return None if scene.best is None else scene.best.load_factor


@BEST.key("as in `residuals`", name="residuals")
def residuals_of_best(scene: Scene) -> dict[str, float | None]:
    """As `residuals`."""
    return residuals_of(scene)


STANDING.quantities(STORED_BY_PATH["cases/*/standing/verdict"])


@STANDING.key()
def block(scene: Scene) -> str | None:
    """The block that falls or would fall first."""
    found = scene.solved.solution.standing
    return None if found is None or found.block is None else scene.model.blocks.name(found.block)


STANDING.quantities(STORED_BY_PATH["cases/*/standing/reason"], null=("reason",))


@SOLVER.key()
def asked(scene: Scene) -> str | None:
    """As in analysis.solver."""
    return scene.solved.solution.solver or None


@SOLVER.key("a solver")
def used(scene: Scene) -> list[str]:
    """Solvers that took programs."""
    return distinct(program.solver for program in scene.solved.solution.programs)


@SOLVER.key("a library")
def factorization(scene: Scene) -> list[str]:
    """Libraries that factorised their linear systems."""
    return distinct(program.factorization for program in scene.solved.solution.programs)


SIZE.quantities(*solving.SIZE.quantities)
REDUCTION.quantities(*solving.REDUCTIONS.quantities)


@REDUCTION.key(inside=PROGRAM_SIZE)
def before(step: ReductionStep) -> ProgramSize:
    """Programs with live load before it."""
    return step.before


@REDUCTION.key(inside=PROGRAM_SIZE)
def after(step: ReductionStep) -> ProgramSize:
    """Programs with live load after it."""
    return step.after


PROGRAM_SIZE.fields(ProgramSize, **{name: Item(words) for name, words in solving.SIZES.items()})
PATH.quantities(*solving.PATH.quantities)
OTHER_PATH.quantities(*solving.PATH_BY_STIFFNESS.quantities)
CURVE.quantities(*steps.CURVE.quantities)
SENSITIVITY.quantities(*further.SENSITIVITY.quantities)


def _safety(scene: Scene) -> GeometricSafety:
    found = scene.solved.solution.further.geometric_safety
    assert found is not None  # what makes it an object
    return found


@GEOMETRIC_SAFETY.key()
def factor(scene: Scene) -> float:
    """The factor that forces show: the size of the joints over the least one."""
    return _safety(scene).factor


@GEOMETRIC_SAFETY.key()
def most(scene: Scene) -> float | None:
    """A factor that a mechanism shows not to be reached; null where none is known."""
    return _safety(scene).most


GEOMETRIC_SAFETY.quantities(
    STORED_BY_PATH["cases/*/geometric_safety/solves"], STORED_BY_PATH["cases/*/geometric_safety/verified"]
)


@ASSESSMENT.key()
def code(assessment: Assessment) -> str:
    """In words."""
    return assessment.code


@ASSESSMENT.key("one of them", inside=FIGURE)
def figures(assessment: Assessment) -> list[AssessmentFigure]:
    """Every figure on the way."""
    return list(assessment.figures)


@ASSESSMENT.key("in words")
def remarks(assessment: Assessment) -> list[str]:
    """What stands against them."""
    return list(assessment.remarks)


FIGURE.quantities(*further.ASSESSMENT.quantities)


@TIME.key(unit="time")
def total(scene: Scene) -> float | None:
    """Time of the solver stage."""
    return scene.solved.solution.seconds


@TIME.key(name="solver", unit="time")
def time_of_programs(scene: Scene) -> float | None:
    """Time of the programs in it."""
    return float(sum(program.seconds for program in scene.solved.solution.programs))


TIE.quantities(*ties.TIES.quantities)


@dataclass(frozen=True)
class Reactions:
    """Force and moment about the origin of each support on the structure, (6,), by its name; guides are among them."""

    by_support: dict[str, FloatArray]


@REACTIONS.key(name="total", inside=WRENCH)
def total_reaction(reactions: Reactions) -> FloatArray:
    """All of them together: unique, as it balances the loads."""
    return sum(reactions.by_support.values(), np.zeros(6))


@REACTIONS.key("of a ground plane, `GROUP (fixed blocks)` or `guides of GROUP`", inside=WRENCH)
def supports(reactions: Reactions) -> dict[str, FloatArray]:
    """One by one, which need not be unique."""
    return reactions.by_support


@WRENCH.key("a component", unit="force")
def force(wrench: FloatArray) -> FloatArray:
    """Resultant force."""
    return wrench[:3] + 0.0  # no -0.0


@WRENCH.key("a component", unit="moment")
def moment(wrench: FloatArray) -> FloatArray:
    """Its moment about the origin."""
    return wrench[3:] + 0.0
