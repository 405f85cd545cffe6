"""The greatest uniform pressure in all joints, as of water, that is carried with the dead load.

Effective forces x obey the joint laws; n is the area of each contact point, as a normal force::

    max p   subject to   A x + d + p A n = 0

At p = 0 it is the dead load alone. Where that is not carried p is negative: what must press the joints together. So p
passes smoothly through zero, which no multiple of a live load does, and its slope by a parameter is known on both
sides. The program starts from a pressure −P at which it stands, so that its load factor is P + p over a unit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.deck.sections.analysis import AnalysisSection
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.further.geometric_safety.reference_pressure import pressed_by, unit_of_pressure
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.sequence.sequence import analysed
from mbla.solution.settings import solver_settings
from mbla.solution.solution import WITH_VALUE, Checks, Solution, Status

FIRST_PRESSURE = 100.0
"""Reference pressure that is tried first, in units: most structures stand under it"""
MOST_PRESSURE = 1e8
"""Reference pressure beyond which no pressure makes the structure stand"""


@dataclass(frozen=True)
class JointPressure:
    """What was found; pressures in units of dead load per area of joints.

    posed   : the structure under the reference pressure, whose live load takes it away
    status  : that of its load case, no better than its verification confirms
    reference_pressure : in all joints
    unit    : of pressure, in the deck's
    solves  : of programs until one stood
    """

    posed: LoadedAssembly
    solution: Solution
    checks: Checks
    status: Status
    reference_pressure: float
    unit: float
    solves: int

    @property
    def value(self) -> float:
        """The pressure; nan where it is not known, −∞ where no pressure makes it stand, ∞ where none brings it down."""
        if self.status is Status.NO_EQUILIBRIUM:
            return -np.inf
        if self.status is Status.UNBOUNDED:
            return np.inf
        mechanics = self.solution.mechanics
        if mechanics is None or self.status not in WITH_VALUE:
            return np.nan
        return mechanics.load_factor - self.reference_pressure

    @property
    def bounds(self) -> tuple[float, float]:
        """What is proved of it."""
        return self.checks.static_bound - self.reference_pressure, self.checks.kinematic_bound - self.reference_pressure


def joint_pressure(structure: LoadedAssembly, analysis: AnalysisSection, log: Log | None = None) -> JointPressure:
    """The greatest pressure for the dead load of a load case, by associative flow."""
    own = analysis.model_copy(update={"flow_rule": "associative", "standing": False, "scheme": "auto"})
    settings, unit = solver_settings(own), unit_of_pressure(structure)
    reference_pressure, solves = FIRST_PRESSURE, 0
    while True:
        posed = pressed_by(structure, reference_pressure, unit)
        found, solves = analysed(posed.assembly, posed.load_case, settings, log), solves + 1
        if found.status is not Status.NO_EQUILIBRIUM or reference_pressure >= MOST_PRESSURE:
            return JointPressure(posed, found.solution, found.checks, found.status, reference_pressure, unit, solves)
        reference_pressure *= 10.0
