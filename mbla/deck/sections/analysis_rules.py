"""Rules on the analysis."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck.section import rule
from mbla.deck.sections.analysis import AnalysisSection
from mbla.deck.suggestions import listed
from mbla.errors import Finding


@rule(AnalysisSection)
def linear_programs(analysis: AnalysisSection) -> Iterator[Finding]:
    """Polyhedra and HiGHS go with flow rules whose programs are linear."""
    normality = analysis.flow_rule in ("associative", "livesley")
    for key, value, special, default in (
        ("friction_cone", analysis.friction_cone, "polyhedral", "circular"),
        ("solver", analysis.solver, "highs", "auto"),
    ):
        if value != special:
            continue
        if not normality:
            yield Finding(
                "key-of-another-choice",
                f"applies to flow_rule: associative or livesley only ({analysis.flow_rule} here): use {default}",
                key,
            )
        elif analysis.contact_model != "concave":
            yield Finding(
                "key-of-another-choice",
                f"applies to contact_model: concave only ({analysis.contact_model} here): use {default}",
                key,
            )


CONVEX_FLOW_RULES = ("associative", "non_associative")


@rule(AnalysisSection)
def convex_contact_model(analysis: AnalysisSection) -> Iterator[Finding]:
    """Interface resultants are solved in one way."""
    if analysis.contact_model != "convex":
        return
    if analysis.flow_rule not in CONVEX_FLOW_RULES:
        allowed = listed(CONVEX_FLOW_RULES)
        yield Finding(
            "key-of-another-choice",
            f"contact_model: convex allows {allowed} only ({analysis.flow_rule} here)",
            "flow_rule",
        )
    if analysis.flow_rule == "non_associative" and analysis.scheme not in ("auto", "proximal"):
        yield Finding(
            "key-of-another-choice",
            f"contact_model: convex allows auto or proximal only ({analysis.scheme} here)",
            "scheme",
        )
    if analysis.solver == "mbla":
        yield Finding(
            "key-of-another-choice",
            "applies to contact_model: concave only, whose cones have three dimensions: use auto",
            "solver",
        )
    if analysis.force_ranges:
        yield Finding("key-of-another-choice", "applies to contact_model: concave only: use false", "force_ranges")
