"""The analysis section of a deck: flow rule, contact model, scheme, reductions, solver, each with its default."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.quantities import Count, Line, Quantity, Switch, Time
from mbla.deck.section import Section, rule
from mbla.deck.sections.accuracy import Accuracy, set_by_accuracy
from mbla.deck.suggestions import listed
from mbla.errors import Finding

Sensitivity: TypeAlias = Annotated[
    Annotated[Switch, Tag("switch")] | Annotated[list[Line], Field(min_length=1), Tag("list")],
    Discriminator(lambda value: "list" if isinstance(value, (list, tuple)) else "switch"),
]
"""All usual parameters or none, or those of some key paths."""


class PublishedScheme(Section):
    """Parameters of the iterative procedure of Portioli et al. 2014 for non-associative flow."""

    slope: Annotated[float, Quantity("number", ge=0, le=1)] = Field(
        0.0,
        description="alpha: share of the friction coefficient kept as slope of each program's yield line; "
        "published runs use small values above 0, which are a small dilatancy; 0 is none",
    )
    averaging: Annotated[float, Quantity("number", gt=0, le=1)] = Field(
        0.6, description="beta: weight of the newest normal forces in the average that sets the fictitious cohesion"
    )
    tolerance: Annotated[float, Quantity("number", gt=0, le=0.1)] = Field(
        1e-4,
        description="the sequence stops when the load factor changes by less, relatively, and no force exceeds "
        "its true friction by more than this share of the mean block load",
    )
    max_programs: Count = Field(60, description="cone programs before the sequence is given up")


class PathOfJoints(Section):
    """The path of elastic joints, whose greatest load is the load factor without dilatancy."""

    ratio: Annotated[float, Quantity("number", ge=0.05, le=2)] = Field(
        0.4, description="stiffness of a joint along itself over that across it"
    )
    until: Annotated[float, Quantity("number", ge=5, le=1000)] = Field(
        50.0,
        description="displacement at which the path ends, over that of the structure at its associative load factor "
        "with all joints stuck",
    )


class AnalysisSection(Section):
    """How the load factor is computed."""

    flow_rule: Literal["associative", "non_associative", "dilatancy", "livesley"] = Field(
        "non_associative",
        description="associative; non-associative without dilatancy; with the joints' dilatancy; or livesley: "
        "associative, with one correction that shows whether a mechanism without dilatancy has the same load factor",
    )
    contact_model: Literal["concave", "convex"] = Field(
        "concave",
        description="concave: contact points at the corners of each interface; convex: also its resultants, with "
        "torsion as of uniform pressure on what an eccentric force leaves of the area. Joints with a compressive "
        "strength crush as stress blocks in both",
    )
    solver: Literal["auto", "mbla", "clarabel"] = Field(
        "auto",
        description="of the cone programs. mbla: the interior-point method made for them, not with contact_model: "
        "convex; clarabel: any; auto: mbla or clarabel by size, the results say which",
    )
    scheme: Literal["auto", "published"] = Field(
        "auto",
        description="how non-associative flow is solved. auto: the greatest load on the path of joints with a "
        "stiffness, from the structure at rest under its dead load; published: the procedure of Portioli et al. 2014",
    )
    path: PathOfJoints = Field(
        default_factory=PathOfJoints, description="flow other than associative: the path of elastic joints"
    )
    published: PublishedScheme = Field(
        default_factory=PublishedScheme, description="parameters of the published procedure"
    )
    search: Annotated[float, Quantity("number", ge=0, le=100)] | None = Field(
        None,
        description="flow other than associative: iterations that may be spent on states of lower load factors, over "
        "those of the first state that was found; in the plane, and in space where it is given; "
        + set_by_accuracy("search"),
    )
    standing: Switch | None = Field(
        None,
        description="assess whether the structure stands before any live load; "
        + set_by_accuracy("standing")
        + "; true for flow other than associative, whose load factor depends on it, unless given",
    )
    sensitivity: Sensitivity = Field(
        False,
        description="how much the associative load factor changes with parameters. true: friction and strengths of "
        "every joint law, density of every material, capacity of every tie, sizes of dead and live load; or a list of "
        "key paths of real numbers in the deck, as `--set` takes them, such as `blocks.0.arch.thickness`",
    )
    torsion: Switch | None = Field(
        None,
        description="in space, flow_rule: non_associative: a second path of elastic joints whose interfaces twist "
        "under uniform pressure: contact points overstate torsion; its load factor stands beside the answer; "
        + set_by_accuracy("torsion"),
    )
    geometric_safety: Switch = Field(
        False,
        description="by how much all joints may shrink about their middles before the dead load falls: of an arch the "
        "thickness over the least one",
    )
    reductions: Switch = Field(
        True,
        description="planar structures are solved with three unknowns a block, parts that cannot interact apart, parts "
        "without live load only have to stand; associative flow: one half of a symmetric structure, without contact "
        "points that cannot matter. The answer is the same without",
    )
    accuracy: Accuracy = Field(
        "standard",
        description="one word for tolerance, gap, residual, search, torsion and standing. draft: first looks and "
        "sweeps, error below 1 %; standard: below 1e-4; reference: as close as double precision gives, and "
        "without dilatancy what joints of other stiffnesses come to",
    )
    tolerance: Annotated[float, Quantity("number", gt=0, le=1e-3)] | None = Field(
        None, description="relative tolerance of the cone solver; " + set_by_accuracy("tolerance")
    )
    gap: Annotated[float, Quantity("number", gt=0, le=1e-2)] | None = Field(
        None,
        description="wanted distance of the proved bounds of the associative load factor, relative; further apart, its "
        "program is solved again by the other method; " + set_by_accuracy("gap"),
    )
    residual: Annotated[float, Quantity("number", gt=0, le=1e-2)] | None = Field(
        None,
        description="flow other than associative: wanted of the largest residual of the joint law of a state that a "
        "search finds; " + set_by_accuracy("residual"),
    )
    max_iterations: Count | None = Field(None, description="iterations of the cone solver for one program")
    time_limit: Time | None = Field(None, description="seconds for all load cases together")


CONVEX_FLOW_RULES = ("associative", "non_associative")


@rule(AnalysisSection)
def convex_contact_model(analysis: AnalysisSection) -> Iterator[Finding]:
    """Interface resultants are solved in one way."""
    if analysis.contact_model != "convex":
        return
    if analysis.flow_rule not in CONVEX_FLOW_RULES:
        allowed = listed(CONVEX_FLOW_RULES)
        words = f"contact_model: convex allows {allowed} only ({analysis.flow_rule} here)"
        yield Finding("key-of-another-choice", words, "flow_rule")
    if analysis.flow_rule == "non_associative" and analysis.scheme != "auto":
        words = f"contact_model: convex allows auto only ({analysis.scheme} here)"
        yield Finding("key-of-another-choice", words, "scheme")
    if analysis.solver == "mbla":
        words = "applies to contact_model: concave only, for which it was made: use auto"
        yield Finding("key-of-another-choice", words, "solver")


Applies = Callable[[AnalysisSection], bool]


def _concave(analysis: AnalysisSection) -> bool:
    return analysis.contact_model == "concave"


def _no_normality(analysis: AnalysisSection) -> bool:
    return analysis.flow_rule == "non_associative"


def _with_scheme(*schemes: str) -> Applies:
    return lambda analysis: _no_normality(analysis) and analysis.scheme in schemes


def _by_exact_law(analysis: AnalysisSection) -> bool:
    other = analysis.scheme != "auto" and _no_normality(analysis)
    return analysis.flow_rule in ("non_associative", "dilatancy") and not other


APPLIES: Mapping[str, tuple[Applies, str]] = {
    "scheme": (_no_normality, "flow_rule: non_associative"),
    "published": (_with_scheme("published"), "flow_rule: non_associative with scheme: published"),
    "residual": (_by_exact_law, "flow_rule: non_associative or dilatancy with scheme: auto"),
    "search": (
        lambda analysis: _concave(analysis) and _by_exact_law(analysis),
        "contact_model: concave and flow_rule: non_associative or dilatancy with scheme: auto",
    ),
    "path": (_by_exact_law, "flow_rule: non_associative or dilatancy with scheme: auto"),
    "torsion": (
        lambda analysis: _concave(analysis) and _with_scheme("auto")(analysis),
        "contact_model: concave and flow_rule: non_associative with scheme: auto",
    ),
}
"""Key of the analysis section -> whether it has an effect, and with what it has."""
