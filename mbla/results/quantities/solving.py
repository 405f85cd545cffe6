"""How a load case was solved: programs, iterations, paths of elastic joints, what reached the solver."""

from __future__ import annotations

from mbla.program.reductions import ProgramSize, ReductionStep
from mbla.results.quantities.group import Field, Group, count
from mbla.solution.solution import IterationRecord, ModelSize, PathByStiffness, PathPoint, ProgramRecord, Solution

SOLUTION = Group[Solution](lambda scene: scene.solved.solution, file="cases/*", table="cases", part="solution")
SHOWN = Group[Solution](lambda scene: scene.solved.solution, table="cases")
SIZE = Group[ModelSize](lambda scene: scene.solved.solution.size, file="cases/*/size", part="size", unverified="course")
REDUCTIONS = Group[tuple[ReductionStep, ...]](
    lambda scene: scene.solved.solution.reductions or None,
    file="cases/*/reductions",
    rows="reduction",
    part="reductions",
    unverified="course",
)
PATH = Group[tuple[PathPoint, ...]](
    lambda scene: scene.solved.solution.path,
    file="cases/*/path",
    files="table",
    table="path",
    rows="path_row",
    part="solution",
    unverified="course",
)
PATH_BY_STIFFNESS = Group[tuple[PathByStiffness, ...]](
    lambda scene: scene.solved.solution.path_by_stiffness,
    file="cases/*/path_by_stiffness",
    rows="stiffness_row",
    part="solution",
    unverified="course",
)
PROGRAMS = Group[tuple[ProgramRecord, ...]](
    lambda scene: scene.solved.solution.programs,
    file="cases/*/programs",
    files="table",
    table="programs",
    rows="program_row",
    part="solution",
    unverified="course",
)
ITERATIONS = Group[tuple[IterationRecord, ...]](
    lambda scene: scene.solved.solution.iterations,
    file="cases/*/iterations",
    files="table",
    table="iterations",
    rows="iteration_row",
    part="solution",
    unverified="course",
)

SIZES = {
    "unknowns": "velocities in the programs with live load",
    "cones": "friction cones in these, one a contact point",
    "entries": "entries of their equilibrium matrices, other than zero",
    "largest": "unknowns of the largest of them",
}
"""of the programs before or after a reduction"""

SIZE.fields(
    ModelSize,
    dimension=Field("2 where it was solved as planar, else 3"),
    mirror_planes=Field("planes of symmetry that were used besides"),
    parts=Field("parts that cannot interact, solved apart"),
    free_blocks=Field("blocks with unknowns"),
    contact_points=Field("contact points with unknowns"),
    dropped_points=Field("contact points that cannot matter, or follow from others by symmetry"),
)
REDUCTIONS.fields(
    ReductionStep,
    name=Field("planar, mirror, parts, unloaded, points, or glued"),
    state=Field("applied, nothing found, switched off, would change the answer"),
    found=Field("contact points or blocks left out, or parts taken apart or reduced"),
)


def _declare_sizes(when: str) -> None:
    """Sizes of the programs before or after each reduction."""
    group = Group[list[ProgramSize]](
        lambda scene: [getattr(step, when) for step in scene.solved.solution.reductions] or None,
        file="cases/*/reductions",
        rows="reduction",
        part="reductions",
        unverified="course",
    )
    fields = {f"{name}_{when}": Field(f"{words}, {when} it", attribute=name) for name, words in SIZES.items()}
    group.fields(ProgramSize, **fields)


_declare_sizes("before")
_declare_sizes("after")

PATH.fields(
    PathPoint,
    step=Field("step of the path of elastic joints"),
    displacement=Field("along the live load, over the elastic one of the structure at its associative load factor"),
    load_factor=Field("load factor there", rule="open"),
    open=Field("contact points open"),
    slide=Field("others at their friction"),
    balanced=Field("1 where forces and loads are in balance"),
)
PATH_BY_STIFFNESS.fields(
    PathByStiffness,
    ratio=Field("of another path that was followed: shear over normal stiffness of its joints"),
    load_factor=Field("the greatest load factor on it, nan: not seen", rule="open"),
)
PROGRAMS.fields(
    ProgramRecord,
    program=Field("number of the program, from 1"),
    kind=Field("what it is for"),
    status=Field("its status"),
    load_factor=Field("its load factor", rule="open"),
    change=Field("relative change of the load factor", rule="open"),
    iterations=Field("its iterations"),
    seconds=Field("its time", unit="time", rule="open"),
    solver=Field("mbla or clarabel; empty: steps of the joint law"),
    factorization=Field("library that factorised its linear systems; empty: none"),
)
ITERATIONS.fields(
    IterationRecord,
    program=Field("number of the program"),
    iteration=Field("iteration within it"),
    load_factor=Field("load factor at this iteration", rule="open"),
    gap=Field("relative gap of the program", rule="open"),
    primal_residual=Field("primal residual of the program", rule="open"),
    dual_residual=Field("dual residual of the program", rule="open"),
    step=Field("length of the step taken", rule="open"),
    seconds=Field("time since the program began", unit="time", rule="open"),
)


SHOWN.fields(Solution, programs=Field("programs solved", by=count, files="table json"))


@SHOWN.quantity("table json")
def iterations(solution: Solution) -> int:
    """Their iterations."""
    return sum(program.iterations for program in solution.programs)


SOLUTION.fields(
    Solution,
    seconds=Field("time of the solver stage", unit="time", unverified="times", files="table"),
    solver=Field("solver asked for, as analysis.solver"),
)


@SHOWN.quantity("table", unit="time")
def solver_seconds(solution: Solution) -> float:
    """Time of the programs in it."""
    return float(sum(program.seconds for program in solution.programs))
