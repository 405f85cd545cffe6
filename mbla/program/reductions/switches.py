"""Which reductions an analysis allows: those that are switched on, less those that would change its answer."""

from __future__ import annotations

from mbla.deck.sections.analysis import AnalysisSection, ReductionSwitches


def allowed_reductions(analysis: AnalysisSection) -> ReductionSwitches:
    """Switches for ``reduce_program``.

    Mirror symmetry is not used with friction polyhedra, which are not symmetric themselves, so that one half of them
    would be another law; nor for the range of forces, which is wider than that of symmetric forces. For that range the
    points that cannot matter for the load factor stay too: their interfaces would have no forces of their own.
    """
    switches = analysis.reductions
    if analysis.friction_cone == "polyhedral":
        switches = switches.model_copy(update={"mirror": False})
    if analysis.force_ranges:
        switches = switches.model_copy(update={"mirror": False, "points": False})
    return switches
