"""Power of the live load of every load case in the mechanism behind a kinematic bound.

A mechanism u that the joints allow with associative flow bounds every live load at once. With the dead load G, the
dissipation D and live loads L_c of the same structure, no factors x_c acting together are carried unless

    Σ x_c L_c·u ≤ D(u) − G·u.

u is scaled so that the live load of its own case has unit power; the right side then is its kinematic bound k. In the
space of the factors of load cases with one dead load Σ x_c p_c ≤ k is a half-space that contains the safe domain.
"""

from __future__ import annotations

from mbla.model.model import Model
from mbla.results.outcome import associative_of
from mbla.results.records.numbers import number
from mbla.results.results import CaseResult
from mbla.solution.verification.statics import power


def powers_json(model: Model, case: CaseResult) -> dict[str, float | None] | None:
    """Powers by the name of the load case; positions of travelling loads and settlements have none.

    None where there is no such mechanism, and for polyhedral friction, whose bounds belong to two of them.
    """
    associative = associative_of(case)
    if associative is None or case.solution.outer is not None or case.load_case.settlement is not None:
        return None
    own = power(case.load_case.live_load, associative.mechanism)
    if not own > 0.0:
        return None
    others = [one for one in model.load_cases if one.travel is None and one.settlement is None and one.tilt is None]
    return {one.name: number(power(one.live_load, associative.mechanism) / own) for one in others}
