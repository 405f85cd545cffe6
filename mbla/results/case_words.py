"""The section of one load case in the listing: how it collapses, how well that is known, where the forces go."""

from __future__ import annotations

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.figure_words import figures
from mbla.results.force_words import force_range_lines, lock_lines, reaction_lines
from mbla.results.mechanics import power_shares
from mbla.results.mechanism_words import certificate_lines, mechanism_lines, mechanism_summary
from mbla.results.outcome import result_of
from mbla.results.path_words import path_lines
from mbla.results.program_words import program_lines
from mbla.results.results import CaseResult
from mbla.results.text import heading, sentence
from mbla.results.verdict_words import bound_words, known_words, verdict
from mbla.solution.solution import Mechanics


def case_lines(model: Model, contacts: Contacts, case: CaseResult) -> list[str]:
    """The section of one load case."""
    solution = case.solution
    mechanics = solution.mechanics
    says = verdict(model, case)
    if mechanics is not None:
        says += f"{_mechanism_label(case)}: {mechanism_summary(model, contacts, mechanics)}"
    lines = heading(f"Load case {case.load_case.name}") + sentence(says + ".")
    texts = (solution.reason, bound_words(model, case), *known_words(model, case))
    lines += [line for text in texts for line in sentence(text)]
    if mechanics is None and solution.certificate is not None:
        lines += certificate_lines(model, solution.certificate)
    lines += ["", *figures(model, case)]
    if mechanics is not None:
        lines += ["", *mechanism_lines(model, contacts, mechanics)]
        lines += _power(model, case.load_case, mechanics)
        lines += reaction_lines(model, contacts, case.load_case, mechanics)
        if solution.force_ranges is not None:
            lines += force_range_lines(model, contacts, mechanics, solution.force_ranges)
    if mechanics is None and solution.lock is not None:
        lines += lock_lines(model, contacts, solution.lock)
    return lines + path_lines(model, case) + program_lines(solution)


def _mechanism_label(case: CaseResult) -> str:
    return "" if result_of(case) is not None else "; its mechanism, for what it is worth"


def _power(model: Model, load_case: LoadCase, mechanics: Mechanics) -> list[str]:
    """Where the power of the live load goes."""
    shares = power_shares(model, load_case, mechanics)
    if shares.live <= 0:
        return []
    powers = (-shares.dead, shares.friction, shares.joints)
    lifted, friction, joints = (round(100 * power / shares.live, 1) + 0.0 for power in powers)
    text = f"Of the power of the live load {lifted:.1f} % goes into the dead load, {friction:.1f} % into friction"
    rest = f", {joints:.1f} % into the joints' normal forces" if joints else ""
    return sentence(text + rest + ".")
