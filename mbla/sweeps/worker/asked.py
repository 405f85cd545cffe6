"""What no column of a sweep shows is not worked out: the range of the load factor, and a peak on the way to it.

Both are other questions about the state that was found, and their answers change no other value
(``further_results``). Together they may take longer than the state itself. They are worked out where a column
shows them, or something that may depend on them, and where result files of points are kept, which hold everything.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mbla.deck.deck import Deck
from mbla.sweeps.plan import Plan

WITHOUT_THEM = frozenset(
    {
        "model",
        "status",
        "reason",
        "flow_rule",
        "scheme",
        "load_factor",
        "angle",
        "angle_bounds",
        "reaction",
        "static_bound",
        "kinematic_bound",
        "gap",
        "asked",
        "associative_load_factor",
        "bracket",
        "powers",
        "residuals",
        "equilibrium_residual",
        "yield_violation",
        "tension_violation",
        "penetration",
        "complementarity_residual",
        "slip_residual",
        "live_power",
        "power_balance",
        "verified",
        "failures",
        "standing",
        "certificate",
        "size",
        "mechanism",
        "reactions",
    }
)
"""first keys of columns whose values are the same, bit for bit, without range and peak; any other asks for both"""


def with_what_is_asked(deck: Deck, plan: Plan) -> Deck:
    """The deck of a point, without the questions beside the load factor whose answers nobody will see."""
    if plan.keep != "none" or not shown_without_them(plan.results):
        return deck
    analysis = deck.analysis.model_copy(update={"range": False, "peak": False})
    return replace(deck, content=deck.content.model_copy(update={"analysis": analysis}))


def shown_without_them(results: Sequence[str]) -> bool:
    """Whether no column depends on range or peak."""
    return all(path.partition(".")[0] in WITHOUT_THEM for path in results)
