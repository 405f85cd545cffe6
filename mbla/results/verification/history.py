"""``mbla verify --again``: whether the history in a file is that of the loading, by paths followed anew from its deck.

They begin at the stress-free assembly and have other steps. Where the file has load factors for joints of other
stiffnesses in shear, paths of such joints must come to them again; plain verification holds them against the state.
Where it has none, a path of another stiffness must come near its state. Where that does not, or does not show its
greatest load, one of the same stiffness tells a history that is another from a stiffness that decides. What is
approximate is to be carried, no more.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.deck import Deck
from mbla.model import Model
from mbla.program.build import build_program
from mbla.results.listing.history_words import path_words
from mbla.results.outcome import apart, ratio_of, result_of
from mbla.results.results import CaseResult, PathAgain
from mbla.results.verification.asked import ANSWERS, SAME_ROW, Found
from mbla.solution.flow.path_record import UNENDED, Stop
from mbla.solution.flow.settings import second_ratio
from mbla.solution.nonassociative.by_stiffness import SAME
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.solution import Status
from mbla.solution.solve import solve

STEPS = 0.6
"""Length of steps over that of a run: no fraction by which both would come to the same states."""

BY_STEPS = 0.01
"""Share by which steps may move a load factor: mostly they do by 0.1 to 0.5 per cent."""


def paths_again(deck: Deck, assembly: Assembly, case: CaseResult) -> tuple[PathAgain, ...]:
    """The paths that are followed anew, beside the figures of the file; none where it has no path.

    case : with checks and status recomputed
    """
    own, model = result_of(case), assembly.model.of_case(case.load_case)
    if own is None or not case.by_path:
        return ()

    def beside(ratio: float, of: float, in_file: float, allowed: float) -> PathAgain:
        again, seen = _load_factor(deck, assembly, case, ratio)
        off = apart(model, case.load_case, again, in_file)
        carried = case.status is Status.APPROXIMATE and off <= allowed
        again, off = (again, off) if seen or carried else (math.nan, math.nan)
        return PathAgain(case.load_case.name, ratio, again, of, in_file, off, allowed, off <= allowed)

    rows = [row for row in case.solution.path_by_stiffness if not math.isnan(row.load_factor)]
    if rows:
        return tuple(beside(row.ratio, row.ratio, row.load_factor, BY_STEPS) for row in rows)
    shown = round(ratio_of(own), 6)
    found = beside(second_ratio(shown), shown, own.load_factor, SAME)
    carried = case.status is Status.APPROXIMATE and found.load_factor >= own.load_factor
    if found.agrees or carried:
        return (replace(found, agrees=True),)
    same = beside(shown, shown, own.load_factor, BY_STEPS)
    return (same,) if math.isnan(found.load_factor) else (found, same)


def _load_factor(deck: Deck, assembly: Assembly, case: CaseResult, ratio: float) -> tuple[float, bool]:
    """What the path of joints with a ratio of stiffness reaches, nan for nothing, and whether that is all."""
    settings = settings_for(case.load_case, solver_settings(deck.analysis))
    path = settings.analysis.path.model_copy(update={"ratio": ratio})
    analysis = settings.analysis.model_copy(update={"path": path, "accuracy": "standard"})
    settings = replace(settings, analysis=analysis, steps=STEPS, search=0.0, torsion=False, standing=False)
    program = build_program(assembly, case.load_case, analysis)
    found = solve(program, settings)
    if found.status is Status.UNBOUNDED:
        return math.inf, True
    if found.mechanics is None:
        return math.nan, False
    if found.status is not Status.SOLVED and not math.isclose(ratio_of(found.mechanics), ratio, rel_tol=SAME_ROW):
        own = next((row.load_factor for row in found.path_by_stiffness if row.ratio == ratio), math.nan)
        return own, not math.isnan(own)  # the state is that of joints of another stiffness
    unended = found.status is not Status.SOLVED and found.path_end == Stop.FAR and found.path_gain > UNENDED
    return found.mechanics.load_factor, found.path_end in ANSWERS and not unended


def held_against_paths(found: Found, model: Model, case: CaseResult, paths: Sequence[PathAgain]) -> None:
    """Where paths that were followed anew do not come to what the file has, added to what was found of a case.

    A figure to which joints of the same stiffness lead, and others do not, is not confirmed; nor is one beside which a
    path does not show its greatest load.
    """
    confirmed = any(path.agrees and path.ratio == path.ratio_in_file for path in paths)
    for path in paths:
        by_stiffness = confirmed and path.ratio != path.ratio_in_file
        if not path.agrees:
            unconfirmed = by_stiffness or math.isnan(path.load_factor)
            where = found.unconfirmed if unconfirmed else found.differences
            where.append(path_words(model, case.load_case, path))
