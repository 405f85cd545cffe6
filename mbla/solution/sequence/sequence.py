"""A load case of the deck by as many analyses as it takes: one, or several, each of which leads to the next.

What is asked says which: a tilting table goes from angle to angle, the least or greatest value of a force from one
reference to another, a settling support needs the reaction of the structure at rest. Each is a generator in a
file of its own, which yields load cases and gets them back solved and verified.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.program.build import build_program
from mbla.questions.angle import Angle
from mbla.questions.force import Force
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.sequence.at_rest import at_rest_alone
from mbla.solution.sequence.objective import end_of_force
from mbla.solution.sequence.settlement import settled
from mbla.solution.sequence.solved_case import AnalysisSequence, SolvedCase
from mbla.solution.sequence.tilting_table import tilting_table
from mbla.solution.settings import SolverSettings, settings_for
from mbla.solution.solve import solve
from mbla.solution.standing.standing import StressFreeStates
from mbla.solution.verification.verify import verify

Analysis = Callable[[LoadCase], SolvedCase]


def answered(
    assembly: Assembly,
    load_case: LoadCase,
    settings: SolverSettings,
    log: Log | None = None,
    states: StressFreeStates | None = None,
) -> SolvedCase:
    """The load case as it was posed last, solved and verified.

    settings : of the analysis that the deck asks for
    states   : of stress-free assemblies that are known from load cases before
    """
    states = StressFreeStates() if states is None else states
    if not load_case.has_load_factor:
        return at_rest_alone(assembly, load_case, settings, log, states)
    own, sequence = settings_for(load_case, settings), sequence_of(assembly, load_case, settings)
    answer = answer_of(sequence, lambda case: analysed(assembly, case, own, log, states))
    if not (settings.analysis.soil_range and assembly.model.soils and load_case.question.collapses):
        return answer
    from mbla.solution.further.soil_range.find import soil_range_of  # late: few decks ask for it

    found = soil_range_of(assembly, settings, lambda other, by: answered(other, load_case, by, log, states))
    further = replace(answer.solution.further, soil_range=found)
    return replace(answer, solution=replace(answer.solution, further=further))


def analysed(
    assembly: Assembly,
    load_case: LoadCase,
    settings: SolverSettings,
    log: Log | None = None,
    states: StressFreeStates | None = None,
) -> SolvedCase:
    """One analysis: the program of a load case solved and verified."""
    solution = solve(build_program(assembly, load_case, settings.analysis), settings, log, states)
    return SolvedCase(load_case, solution, verify(assembly, load_case, solution))


def sequence_of(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> AnalysisSequence:
    """What is to be analysed for a load case of the deck."""
    match load_case.question:
        case Angle(tilt):
            return tilting_table(assembly, load_case, tilt)
        case Force():
            return end_of_force(assembly, load_case, settings)
    return settled(assembly, load_case, settings)


def answer_of(sequence: AnalysisSequence, analyse: Analysis) -> SolvedCase:
    """The answer of a sequence whose load cases are analysed as it asks for them."""
    following: Callable[[], LoadCase] = partial(next, sequence)
    while True:
        try:
            case = following()
        except StopIteration as end:
            answer: SolvedCase = end.value
            return answer
        following = partial(sequence.send, analyse(case))
