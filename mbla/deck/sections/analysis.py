"""The analysis section of a deck: flow rule, contact model, scheme, reductions, solver, each with its default."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.quantities import Count, Line, RealNumber, Switch, Time
from mbla.deck.section import ByShape, Section, rule
from mbla.deck.sections.accuracy import Accuracy, set_by_accuracy
from mbla.deck.suggestions import listed
from mbla.errors import Finding

Sensitivity: TypeAlias = Annotated[Switch | Annotated[list[Line], Field(min_length=1)], ByShape("name")]
"""All usual parameters or none, or those of some key paths."""


class PublishedScheme(Section):
    """Parameters of the iterative procedure of Portioli et al. 2014 for non-associative flow."""

    slope: Annotated[float, RealNumber("number", ge=0, le=1)] = Field(
        0.0,
        description="alpha: share of the friction coefficient kept as slope of each program's yield line; "
        "published runs use small values above 0, which are a small dilatancy; 0 is none",
    )
    averaging: Annotated[float, RealNumber("number", gt=0, le=1)] = Field(
        0.6, description="beta: weight of the newest normal forces in the average that sets the fictitious cohesion"
    )
    tolerance: Annotated[float, RealNumber("number", gt=0, le=0.1)] = Field(
        1e-4,
        description="the sequence stops when the load factor changes by less, relatively, and no force exceeds "
        "its true friction by more than this share of the mean block load",
    )
    max_programs: Count = Field(60, description="most cone programs of the sequence")


class PathOfJoints(Section):
    """The path of elastic joints, whose greatest load is the load factor without dilatancy."""

    ratio: Annotated[float, RealNumber("number", ge=0.05, le=2)] = Field(
        0.4, description="shear stiffness of a joint over its normal stiffness"
    )
    until: Annotated[float, RealNumber("number", ge=5, le=1000)] = Field(
        50.0,
        description="displacement at the end of the path, in elastic displacements: of the structure at its "
        "associative load factor with all joints stuck",
    )


class AnalysisSection(Section):
    """How the load factor is computed."""

    flow_rule: Literal["associative", "non_associative", "dilatancy", "livesley"] = Field(
        "non_associative",
        description="associative: sliding lifts by the friction angle; non_associative: sliding does not lift; "
        "dilatancy: sliding lifts by the dilatancy angle of each joint; livesley: associative, with a second "
        "program that shows whether a mechanism without dilatancy has the same load factor; the default with soil of "
        "cells is associative",
    )
    contact_model: Literal["concave", "convex"] = Field(
        "concave",
        description="concave: contact points at the corners of each interface; convex: resultants of each "
        "interface as well, with torsion of uniform pressure on the area that an eccentric force leaves. In both, "
        "joints with a compressive strength crush as stress blocks",
    )
    solver: Literal["auto", "mbla", "clarabel"] = Field(
        "auto",
        description="solver of the cone programs. mbla: an interior-point method made for them, not with "
        "contact_model: convex; clarabel: general; auto: by size, the results say which",
    )
    scheme: Literal["auto", "published"] = Field(
        "auto",
        description="scheme of non-associative flow. auto: the greatest load on the path of elastic joints, from "
        "the structure at rest under its dead load; published: the procedure of Portioli et al. 2014",
    )
    path: PathOfJoints = Field(
        default_factory=PathOfJoints, description="flow other than associative: the path of elastic joints"
    )
    published: PublishedScheme = Field(
        default_factory=PublishedScheme, description="parameters of the published procedure"
    )
    search: Annotated[float, RealNumber("number", ge=0, le=100)] | None = Field(
        None,
        description="flow other than associative: effort to lower the load factor, as a multiple of the iterations "
        "of the first solve; in space only where it is given; " + set_by_accuracy("search"),
    )
    standing: Switch | None = Field(
        None,
        description="assess whether the structure stands before any live load; "
        + set_by_accuracy("standing")
        + "; true for flow other than associative, whose load factor depends on it",
    )
    sensitivity: Sensitivity = Field(
        False,
        description="sensitivities of the associative load factor. true: to friction and strengths of every joint "
        "law, density of every material, capacity of every tie, sizes of dead and live load; or a list of key paths "
        "of real numbers in the deck, as `--set` takes them, such as `blocks.0.arch.thickness`",
    )
    torsion: Switch | None = Field(
        None,
        description="in space, flow_rule: non_associative: follow a second path, on which interfaces twist under "
        "uniform pressure, as contact points overstate torsion; its load factor stands beside the answer; "
        + set_by_accuracy("torsion"),
    )
    geometric_safety: Switch = Field(
        False,
        description="factor by which all joints may shrink about their centroids before the dead load falls: of an "
        "arch the thickness over the least one",
    )
    soil_range: Switch = Field(
        False,
        description="with soil of cells: the load factors on two paths of elastic joints beside the answer, on which "
        "soil slides without dilatancy and with that of its friction angle, joints of masonry without; each takes "
        "longer than the associative load factor",
    )
    reductions: Switch = Field(
        True,
        description="leave out what need not be solved: planar structures have three unknowns a block, parts that "
        "cannot interact are solved apart, parts without live load only have to stand; with associative flow one "
        "half of a symmetric structure is solved, without contact points that cannot matter. The answer stays the "
        "same",
    )
    accuracy: Accuracy = Field(
        "standard",
        description="preset of tolerance, gap, residual, search, torsion and standing. draft: first looks and "
        "sweeps, error below 1 %; standard: below 1e-4; reference: to double precision, and without dilatancy the "
        "load factors for other stiffnesses of joints as well",
    )
    tolerance: Annotated[float, RealNumber("number", gt=0, le=1e-3)] | None = Field(
        None, description="relative tolerance of the cone solver; " + set_by_accuracy("tolerance")
    )
    gap: Annotated[float, RealNumber("number", gt=0, le=1e-2)] | None = Field(
        None,
        description="greatest distance of the proved bounds of the associative load factor, relative; where it is "
        "larger, the program is solved again by the other method; " + set_by_accuracy("gap"),
    )
    residual: Annotated[float, RealNumber("number", gt=0, le=1e-2)] | None = Field(
        None,
        description="flow other than associative: greatest residual of the joint law of a state that a search "
        "finds; " + set_by_accuracy("residual"),
    )
    max_iterations: Count | None = Field(None, description="most iterations of the cone solver for one program")
    time_limit: Time | None = Field(None, description="time for all load cases together, seconds")


CONVEX_FLOW_RULES = ("associative", "non_associative")


@rule(AnalysisSection)
def convex_contact_model(analysis: AnalysisSection) -> Iterator[Finding]:
    """Interface resultants are solved in one way."""
    if analysis.contact_model != "convex":
        return
    if analysis.soil_range:
        yield Finding("key-of-another-choice", "applies to contact_model: concave only: use false", "soil_range")
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
