"""Settings of an analysis in words, as result files keep them."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.deck import Deck
from mbla.deck.sections.accuracy import knobs_of
from mbla.deck.sections.analysis import AnalysisSection
from mbla.results.results import CaseResult
from mbla.solution.settings import SolverSettings


def settings_in_words(deck: Deck, settings: SolverSettings) -> dict[str, str]:
    """Analysis settings in effect, by name, for the result files."""
    analysis = deck.analysis
    words = {
        "flow_rule": analysis.flow_rule,
        "contact_model": analysis.contact_model,
        "friction_cone": "circular" if analysis.friction_cone == "circular" else f"polyhedral, {analysis.sides} sides",
        "accuracy": analysis.accuracy,
        "solver": analysis.solver,
        "tolerance": f"{settings.tolerance:g}",
        **_knobs_in_words(analysis, settings),
        "max_iterations": str(settings.max_iterations),
        "contact_points": _points_in_words(deck),
        "contact_tolerance": f"{deck.contacts.tolerance:g}",
    }
    if analysis.flow_rule == "non_associative":
        words["scheme"] = analysis.scheme
        parameters = getattr(analysis, analysis.scheme, None)  # none for auto
        if parameters is not None:
            words |= {f"scheme_{name}": f"{value:g}" for name, value in parameters.model_dump().items()}
    if not analysis.reductions:
        words["reductions"] = _on(analysis.reductions)
    if analysis.time_limit is not None:
        words["time_limit"] = f"{analysis.time_limit:g} s"
    return words


def _knobs_in_words(analysis: AnalysisSection, settings: SolverSettings) -> dict[str, str]:
    """What accuracy sets, and the deck may set by itself, where it has an effect."""
    knobs = knobs_of(analysis)
    words = {}
    if analysis.contact_model == "concave" and analysis.friction_cone == "circular":
        words["gap"] = f"{settings.gap:g}"
    if analysis.flow_rule in ("non_associative", "dilatancy") and analysis.scheme != "published":
        words["residual"] = f"{settings.residual:g}"
    if analysis.contact_model == "concave" and analysis.flow_rule != "associative":
        words["range"] = _on(knobs.range)
        if analysis.flow_rule == "non_associative":
            words["peak"] = _on(knobs.peak)
    return words | {"standing": _on(knobs.standing)}


def threads_in_words(cases: Sequence[CaseResult]) -> str:
    """Threads that factorisations of cone programs ran on, whatever was asked for: all are serial."""
    used = {program.factorization for case in cases for program in case.solution.programs} - {""}
    return f"1; factorisations by {', '.join(sorted(used))} are serial" if used else "1"


def _on(switch: bool) -> str:
    return "true" if switch else "false"


def _points_in_words(deck: Deck) -> str:
    """How an interface is represented."""
    contacts = deck.contacts
    if deck.analysis.contact_model == "convex":
        return "resultants of each interface"
    points, length = contacts.points, deck.units.length
    words = "corners"
    if points.spacing is not None:
        words = f"at most {points.spacing:g} {length} apart along each edge, and inside"
    elif (points.per_edge or 1) > 1:
        words = f"{points.per_edge} along each edge, and inside"
    inwards = f"{points.inset:g}" if points.inset else f"{points.rounding:g} {length}" if points.rounding else ""
    return words + (f", inset by {inwards}" if inwards else "")
