"""Joints of a time history that have torn or slid beyond their strengths, which the law holds without end.

The law is perfectly plastic: a joint that opens pulls with its tensile strength f_t however far it is open, and one
that slides or is open resists with its cohesion c besides friction, again and again. A joint is beyond that where it
has opened or slid by more than twice what it gives elastically: f_t/k_N across, (c + μ k_N s)/k_T along, and not less
than the sag s at rest.
"""

from __future__ import annotations

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import Model
from mbla.solution.time_history.history import TimeHistoryResult

BEYOND = 2.0
"""times what a joint gives elastically"""


def ductile_remark(model: Model, contacts: Contacts, result: TimeHistoryResult) -> Message | None:
    """By how far joints with tensile strength or cohesion have opened and slid; None where they hold."""
    peaks = result.peaks
    if peaks is None:
        return None
    found: dict[str, float] = {}
    names: set[str] = set()
    for row, name in enumerate(contacts.joint_names):
        law, own = model.joints[name], contacts.joints == row
        normal = result.stiffness[0] if np.isnan(law.normal_stiffness) else law.normal_stiffness
        gives = law.tensile_strength / normal
        slides = (law.cohesion + law.friction * normal * result.sag) / (law.shear_ratio * normal)
        for how, strength, limit, values in (
            ("opened", max(law.tensile_strength, law.cohesion), gives, peaks.openings),
            ("slid", law.cohesion, slides, peaks.slips),
        ):
            most = float(values[own].max(initial=0.0))
            if strength > 0.0 and most > BEYOND * max(limit, result.sag):
                found[how], names = max(found.get(how, 0.0), most), names | {name}
    if not found:
        return None
    by = " and ".join(f"{how} by up to {most:.2g} {model.units.length}" for how, most in found.items())
    laws = ", ".join(name for name in contacts.joint_names if name in names)
    words = f"joints of {laws} have {by}, and hold their tensile strength and cohesion all the same, again and again: "
    return Message("time-history-ductile", f"{words}mortar that has torn holds nothing, and moves farther")
