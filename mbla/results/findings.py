"""What solver and verification found wrong or remark, as notices of a run.

There are also magnitudes in one model that lie so far apart that double precision is the cause of what is not verified.
Sixteen digits hold the forces on a heavy block and what remains of them for a light neighbour. Measured: weights of
neighbours 1e8 apart, and joints 1e7 times as strong as the loads, still give verified load factors; at 1e12 none does
for sure, but of a light block that touches one heavier body only, whatever their ratio: a cube of 1e6 m under a block
of 1 m. Of an interface that tips long before it slides, friction times slenderness is such a ratio: convex contacts
with 1e8 are right to six digits, with 1e9 they are not solved. Likewise a load factor is exact to the rounding of the
forces over the live load: one that is near zero relative to dead over live load is zero to that rounding.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status
from mbla.solution.thresholds import NEAR_ZERO
from mbla.solution.verification.case import PROVED_RESIDUAL
from mbla.solution.verification.statics import bodies_of_points, load_scale, load_sizes

BROKEN = {
    Status.ITERATION_LIMIT: "the iterations ran out",
    Status.TIME_LIMIT: "the time ran out",
    Status.NUMERICAL_ERROR: "the solver failed numerically",
}
"""Why a cone program has no answer."""

WITHOUT_REASON = BROKEN | {
    Status.APPROXIMATE: "verification confirms the load factor to 1e-2 at best",
    Status.NOT_VERIFIED: "verification does not confirm the answer",
    Status.NO_EQUILIBRIUM: "the dead load alone is not carried",
    Status.UNBOUNDED: "no multiple of the live load brings the structure down",
}
"""Words on every status that is not simply a verified load factor, where the solver gives no reason."""

REMARKS_THAT_WARN = frozenset(
    {
        "assessment-in-doubt",
        "assessment-not-done",
        "brittle-ties",
        "control-point-at-rest",
        "default-for-published",
        "geometric-safety-not-done",
        "history-still-moves",
        "livesley-overstates",
        "modes-in-part",
        "modes-not-verified",
        "modes-soft",
        "no-modes",
        "pushover-depends-on-step",
        "pushover-drops",
        "pushover-not-done",
        "pushover-rough",
        "sensitivity-not-done",
        "soil-mesh-scatters",
        "tilt-between-not-proved",
        "time-history-ductile",
        "time-history-soft",
        "time-history-soil",
    }
)
"""Remarks of a solver that are warnings; the others are notices."""

FOUND_AGAIN = frozenset(
    {
        "assessment-in-doubt",
        "assessment-not-done",
        "brittle-ties",
        "control-point-at-rest",
        "history-still-moves",
        "modes-fewer",
        "modes-loose-blocks",
        "modes-in-part",
        "modes-not-verified",
        "modes-soft",
        "pushover-depends-on-step",
        "pushover-drops",
        "pushover-not-done",
        "pushover-rough",
        "sensitivity-not-done",
        "soil-mesh",
        "soil-mesh-of-others",
        "soil-mesh-scatters",
        "tilt-between-not-proved",
        "time-history-coarse",
        "time-history-ductile",
        "time-history-missed",
        "time-history-soft",
        "time-history-soil",
    }
)
"""Remarks that follow from deck, forces and mechanisms: verification finds them again. The others are the run's own."""


def found_notices(case: CaseResult, *, harmless: bool = False) -> tuple[Notice, ...]:
    """Status, failures of the verification and remarks of the solver as notices.

    harmless : a position of a travelling load that brings nothing down where another does, a force without limit
    """
    name, solution = case.load_case.name, case.solution
    notices: list[Notice] = []

    def add(severity: Literal["notice", "warning"], identifier: str, text: str) -> None:
        notice = Notice(severity, identifier, f"{name}: {text}", name)
        if notice not in notices:
            notices.append(notice)

    if case.status in WITHOUT_REASON:
        reason = solution.reason or _reason_of(case)
        add("notice" if harmless else "warning", case.status.value.replace("_", "-"), reason)
    for failure in case.checks.failures:
        if failure != solution.reason:
            add("warning", failure.identifier, failure)
    for remark in solution.remarks:
        if remark != solution.reason or case.status is Status.SOLVED:
            severity: Literal["notice", "warning"] = "warning" if remark.identifier in REMARKS_THAT_WARN else "notice"
            add(severity, remark.identifier, remark)
    return (*notices, *_of_figures(case))


