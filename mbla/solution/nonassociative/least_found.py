"""The state of the least load factor that fits the law of rigid joints, of those that a search finds.

Without dilatancy a structure has many states of rest: the path of elastic joints leads to the one of its loading from
the stress-free assembly. Others, of lower load factors, belong to other histories. Pairs of convex programs
(``alternation``) from the normal forces of the path, or of associative flow, come to an exact state within some hundred
iterations, or to none, and with a penalty on the load factor to lower ones, as long as their iterations are within
``analysis.search`` times those spent so far, or within some hundred.

That is no proof: the least of all is a problem that nobody solves with certainty (Ferris and Tin-Loi 2001,
doi:10.1016/S0020-7403(99)00111-3). Found are, of walls 1, 3 and 5 of theirs, 0.638982, 0.355817 and 0.207973, the least
that are known.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.polished import polished
from mbla.solution.nonassociative.search import Search
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord
from mbla.solution.thresholds import SOLVED_RESIDUAL


def looks_lower(program: Program, settings: SolverSettings, interfaces: Interfaces = NONE) -> bool:
    """Whether states of lower load factors are looked for: in the plane, in space where the deck says how far.

    In space contact points let a joint carry all its force at the one point about which it twists, where friction does
    no work: of a block that is twisted alone the least load factor is nothing. That belongs to the points, not to the
    structure, and is not looked for unasked. The reaction of a settling support is that of its path, and the
    programs of the search know points alone.

    interfaces : that have a law of their own
    """
    in_question = program.components == 2 or settings.analysis.search is not None
    by_points = interfaces is NONE and not program.facts.settling_support
    return settings.by_elastic_path and settings.search > 0.0 and in_question and by_points


def least_found(
    program: Program,
    slope: FloatArray,
    path: CollapseState,
    associative: AssociativeResult,
    settings: SolverSettings,
    log: Log,
    records: list[ProgramRecord],
) -> CollapseState | None:
    """The state of the least load factor that was found; None where the search came to none.

    slope   : (n_points,) tangent of the dilatancy angle
    path    : the state of the path of elastic joints
    records : gets a line for every program
    """
    start = associative.state
    search = Search(program, slope, settings, log, records, np.inf if start is None else start.load_factor)
    normals = [path.forces[:, 0]] if start is None else [path.forces[:, 0], start.forces[:, 0]]
    for normal in normals:
        near = search.approach(normal)
        if search.least_residual > SOLVED_RESIDUAL:
            search.descend(near)
        if search.least_residual <= SOLVED_RESIDUAL or search.over:
            break
    if search.answer is None or search.answer.residual > SOLVED_RESIDUAL:
        return None
    search.lower(normals[1:])
    return None if search.answer is None else polished(program, slope, search.answer)
