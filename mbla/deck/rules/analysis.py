"""Rules on the analysis."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.section import Finding, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message


@rule(types.AnalysisSection)
def linear_programs(analysis: types.AnalysisSection) -> Iterator[Finding]:
    """Polyhedra and HiGHS go with flow rules whose programs are linear."""
    normality = analysis.flow_rule in ("associative", "livesley")
    for key, value, special, default in (
        ("friction_cone", analysis.friction_cone, "polyhedral", "circular"),
        ("solver", analysis.solver, "highs", "auto"),
    ):
        if value != special:
            continue
        if not normality:
            yield (
                (key,),
                Message(
                    "key-of-another-choice",
                    f"applies to flow_rule: associative or livesley only ({analysis.flow_rule} here): use {default}",
                ),
            )
        elif analysis.contact_model != "concave":
            yield (
                (key,),
                Message(
                    "key-of-another-choice",
                    f"applies to contact_model: concave only ({analysis.contact_model} here): use {default}",
                ),
            )


CONVEX_FLOW_RULES = ("associative", "non_associative")
NOT_CONVEX = (("form", "kinematic"), ("second_opinion", False), ("force_ranges", False))


@rule(types.AnalysisSection)
def convex_contact_model(analysis: types.AnalysisSection) -> Iterator[Finding]:
    """Interface resultants are solved in one way."""
    if analysis.contact_model != "convex":
        return
    if analysis.flow_rule not in CONVEX_FLOW_RULES:
        allowed = listed(CONVEX_FLOW_RULES)
        yield (
            ("flow_rule",),
            Message(
                "key-of-another-choice", f"contact_model: convex allows {allowed} only ({analysis.flow_rule} here)"
            ),
        )
    if analysis.flow_rule == "non_associative" and analysis.scheme not in ("auto", "proximal"):
        yield (
            ("scheme",),
            Message(
                "key-of-another-choice", f"contact_model: convex allows auto or proximal only ({analysis.scheme} here)"
            ),
        )
    if analysis.solver == "mbla":
        yield (
            ("solver",),
            Message(
                "key-of-another-choice",
                "applies to contact_model: concave only, whose cones have three dimensions: use auto",
            ),
        )
    for key, default in NOT_CONVEX:
        if getattr(analysis, key) != default:
            yield (
                (key,),
                Message("key-of-another-choice", f"applies to contact_model: concave only: use {str(default).lower()}"),
            )