def _reason_of(case: CaseResult) -> str:
    """Reason where the solver gives none; of an answer that is not verified also its origin."""
    words = WITHOUT_REASON[case.status]
    ended = [record for record in case.solution.programs if record.status in BROKEN]
    if case.status is not Status.NOT_VERIFIED or not ended:
        return words
    first = ended[0]
    what = BROKEN[first.status]
    return f"{words}: {what} in program {first.program} ({first.kind}), and what another found instead does not hold"


def _of_figures(case: CaseResult) -> list[Notice]:
    """What the figures show: states and a factor of safety that are claimed but not verified."""
    name, solution, checks = case.load_case.name, case.solution, case.checks
    texts = []
    if solution.least is not None and checks.least_load_factor != checks.least_load_factor:
        texts.append(("least-not-verified", "a state of a lower load factor was found but is not verified"))
    if solution.torsion is not None and checks.torsion_load_factor != checks.torsion_load_factor:
        texts.append(("torsion-not-verified", "the state with torsion of uniform pressure is not verified"))
    if solution.further.geometric_safety is not None and not solution.further.geometric_safety.verified:
        texts.append(("geometric-safety-not-verified", "the geometric factor of safety was found but is not verified"))
    return [Notice("warning", identifier, f"{name}: {text}", name) for identifier, text in texts]


FAR_APART = 1e6
"""Ratio of loads, or of strength and loads, from which it is reported as the cause."""

LINE = 1e-9
"""Width of an interface over its length below which it is a line, and its length is what counts."""

NOT_SETTLED = (Status.APPROXIMATE, Status.NOT_VERIFIED, Status.ITERATION_LIMIT, Status.NUMERICAL_ERROR)


def magnitude_notices(model: Model, contacts: Contacts, case: CaseResult, *, doubtful: bool) -> list[Notice]:
    """What lies too far apart in a case that is not settled, and a load factor that is rounding.

    doubtful : solved, but forces and velocities violate the law by more than they should
    """
    if not len(model.free) or not np.any(case.load_case.live_load[model.free]):
        return []
    name = case.load_case.name
    notices = []
    if case.status in NOT_SETTLED or doubtful:
        limits = yield_limits(model, contacts)
        scale = load_scale(model, contacts, case.load_case, limits)
        words = [*_loads(scale.own), *_strength(limits.cohesion + limits.tension, scale.mean)]
        words += [*_slender(contacts, limits.friction, scale.arms), *_scant(limits.friction)]
        text = f"{name}: {' and '.join(words)}: beyond what sixteen digits hold apart"
        notices += [Notice("warning", "magnitudes-far-apart", text, name)] if words else []
    rounding = rounding_of(model, case)
    if rounding > 0.0:
        text = f"{name}: the load factor is zero to the accuracy of forces and joints, about {rounding:.1e}"
        notices.append(Notice("notice", "load-factor-rounding", text, name))
    return notices


def rounding_of(model: Model, case: CaseResult) -> float:
    """What the rounding of forces, or elastic joints, mean for a load factor close to zero; 0 where it does not matter.

    Negligible relative to dead over live load, of the blocks that move where the others are heavier.
    """
    mechanics, free = case.solution.mechanics, model.free
    dead, live = case.load_case.dead_load[free], case.load_case.live_load[free]
    valued = case.status in (Status.SOLVED, Status.APPROXIMATE) and mechanics is not None
    if not valued or mechanics is None or not dead.any() or not live.any():
        return 0.0
    sizes, u = model.blocks.sizes[free], mechanics.mechanism[free]
    own = load_sizes(dead, sizes)
    moved = float(own @ (np.linalg.norm(u[:, :3], axis=1) + sizes * np.linalg.norm(u[:, 3:], axis=1)))
    unit = min(moved, float(np.linalg.norm(own) / np.linalg.norm(load_sizes(live, sizes))))
    if abs(mechanics.load_factor) >= NEAR_ZERO * unit:
        return 0.0
    return (NEAR_ZERO if case.by_path else PROVED_RESIDUAL) * unit


