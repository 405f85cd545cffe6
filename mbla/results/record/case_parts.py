"""What a load case has in the JSON record: reaction, standing, solver, reductions, assessment, supports."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.reductions import ProgramSize, ReductionStep
from mbla.results.assessment import Assessment
from mbla.results.outcome import RESIDUALS, answer_bounds, answer_of, distinct
from mbla.results.quantities import further, solving
from mbla.results.quantities.group import Field
from mbla.results.quantities.registry import COLUMN, STORED_BY_PATH
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety

REACTION = Object[Scene](owner=lambda scene: scene if scene.solved.load_case.question.group == "reaction" else None)
BEST = Object[Scene](
    replace(COLUMN["best_iterate_load_factor"], name="load_factor", words="its load factor, which is not a result"),
    owner=lambda scene: None if scene.best is None else scene,
)
STANDING = Object[Scene](
    STORED_BY_PATH["cases/*/standing/verdict"],
    owner=lambda scene: None if scene.solved.solution.standing is None else scene,
)
SOLVER = Object[Scene](
    replace(STORED_BY_PATH["cases/*/solver"], name="asked", words="as in analysis.solver", open=True)
)
TIME = Object[Scene](
    replace(COLUMN["seconds"], name="total", open=True), replace(COLUMN["solver_seconds"], name="solver", open=True)
)
REDUCTION, PROGRAM_SIZE = Object[ReductionStep](*solving.REDUCTIONS.quantities), Object[ProgramSize]()
GEOMETRIC_SAFETY = Object[GeometricSafety](owner=further.GEOMETRIC_SAFETY.owner)
ASSESSMENT = Object[Assessment](owner=lambda scene: scene.solved.assessment)
REACTIONS, WRENCH = Object["Reactions"](), Object[FloatArray]()


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


BEST.key("as in `residuals`", name="residuals", words="as `residuals`")(residuals_of)


@STANDING.key()
def block(scene: Scene) -> str | None:
    """The block that falls or would fall first."""
    found = scene.solved.solution.standing
    return None if found is None or found.block is None else scene.model.blocks.name(found.block)


STANDING.quantities.append(STORED_BY_PATH["cases/*/standing/reason"])


@SOLVER.key("a solver")
def used(scene: Scene) -> list[str]:
    """Solvers that took programs."""
    return distinct(program.solver for program in scene.solved.solution.programs)


@SOLVER.key("a library")
def factorization(scene: Scene) -> list[str]:
    """Libraries that factorised their linear systems."""
    return distinct(program.factorization for program in scene.solved.solution.programs)


PROGRAM_SIZE.fields(ProgramSize, **{name: Field(words) for name, words in solving.SIZES.items()})
REDUCTION.fields(
    ReductionStep,
    before=Field("programs with live load before it", inside=PROGRAM_SIZE),
    after=Field("programs with live load after it", inside=PROGRAM_SIZE),
)
GEOMETRIC_SAFETY.fields(
    GeometricSafety,
    factor=Field("the factor that forces show: the size of the joints over the least one"),
    most=Field("a factor that a mechanism shows not to be reached; null where none is known", rule="open"),
)
GEOMETRIC_SAFETY.quantities += [STORED_BY_PATH[f"cases/*/geometric_safety/{name}"] for name in ("solves", "verified")]
ASSESSMENT.fields(
    Assessment,
    code=Field("in words"),
    figures=Field("every figure on the way", items=("one of them",), inside=further.ASSESSMENT),
    remarks=Field("what stands against them", items=("in words",)),
)


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


@WRENCH.key(dims="vector", unit="force")
def force(wrench: FloatArray) -> FloatArray:
    """Resultant force."""
    return wrench[:3] + 0.0  # no -0.0


@WRENCH.key(dims="vector", unit="moment")
def moment(wrench: FloatArray) -> FloatArray:
    """Its moment about the origin."""
    return wrench[3:] + 0.0
