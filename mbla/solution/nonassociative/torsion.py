"""The load at which a structure in space starts to move where torsion of its interfaces is that of uniform pressure.

Contact points at the corners of an interface overstate its torsion: pressed alike they resist a twist at the greatest
arm there is. A second path, with the torsion of uniform pressure (:mod:`mbla.solution.law.torsion_interfaces`), tells
how much of the load factor hangs on that.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.program.program import Program
from mbla.program.resultants.twisting_interfaces import twisting_of
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.path_of_part import path_of_part
from mbla.solution.flow.path_record import Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.state_of_path import path_with_state, state_of_path
from mbla.solution.law.interfaces import Interfaces
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.settings import SolverSettings


@dataclass(frozen=True)
class WithTorsion:
    """Why the path of a part with torsion of uniform pressure ended, and its state; None where it has none."""

    stop: Stop
    state: CollapseState | None


def solve_with_torsion(
    program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log, interfaces: Interfaces
) -> WithTorsion | None:
    """The state at the greatest load of that path; None where no interface of the program can twist.

    interfaces : of the model that have a law of their own, torsion among them
    """
    if interfaces.twisting is None or twisting_of(program, interfaces.twisting) is None:
        return None
    wanted = replace(PathSettings.of(settings), again=False)
    found, state = path_with_state(
        program,
        lambda extent: path_of_part(program, associative, wanted, interfaces=interfaces, extent=extent),
        lambda path: state_of_path(program, path, settings, log, interfaces),
        interfaces,
    )
    return WithTorsion(found.stop, state)
