"""What may be claimed of a live load where the structure was not seen to stand before it acts.

Associative flow presumes nothing: its bounds hold with and without self-stress, whatever stands. A load factor of
another flow rule is one at which a structure that stands begins to move. Where it stands only in a self-stressed state,
that state decides, and nobody knows it; where standing is in doubt, the structure may already move at less.
"""

from __future__ import annotations

from dataclasses import replace

from mbla.solution.solution import WITH_VALUE, Solution, Standing, Status

ONLY_BY_SELF_STRESS = "it stands only in a self-stressed state: without knowing that state there is no collapse load"
STANDING_IN_DOUBT = (
    "whether it stands under its dead load alone is in doubt: it may already fall at less than the load factor given"
)
LOCK_IN_DOUBT = "whether it stands under its dead load alone is in doubt, which comes before what any live load does"


def as_it_stands(solution: Solution, verdict: Standing) -> Solution:
    """A solution that claims no more than its standing allows."""
    if solution.flow_rule == "associative":
        return solution
    claims = (*WITH_VALUE, Status.UNBOUNDED)
    if verdict is Standing.SELF_STRESS:
        status = Status.NOT_VERIFIED if solution.status in claims else solution.status
        return replace(solution, status=status, reason=ONLY_BY_SELF_STRESS)
    if verdict is not Standing.DOUBTFUL or solution.status not in claims:
        return solution
    if solution.status is Status.UNBOUNDED:
        return replace(solution, status=Status.NOT_VERIFIED, reason=LOCK_IN_DOUBT, lock=None)
    return replace(solution, status=Status.APPROXIMATE, reason=STANDING_IN_DOUBT, tolerance_requested=None)
