"""What of a structure counts for its load factor, and how unique its forces are, in words."""

from __future__ import annotations

from mbla.contacts.contacts import Contacts
from mbla.results.collapse.enough import Enough
from mbla.results.collapse.force_freedom import ForceFreedom
from mbla.results.listing.text import counted, sentence
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult


def enough_lines(case: CaseResult, enough: Enough) -> list[str]:
    """Which blocks can be left out; nothing where every free block moves or the case has no result."""
    resting = len(enough.bearing) + len(enough.left_out)
    if result_of(case) is None or not resting or not len(enough.moving):
        return []
    what = (
        f"Enough for this result: the {counted(len(enough.moving), 'block')} that move and the "
        f"{counted(len(enough.interfaces), 'interface')} on them."
    ).replace("1 block that move ", "1 block that moves ")
    out = len(enough.left_out)
    if out == resting:
        touches = "touches" if out == 1 else "touch"
        fixed = f"Without the {counted(resting, 'free block')} at rest, which {touches} nothing that moves,"
    else:
        fixed = f"With the {counted(resting, 'free block')} at rest fixed"
        touch = "touches" if out == 1 else "touch"
        fixed += f", of which {out} {touch} nothing that moves and can be left out," if out else ","
    if case.solution.flow_rule == "associative":
        return sentence(f"{what} {fixed} the load factor is the same.")
    return sentence(
        f"{what} {fixed} forces and mechanism found here are a state of the smaller structure too, with the same load "
        "factor; without normality it may have others."
    )


def freedom_lines(contacts: Contacts, case: CaseResult, freedom: ForceFreedom | None, why: str) -> list[str]:
    """Whether the forces are unique, or ``why`` that is not known; the option that gives their ranges if not taken."""
    if result_of(case) is None or not len(contacts):
        return []
    ranges = case.solution.force_ranges is None and case.solution.contact_model == "concave"
    ask = " Their ranges are found with analysis.force_ranges: true." if ranges else ""
    if freedom is None:
        return sentence(f"How far the contact forces are unique was not determined, as {why}.{ask}")
    whose = "" if case.solution.flow_rule == "associative" else " in this mechanism"
    if freedom.degree == 0:
        return sentence(f"The resultant of every interface is unique at this load factor{whose}.")
    known = int(freedom.determined.sum())
    return sentence(
        f"The contact forces are not unique: at this load factor{whose} equilibrium lets them vary in up "
        f"to {counted(freedom.degree, 'way')}, as far as the strength of the joints allows; the resultants of {known} "
        f"of {counted(len(contacts), 'interface')} are the same in all.{ask}"
    )
