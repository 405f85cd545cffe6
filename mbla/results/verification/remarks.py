"""Remarks on load cases: those that follow from deck, forces and mechanisms are found again, the others are named.

A remark of the first kind that is missing is a difference, and so is one that does not follow. What the run alone can
remark is taken as the run made it where a run of that deck can make it at all; it excuses nothing.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from mbla.assembly.assembly import Assembly
from mbla.assembly.structure_at import StructureAt
from mbla.deck import Deck
from mbla.errors import Message
from mbla.questions.tilt import Tilt
from mbla.results.collapse.state_remarks import state_remarks
from mbla.results.explanations import explanations
from mbla.results.findings import FOUND_AGAIN
from mbla.results.results import CaseResult
from mbla.results.verification.asked import by_normality
from mbla.results.verification.modes_after import modes_after_remarks
from mbla.solution.further.geometric_safety.find import no_geometric_safety, why_no_geometric_safety
from mbla.solution.further.sensitivity.sensitivity import no_sensitivity, why_no_sensitivity
from mbla.solution.modes.checked import modes_remarks, modes_wrong
from mbla.solution.pushover.curve import pushover_remarks
from mbla.solution.pushover.start import no_pushover, why_not_pushed
from mbla.solution.sequence.tilting_table import NOT_PROVED_BETWEEN
from mbla.solution.solution import WITH_VALUE, Solution, Status
from mbla.solution.time_history.remarks import history_remarks
from mbla.solution.verification.modes import checked_modes
from mbla.solution.verification.tilting_table import GOOD


def _without_dilatancy(case: CaseResult) -> bool:
    return case.solution.flow_rule == "non_associative"


def _by_path(case: CaseResult) -> bool:
    return case.solution.flow_rule in ("non_associative", "dilatancy")


POSSIBLE: Mapping[str, Callable[[CaseResult], bool]] = {
    "associative-bounds-apart": lambda case: case.solution.flow_rule != "associative",
    "default-for-published": _without_dilatancy,
    "elastic-path-rises": _by_path,
    "livesley-confirms": lambda case: case.solution.flow_rule == "livesley" and case.status is Status.SOLVED,
    "livesley-overstates": lambda case: case.solution.flow_rule == "livesley" and case.status is not Status.SOLVED,
    "lower-not-searched": lambda case: case.solution.flow_rule != "associative",
    "tilt-by-steps": lambda case: case.load_case.question.by_steps,
}
"""Of remarks that the run alone can make: whether it can make them of a load case; of all others it can."""

LIVESLEY = frozenset({"livesley-confirms", "livesley-overstates"})
"""remarks of which one is the answer of ``flow_rule: livesley``"""
MADE_LAST = frozenset({"sensitivity-not-done", "geometric-safety-not-done"})
"""remarks on what is done after a pushover, which a run that is stopped in it has not made"""
NUMBER = re.compile(r"(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)")
"""numbers in words"""


def remarks_found_again(deck: Deck, assembly: Assembly, case: CaseResult) -> tuple[Message, ...]:
    """The remarks that a run must make of a load case, in its order.

    case : with checks, status, curve and assessment recomputed
    """
    load_case, solution = case.load_case, case.solution
    model, contacts = assembly.model.of_case(load_case), assembly.contacts
    found: list[Message] = []
    tilt = load_case.question.record(Tilt)
    if tilt and not (tilt.tangent or tilt.borne_to(math.radians(tilt.angle))) and _at_collapse(solution):
        found.append(NOT_PROVED_BETWEEN)
    if load_case.pushover is not None:
        against = why_not_pushed(model, contacts, load_case, solution, case.status is Status.SOLVED)
        if solution.further.pushover.rows is not None and solution.mechanics is not None:
            found += pushover_remarks(model, load_case, solution, solution.further.pushover)
        found += [no_pushover(against)] if against else []
    if len(solution.further.modes):
        there = StructureAt.as_built(assembly, load_case)
        found += modes_remarks(model, load_case, solution.further.modes)
        found += [modes_wrong(words) for words in checked_modes(there, solution.further.modes)[1]]
    found += modes_after_remarks(deck, assembly, case)
    found += history_remarks(model, contacts, load_case, solution.further.time_history)
    if deck.analysis.sensitivity is not False:
        against = why_no_sensitivity(load_case, solution, case.checks)
        found += [no_sensitivity(against)] if against else []
    if deck.analysis.geometric_safety:
        against = why_no_geometric_safety(model, contacts, load_case, deck.analysis)
        found += [no_geometric_safety(against)] if against else []
    found += state_remarks(assembly.model, load_case, solution)
    return (*found, *(() if case.assessment is None else case.assessment.remarks))


def _at_collapse(solution: Solution) -> bool:
    """Whether the load factor says that the loads are those at the angle of collapse, not of a fall at once."""
    own = solution.mechanics
    return own is not None and solution.status in WITH_VALUE and abs(own.load_factor - 1.0) <= GOOD


def differences_of_remarks(case: CaseResult, found: Sequence[Message]) -> Iterator[str]:
    """Where the remarks of a load case are not those found again, or no run of its deck can make them, in words."""
    left = list(found)
    for remark in case.solution.remarks:
        same = next((each for each in left if same_remark(remark, each)), None)
        if same is not None:
            left.remove(same)
        elif remark.identifier in FOUND_AGAIN:
            yield f"the remark {remark.identifier} does not follow from what the file holds: {remark}"
        elif remark.identifier not in explanations() or not POSSIBLE.get(remark.identifier, _always)(case):
            yield f"no run of the deck in the file makes the remark {remark.identifier}: {remark}"
    for remark in left:
        yield f"the remark {remark.identifier} is missing: {remark}"
    said = {remark.identifier for remark in case.solution.remarks}
    answered = case.solution.flow_rule == "livesley" and case.solution.mechanics is not None
    if answered and case.status is Status.SOLVED and not said & LIVESLEY and not by_normality(case.solution):
        yield f"the remark {' or '.join(sorted(LIVESLEY))} is missing"


def _always(case: CaseResult) -> bool:
    return True


def same_remark(one: Message, other: Message) -> bool:
    """Whether two remarks say the same, numbers to one in the last of their digits."""
    words, others = NUMBER.split(one.words), NUMBER.split(other.words)
    if one.identifier != other.identifier or len(words) != len(others) or words[::2] != others[::2]:
        return False
    return all(_near(a, b) for a, b in zip(words[1::2], others[1::2], strict=True))


def _near(one: str, other: str) -> bool:
    def last(text: str) -> float:
        digits, _, power = text.partition("e")
        return float(10.0 ** (float(power or 0) - len(digits.partition(".")[2])))

    apart = abs(float(one) - float(other))
    return one == other or ("." in one + other and apart <= 1.01 * max(last(one), last(other)))