def _loads(own: FloatArray) -> list[str]:
    loads = own[own > 0]
    ratio = float(loads.max() / loads.min()) if len(loads) else 1.0
    return [f"loads of blocks lie {ratio:.0e} apart"] if ratio > FAR_APART else []


def _strength(strength: FloatArray, mean: float) -> list[str]:
    ratio = float(strength.max(initial=0.0)) / mean
    return [f"a joint is {ratio:.0e} times as strong as the mean load of a block"] if ratio > FAR_APART else []


def _scant(friction: FloatArray) -> list[str]:
    least = float(friction[friction > 0].min(initial=np.inf))
    return [f"friction of {least:.0e} is negligible relative to the normal forces"] if least * FAR_APART < 1.0 else []


def _slender(contacts: Contacts, friction: FloatArray, arms: FloatArray) -> list[str]:
    """Friction times the lever arm of the lesser block over half the width of an interface, where that is large.

    arms : (n_blocks,); of the ground, which does not tip, there is none
    """
    if not len(contacts):
        return []
    start, here = contacts.point_start[:-1], contacts.interface_of_point
    offsets = contacts.points - contacts.centroids[here]
    plane = np.einsum("pjx,px->pj", contacts.frames[:, 1:], offsets)
    moments = (
        np.add.reduceat(plane[:, :, None] * plane[:, None, :], start) / np.diff(contacts.point_start)[:, None, None]
    )
    least, greatest = np.sqrt(np.maximum(np.linalg.eigvalsh(moments), 0.0)).T
    width = np.where(least > LINE * greatest, least, greatest)  # corners of a rectangle a x b: a/2 and b/2
    bodies = bodies_of_points(contacts)[start]
    arm = np.append(arms, np.inf)[np.minimum(bodies, len(arms))].min(axis=1)
    mu = friction[start]
    known = (width > 0) & np.isfinite(mu * arm)
    ratio = float((mu[known] * arm[known] / width[known]).max(initial=0.0))
    words = f"sliding on an interface takes {ratio:.0e} times the push that tips a block on it"
    return [words] if ratio > FAR_APART else []


NOT_CHECKED = (
    "that the history is that of the loading was not checked: mbla verify --again follows paths of elastic joints anew"
)

NOT_FOLLOWED = "that the rows of a pushover are those of its way was not checked: mbla verify --again follows it anew"


def not_checked(results: Results) -> tuple[str, ...]:
    """That paths of elastic joints were not followed anew, where there are any."""
    found = results.paths_again is None and any(case.by_path for case in results.cases)
    return (NOT_CHECKED,) * found


def not_followed(results: Results) -> tuple[str, ...]:
    """That pushovers were not followed anew, where there are any."""
    pushed = (case.solution.further.pushover.rows is not None for case in results.cases)
    return (NOT_FOLLOWED,) * (results.pushovers_again is None and any(pushed))


def remarks_of_run(cases: Sequence[CaseResult]) -> tuple[str, ...]:
    """Remarks that are not verified, with the load cases that they are on, an identifier each."""
    rows: dict[str, list[str]] = {}
    for case in cases:
        for remark in case.solution.remarks:
            if remark.identifier not in FOUND_AGAIN:
                rows.setdefault(remark.identifier, []).append(case.load_case.name)
    return tuple(
        f"the remark {identifier} is not verified ({', '.join(dict.fromkeys(names))})"
        for identifier, names in rows.items()
    )
