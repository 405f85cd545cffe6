"""Load cases: status, load factors and bounds, residuals, what moves, what it took."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.deck.sections.assessment import LIMIT_STATES
from mbla.errors import Message
from mbla.results.history_figures import drift_of
from mbla.results.outcome import answer_bounds, answer_of, history_of, least_of, torsion_of
from mbla.results.outcome import ultimate_displacement as displacement_at_the_end
from mbla.results.quantities.answers import OWN
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.results.results import CaseResult
from mbla.solution.solution import Checks, Solution

CASES = Group[CaseResult](lambda scene: scene.solved, file="cases/*", table="cases", part="solution")
CLAIMED = Group[CaseResult](lambda scene: scene.solved, file="cases/*")
SHOWN = Group[CaseResult](lambda scene: scene.solved, table="cases")
SCENE = Group[Scene](lambda scene: scene, table="cases")
SOLUTION = Group[Solution](
    lambda scene: scene.solved.solution, file="cases/*", files="table json", table="cases", part="solution"
)
CHECKS = Group[Checks](
    lambda scene: scene.solved.checks, file="cases/*", files="table json", table="cases", part="solution"
)

CASES.fields(CaseResult, status=Field("status of the case after verification", rule="open", files="table json"))


@SOLUTION.quantity("", unverified="claimed")
def claimed_status(solution: Solution) -> str:
    """Status that the solver stage claimed, which figures can lower and not raise."""
    return solution.status.value


SOLUTION.fields(Solution, reason=Field("why it is not plainly solved, in words", rule="open", unverified="words"))


@SHOWN.quantity("table json", dims="sentence")
def remarks(case: CaseResult) -> Sequence[str]:
    """What a reader of the figure must know."""
    return case.solution.remarks


SOLUTION.fields(
    Solution,
    flow_rule=Field("flow rule of load_factor, contact_forces and mechanism", rule="open"),
    scheme=Field("how a flow without normality was solved; empty: associative", rule="open", unverified="course"),
    contact_model=Field("concave, or convex: interface resultants", rule="open"),
    stress_blocks=Field("1 where interfaces crush as fields of stress do", files=""),
)


@SHOWN.quantity("table")
def standing(case: CaseResult) -> str | None:
    """Whether it stands under its dead load alone; empty: not assessed."""
    found = case.solution.standing
    return None if found is None else found.verdict.value


@SCENE.quantity("table json", like=OWN["load_factor"])
def load_factor(scene: Scene) -> float | None:
    """Of the result."""
    return None if scene.result is None else scene.result.load_factor


CHECKED = CHECKS.fields(
    Checks,
    least_load_factor=Field(
        "least load factor of the states of rigid joints that a search found, nan: none ran, or none is verified",
        rule="open",
        files="",
    ),
    torsion_load_factor=Field(
        "greatest load factor on the path of elastic joints whose interfaces twist under uniform "
        "pressure, beside that of contact points; nan: none was followed, or its state is not verified",
        rule="open",
        files="",
    ),
)


@SHOWN.quantity("table json", like=CHECKED["least_load_factor"])
def least_load_factor(case: CaseResult) -> float | None:
    """Where that is a result."""
    return least_of(case)


@SHOWN.quantity("table json", like=CHECKED["torsion_load_factor"])
def torsion_load_factor(case: CaseResult) -> float | None:
    """Where that is a result."""
    return torsion_of(case)


SOLUTION.fields(
    Solution,
    torsion_end=Field(
        "why the path with torsion of uniform pressure ended: falls, flat, far; else its load factor is "
        "borne at least; empty without one",
        rule="open",
        unverified="course",
    ),
)


@SCENE.quantity("table json")
def associative_load_factor(scene: Scene) -> float | None:
    """Load factor by associative flow."""
    return None if scene.associative is None else scene.associative.load_factor


@SCENE.quantity("table")
def best_iterate_load_factor(scene: Scene) -> float | None:
    """Where the case has no result: that of the best iterate, which is not a result."""
    return None if scene.best is None else scene.best.load_factor


CHECKS.fields(
    Checks,
    static_bound=Field("lower bound of the associative load factor", rule="open"),
    kinematic_bound=Field("upper bound of the associative load factor", rule="open"),
    gap=Field("relative distance of the two bounds", rule="open"),
)
SOLUTION.fields(
    Solution,
    path_end=Field(
        "why the path ended: falls, flat, far; or how it was lost; empty without one", rule="open", unverified="course"
    ),
    path_gain=Field("share of the load factor that was gained over its last half", rule="open", unverified="course"),
    path_last=Field("load factor at its end", rule="open", unverified="course"),
    tolerance_requested=Field(
        "gap that the deck asks for, of a case that is approximate for no other reason", part="tolerance_requested"
    ),
)


@SHOWN.quantity("table json", unit="degree")
def angle(case: CaseResult) -> float | None:
    """Tilting table: angle of collapse."""
    return _answer(case, "angle")


@SHOWN.quantity("table json", dims="end", unit="degree")
def angle_bounds(case: CaseResult) -> list[float | None] | None:
    """Tilting table: angle certainly borne, angle certainly not."""
    return list(answer_bounds(case)) if case.load_case.question.column == "angle" else None


@SHOWN.quantity("table json", unit="length")
def ultimate_displacement(case: CaseResult) -> float | None:
    """Pushover: displacement of the control point at which no load factor is left."""
    return displacement_at_the_end(case)


def _ratios(case: CaseResult) -> dict[str, float]:
    """Capacity over demand by limit state."""
    found = case.assessment
    return {} if found is None else {state: each.value for state, each in found.ratios.items()}


@SHOWN.quantity("table json")
def assessment_ratio(case: CaseResult) -> float | None:
    """Capacity over demand by a code, the least of all limit states."""
    return min(_ratios(case).values(), default=None)


def _declare_ratio(state: str, words: str) -> None:
    def ratio(case: CaseResult) -> float | None:
        return _ratios(case).get(state)

    ratio.__doc__ = words
    SHOWN.quantity("table json", name=f"assessment_ratio_{state}")(ratio)


for _state, _words in zip(
    LIMIT_STATES,
    ("the same at the limit state of damage", "the same at that of life safety", "the same at that near collapse"),
    strict=True,
):
    _declare_ratio(_state, _words)


@SHOWN.quantity("table", unit="force")
def reaction_force(case: CaseResult) -> float | None:
    """Settlement: reaction of the support, positive against its motion."""
    return _answer(case, "reaction_force")


@SHOWN.quantity("table", unit="moment")
def reaction_moment(case: CaseResult) -> float | None:
    """The same of a support that turns."""
    return _answer(case, "reaction_moment")


@SHOWN.quantity("table", unit="length")
def peak_displacement(case: CaseResult) -> float | None:
    """Time history: greatest displacement of the centre of a block relative to the base."""
    return _answer(case, "peak_displacement")


@SCENE.quantity("table")
def drift(scene: Scene) -> float | None:
    """The same over the height of that centre above the lowest support."""
    found = history_of(scene.solved)
    return None if found is None else drift_of(scene.assembly, scene.solved.load_case, found)


@SHOWN.quantity("table", unit="length")
def residual_displacement(case: CaseResult) -> float | None:
    """Time history: greatest displacement at the end."""
    found = history_of(case)
    return None if found is None else found.residual


@SCENE.quantity("table")
def first_to_fall(scene: Scene) -> str | None:
    """Time history: block that falls first; empty where none does."""
    found = history_of(scene.solved)
    return None if found is None or found.falls < 0 else scene.model.blocks.name(found.falls)


@SHOWN.quantity("table", unit="time")
def first_period(case: CaseResult) -> float | None:
    """Modes alone: the first period."""
    return _answer(case, "first_period")


def _answer(case: CaseResult, column: str) -> float | None:
    """The figure that a case asks for, in the column that its question has for it."""
    return answer_of(case) if case.load_case.question.column == column else None


@CLAIMED.quantity(unit="load", part="reaction")
def reaction(case: CaseResult) -> float | None:
    """Reaction of the support at which the structure follows it, positive against the motion."""
    question, mechanics = case.load_case.question, case.solution.mechanics
    return question.value(mechanics.load_factor) if question.group == "reaction" and mechanics is not None else None


CHECKS.fields(Checks, verified=Field("1 where everything is within tolerance"))


@SHOWN.quantity("table json", dims="sentence")
def failures(case: CaseResult) -> Sequence[str]:
    """What is not within tolerance, in words."""
    return case.checks.failures


CHECKS.fields(
    Checks,
    equilibrium_residual=Field("largest unbalanced force over mean block weight", rule="open"),
    yield_violation=Field("largest excess over the joint's strength over mean block weight", rule="open"),
    tension_violation=Field("largest tension beyond the tensile strength over mean block weight", rule="open"),
    penetration=Field("largest closing velocity over largest contact speed", rule="open"),
    complementarity_residual=Field("share of the power balance left unexplained under the flow rule", rule="open"),
    slip_residual=Field("the part of it that sliding against friction leaves unexplained", rule="open"),
    elastic_residual=Field(
        "path of elastic joints: largest force off their law, over the largest; nan for rigid joints", rule="open"
    ),
    live_power=Field("live load times mechanism, should be 1", rule="open"),
    power_balance=Field("dissipation minus external power over the larger of the two", rule="open"),
)


REMARKS = Group[Sequence[Message]](
    lambda scene: scene.solved.solution.remarks,
    file="cases/*/remarks",
    rows="remark",
    part="solution",
    unverified="words",
)
FAILURES = Group[Sequence[Message]](
    lambda scene: scene.solved.checks.failures, file="cases/*/failures", rows="failure", part="solution"
)


def _declare_messages(group: Group[Sequence[Message]], whose: str) -> None:
    @group.quantity(words=f"{whose}: stable identifier, as `mbla explain` takes it")
    def identifier(message: Message) -> str:
        """The identifier."""
        return message.identifier

    @group.quantity(words=f"{whose}: in words")
    def message(message: Message) -> str:
        """The text."""
        return message.words


_declare_messages(REMARKS, "what a reader of the figure must know")
_declare_messages(FAILURES, "what is not")
