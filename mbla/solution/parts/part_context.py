"""What every step on a part of a structure is given."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import StressFreeStates


@dataclass(frozen=True)
class PartContext:
    """Settings, and what parts of one structure have in common.

    log        : called once per iteration of a cone program, as it goes
    interfaces : of the model that have a law of their own in the path of elastic joints
    beside     : those in a second path, with torsion
    states     : of stress-free assemblies that are known from other load cases, to which those of this one are added;
                 None where none are kept
    """

    settings: SolverSettings
    log: Log
    interfaces: Interfaces = NONE
    beside: Interfaces = NONE
    states: StressFreeStates | None = None
