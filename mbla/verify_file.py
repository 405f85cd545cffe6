"""``mbla verify``: every residual and bound recomputed from a result file alone, with no solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Notice
from mbla.exit_status import exit_code
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.rebuilt import differences_from_deck
from mbla.results.results import CaseResult, Results
from mbla.solution.contact_modes import contact_modes
from mbla.solution.glued import MOTIONS
from mbla.solution.solution import Checks, Mechanics
from mbla.solution.statics import contact_velocities
from mbla.solution.verification import verify
from mbla.solution.verify import SOLVED_RESIDUAL, dilatancy_of, verified_status

AGREEMENT = 1e-6
"""Difference of stored and recomputed figures, relative and absolute, beyond which the file is not what a run wrote;
sparse factorisations of another machine may round differently."""


MODES_OF = ("mechanics", "associative", "lower", "upper")
"""parts of a solution whose modes follow from their own forces and velocities"""


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # what is no number fulfils no condition
def verify_results(results: Results) -> tuple[Results, tuple[str, ...]]:
    """Results with checks, status and exit status recomputed, and where they disagree with what the file says."""
    from_deck, not_built = differences_from_deck(results)
    cases, disagreements = [], list(from_deck)
    for case in results.cases:
        model = results.model.of_case(case.load_case)
        checks = verify(model, results.contacts, case.load_case, case.solution)
        status = verified_status(case.solution, checks)
        name = case.load_case.name
        disagreements += [f"{name}: {text}" for text in _differences(case.checks, checks)]
        disagreements += [f"{name}: {text}" for text in _unproved(model, results.contacts, case, checks)]
        if status is not case.status:
            disagreements.append(f"{name}: the file says {case.status}, recomputed it is {status}")
        cases.append(replace(case, checks=checks, status=status))
    code = exit_code(cases)
    # 4: what was expected of the answers is not in the file's power, nor is what stopped a run
    if results.complete and results.exit_code not in (code, 4):
        disagreements.append(f"the exit status is {code} recomputed, the file says {results.exit_code}")
    if (disagreements or not results.complete) and code in (0, 5):
        code = 4
    notices = results.notices
    if not_built:
        text = f"the model was not built again from the deck in the file: {not_built}"
        notices = (*notices, Notice("notice", "deck-not-rebuilt", text))
    return replace(results, cases=tuple(cases), exit_code=code, notices=notices), tuple(disagreements)


def _differences(stored: Checks, recomputed: Checks) -> list[str]:
    found = []
    for name in (
        "static_bound",
        "kinematic_bound",
        "equilibrium_residual",
        "yield_violation",
        "tension_violation",
        "slip_residual",
        "peak_load_factor",
        "lower",
        "upper",
        "complementarity_residual",
        "penetration",
        "live_power",
        "power_balance",
        "gap",
    ):
        old, new = getattr(stored, name), getattr(recomputed, name)
        same = np.isclose(old, new, rtol=AGREEMENT, atol=AGREEMENT, equal_nan=True)
        if not same:
            found.append(f"{name.replace('_', ' ')} is {new:.6g} recomputed, the file says {old:.6g}")
    if stored.verified != recomputed.verified:
        found.append(f"the file says {_verified(stored)}, recomputed it is {_verified(recomputed)}")
    return found


def _verified(checks: Checks) -> str:
    return "verified" if checks.verified else "not verified"


def _unproved(model: Model, contacts: Contacts, case: CaseResult, checks: Checks) -> list[str]:
    """Figures of a case beside those of its verification that do not follow from what they must follow from."""
    found, associative = [], case.solution.associative
    if associative is not None:
        least, most = checks.static_bound, checks.kinematic_bound
        room = SOLVED_RESIDUAL * max(abs(most), abs(least))
        if associative.load_factor < least - room or associative.load_factor > most + room:
            found.append(
                f"the associative load factor {associative.load_factor:.8g} is not between its bounds {least:.8g} "
                f"and {most:.8g}"
            )
    for part in MOTIONS:
        mechanics = getattr(case.solution, part)
        if mechanics is None or mechanics.interface_motions is not None:
            continue
        velocities = contact_velocities(model, contacts, mechanics.mechanism)
        if _apart(velocities, mechanics.contact_velocities):
            found.append(f"contact velocities ({part}) are not those of the mechanism")
        if part in MODES_OF and not case.solution.sides and _other_modes(model, contacts, case, part, mechanics):
            found.append(f"contact modes ({part}) are not those of forces and velocities")
    return found


def _other_modes(model: Model, contacts: Contacts, case: CaseResult, part: str, mechanics: Mechanics) -> bool:
    """Whether modes are others than forces and velocities give under the flow rule of that part."""
    limits = yield_limits(model, contacts)
    flow_rule = "associative" if part == "associative" else case.solution.flow_rule
    slope = dilatancy_of(limits, flow_rule)
    modes = contact_modes(mechanics.contact_forces, mechanics.contact_velocities, limits, slope)
    return not np.array_equal(modes, mechanics.modes)


def _apart(one: FloatArray, other: FloatArray) -> bool:
    """Whether two arrays differ by more than rounding of the largest entry."""
    return not np.abs(one - other).max(initial=0.0) <= AGREEMENT * np.abs(one).max(initial=0.0)
