"""Whether an analysis is solved with conditions on interfaces: torsion where asked for, crushing wherever it can be."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.model.model import Model


def crushable_interfaces(model: Model, contacts: Contacts) -> BoolArray:
    """Interfaces with a compressive strength, (n_interfaces,)."""
    strengths = np.array([model.joints[name].compressive_strength for name in contacts.joint_names])
    return np.asarray(np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool))


def has_conditions_on_interfaces(analysis: AnalysisSection, model: Model, contacts: Contacts) -> bool:
    """Whether the program has conditions on interfaces; without, joints crush at their contact points."""
    if analysis.contact_model == "convex":
        return True
    return takes_stress_blocks(analysis) and bool(crushable_interfaces(model, contacts).any())


def takes_stress_blocks(analysis: AnalysisSection) -> bool:
    """Whether flow rule, scheme, form and solver of an analysis go with conditions on interfaces."""
    schemes = ("auto", "proximal")
    by_flow = analysis.flow_rule == "associative" or (
        analysis.flow_rule == "non_associative" and analysis.scheme in schemes
    )
    by_solver = analysis.friction_cone == "circular" and analysis.solver in ("auto", "clarabel")
    plain = analysis.form == "kinematic" and not analysis.second_opinion and not analysis.force_ranges
    return by_flow and by_solver and plain
