"""The two forms of the associative program, read alike: what ``solve_associative`` needs of either."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.program.program import Program
from mbla.program.static import associative_static_form
from mbla.solution.associative.force_repair import carried_loads
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.solution import Status

STATIC_SHARE = 0.01
"""On a wall of 410 blocks the static form was 4e-3 low at a tolerance of 1e-6, 5e-5 at 1e-8 and 3e-7 at 1e-10; the
kinematic form 6e-6, 1e-8 and 1e-10."""

LEAST_TOLERANCE = 1e-10
"""Smaller ones are out of the solver's reach."""


@dataclass(frozen=True)
class AssociativeForm:
    """A cone program whose optimum is the load factor.

    forces     : contact forces, (n_points, components), from a solution
    factor     : load factor that these forces carry, as far as the solution goes; in velocities that of the dual
                 program, which early in a run is far from the objective
    velocities : (n_rows,), of the mechanism or of a certificate
    reverse    : what ``ConeSolver.update`` gets to find the least load factor instead, negated
    read       : a solution with the load factor as its objective, and the status said of the structure
    sign       : of the load factor in the program's own objective
    share      : of the tolerance asked for that the solver is given
    exact      : false where a polyhedron stands for the friction cone: solutions prove nothing of the cone then
    """

    program: Program
    cone_program: ConeProgram
    forces: Callable[[ConeSolution], FloatArray]
    factor: Callable[[ConeSolution], float]
    velocities: Callable[[ConeSolution], FloatArray]
    reverse: Mapping[str, FloatArray]
    read: Callable[[ConeSolution], ConeSolution]
    sign: float
    share: float = 1.0
    exact: bool = True

    def in_units(self, unit: float) -> ConeProgram:
        """The program with the live power in units of the load factor given; only in velocities."""
        return replace(self.cone_program, rhs=self.cone_program.rhs / unit)

    @property
    def reversed_program(self) -> ConeProgram:
        """The program that finds the least load factor instead, negated."""
        cone_program = self.cone_program
        return replace(
            cone_program,
            cost=self.reverse.get("cost", cone_program.cost),
            rhs=self.reverse.get("rhs", cone_program.rhs),
        )

    @property
    def has_units(self) -> bool:
        """Whether ``in_units`` applies."""
        return "rhs" in self.reverse

    def tolerance(self, asked: float) -> float:
        """Tolerance for the solver where ``asked`` is asked of the load factor."""
        return max(self.share * asked, min(asked, LEAST_TOLERANCE))


def in_velocities(program: Program, facets: FloatArray | None = None) -> AssociativeForm:
    """Kinematic form; ``facets`` bound shear instead of cones."""
    form = kinematic_form(program, program.limits, facets=facets)
    return AssociativeForm(
        program=program,
        cone_program=form.cone_program,
        forces=lambda solution: form.contact_forces(solution.z),
        factor=lambda solution: -float(solution.z[0]),
        velocities=lambda solution: form.velocities(solution.x),
        reverse={"rhs": -form.cone_program.rhs},
        read=lambda solution: solution,
        sign=1.0,
        exact=facets is None or program.components == 2,
    )


def in_own_units(program: Program, forces: FloatArray) -> AssociativeForm | None:
    """Kinematic form with the equilibrium of lightly loaded blocks in units of what they carry; None without such.

    The solver's tolerance is one for all: a block that carries a hundred millionth of the others is lost in it.

    forces : (n_points, components) of a first solution, which need not be sharp
    """
    unit = np.clip(carried_loads(program, forces), LIGHTEST, 1.0)
    if not np.any(unit < LIGHT):
        return None
    rows = sp.diags_array(1.0 / unit)
    scaled = replace(
        program,
        equilibrium_matrix=sp.csr_array(rows @ program.equilibrium_matrix),
        dead_load=program.dead_load / unit,
        live_load=program.live_load / unit,
    )
    form = in_velocities(scaled)
    return replace(form, program=program, velocities=lambda solution: form.velocities(solution) / unit)


def in_forces(program: Program, facets: FloatArray | None = None) -> AssociativeForm:
    """Static form; ``facets`` bound shear instead of cones."""
    form = associative_static_form(program, facets)
    return AssociativeForm(
        program=program,
        cone_program=form.cone_program,
        forces=lambda solution: form.contact_forces(solution.x),
        factor=lambda solution: float(solution.x[-1]),
        velocities=lambda solution: form.velocities(solution.z),
        reverse={"cost": -form.cone_program.cost},
        read=_of_the_dual,
        sign=-1.0,
        share=STATIC_SHARE,
        exact=facets is None or program.components == 2,
    )


FORMS: Mapping[str, Callable[[Program, FloatArray | None], AssociativeForm]] = {
    "kinematic": in_velocities,
    "static": in_forces,
}
"""By the deck's word."""

LIGHT = 1e-2
"""Load of a block, in mean loads, below which its equilibrium deserves units of its own."""

LIGHTEST = 1e-12
"""Least unit of a block's equilibrium, in mean loads."""

_TURNED = {Status.UNBOUNDED: Status.NO_EQUILIBRIUM, Status.NO_EQUILIBRIUM: Status.UNBOUNDED}


def _of_the_dual(solution: ConeSolution) -> ConeSolution:
    """Where no forces are admissible there is no equilibrium; where λ has no upper bound there is no collapse."""
    return replace(solution, status=_TURNED.get(solution.status, solution.status), objective=-solution.objective)
