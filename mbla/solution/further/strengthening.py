"""The cheapest capacities of ties: found by one cone program of all load cases, and what its mechanisms prove.

By associative flow: without dilatancy a structure needs more, which the analysis of the strengthened one shows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_blocks
from mbla.model.model import LoadCase, Model
from mbla.model.ties.moved import elongations
from mbla.program.strengthening import StrengtheningForm, strengthened_case, strengthening_form
from mbla.solution.cone_solvers.choice import cone_solver, interior_point_method, other_method
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.verification.case import Case

NEGLIGIBLE = 1e-6
"""Capacity over the greatest, and over the mean load of a block, that is rounding of the program."""


@dataclass(frozen=True)
class Requirement:
    """A load case and the load factor that it has to carry."""

    load_case: LoadCase
    load_factor: float


@dataclass(frozen=True)
class Cheapest:
    """Answer of the program.

    status     : SOLVED, or why there are no capacities: NO_EQUILIBRIUM where none suffice
    capacities : (k,) N
    use        : (k,) worth of a candidate over its cost: 1 of those that are used
    cost       : of the capacities
    least_cost : proved by the mechanisms: no capacities cost less by associative flow; nan where they prove nothing
    """

    status: Status
    capacities: FloatArray
    use: FloatArray
    cost: float
    least_cost: float
    reason: str = ""


@dataclass(frozen=True)
class Strengthening:
    """What may be added to a structure.

    assembly : with candidates behind its own ties, whose number is ``first``
    costs : (k,) of a unit of capacity; most : (k,) greatest capacity, N
    """

    assembly: Assembly
    first: int
    costs: FloatArray
    most: FloatArray
    requirements: tuple[Requirement, ...]
    settings: SolverSettings
    log: Log

    @property
    def model(self) -> Model:
        """With its candidates."""
        return self.assembly.model

    def _with_ties(self, rows: IntArray) -> Assembly:
        """Some of its ties alone, (n,)."""
        return replace(self.assembly, model=replace(self.model, ties=self.model.ties.take(rows)))

    def asking(self, factors: Mapping[str, float]) -> Strengthening:
        """The same with other load factors required, by load case."""
        return replace(
            self,
            requirements=tuple(replace(each, load_factor=factors[each.load_case.name]) for each in self.requirements),
        )

    def take(self, rows: IntArray) -> Strengthening:
        """The same with some of the candidates, (n,)."""
        chosen = self._with_ties(np.concatenate([np.arange(self.first), self.first + rows]))
        return replace(self, assembly=chosen, costs=self.costs[rows], most=self.most[rows])

    @property
    def without_candidates(self) -> Assembly:
        """As it is."""
        return self._with_ties(np.arange(self.first))

    @property
    def unit(self) -> float:
        """Of force: mean dead load of a free block of the first case, or live load where there is none."""
        case = self.requirements[0].load_case
        for load in (case.dead_load, case.live_load):
            sizes = np.linalg.norm(load[self.model.free, :3], axis=1)
            if sizes.any():
                return float(sizes[sizes > 0].mean())
        return 1.0


def cheapest(strengthening: Strengthening) -> Cheapest:
    """The cheapest capacities with which all requirements are met by associative flow."""
    unit, scale = strengthening.unit, float(strengthening.costs.mean())
    count = len(strengthening.costs)
    cases = [
        strengthened_case(
            strengthening.assembly.of(each.load_case),
            each.load_case,
            each.load_factor,
            strengthening.first,
            count,
            unit,
        )
        for each in strengthening.requirements
    ]
    costs, most = strengthening.costs / scale, strengthening.most / unit
    form = strengthening_form(cases, costs, most)
    solution = _solved(form, strengthening)
    none = np.zeros(count)
    if solution.status not in WITH_VALUE:
        reason = f"the program was not solved: {solution.shortfall}"
        if solution.status is Status.NO_EQUILIBRIUM:
            reason = "no capacities of these candidates suffice: a mechanism does not stretch them enough"
            if np.isfinite(strengthening.most).any():
                reason += ", up to their greatest capacities"
        return Cheapest(solution.status, none, none, np.nan, np.nan, reason)
    capacities = unit * form.capacities(solution.z)
    capacities[capacities <= NEGLIGIBLE * capacities.max(initial=unit)] = 0.0
    cost = float(capacities @ strengthening.costs)
    least = proved_least_cost(strengthening, form, solution)
    return Cheapest(solution.status, capacities, form.use(solution.x), cost, least)


def _solved(form: StrengtheningForm, strengthening: Strengthening) -> ConeSolution:
    """By the method that takes such a program, or the other one where that breaks down."""
    program, settings, log = form.cone_program, strengthening.settings, strengthening.log
    solution = cone_solver(program, settings, log).solve(1, -1.0)
    if solution.status is Status.NUMERICAL_ERROR:
        other = replace(settings, solver=other_method(interior_point_method(program, settings.solver)))
        again = cone_solver(program, other, log).solve(1, -1.0)
        solution = solution if again.status is Status.NUMERICAL_ERROR else again
    return solution


def proved_least_cost(strengthening: Strengthening, form: StrengtheningForm, solution: ConeSolution) -> float:
    """What capacities cost at least by associative flow, from the mechanisms alone; nan where they prove nothing.

    Virtual work: loads that do more work than the joints dissipate need ties that take the rest, and what these take is
    no more than their capacities times the elongations; see :mod:`mbla.program.strengthening`. Rounding by which joints
    close is charged with twice the largest normal force.
    """
    unit = strengthening.unit * float(strengthening.costs.mean())
    gain, stretched = 0.0, np.zeros(len(strengthening.costs))
    forces, without = form.forces(solution.z), strengthening.without_candidates
    for number, (each, case) in enumerate(zip(strengthening.requirements, form.cases, strict=True)):
        motion = case.motion(form.velocities(solution.x)[number])
        joints = without.of(each.load_case)
        judged = Case(joints.model, joints.contacts, joints.load_case(each.load_case))
        dissipated, lack = judged.dissipation((motion, None))
        dead, live = judged.powers(motion)
        largest = 2.0 * float(np.abs(case.program.scaling.forces(forces[number])[:, 0]).max(initial=0.0))
        gain += unit * (dead + each.load_factor * live - dissipated - largest * lack)
        on_blocks = motions_of_blocks(joints, motion)
        longer = elongations(strengthening.model.blocks, strengthening.model.ties, on_blocks)[strengthening.first :]
        stretched += unit * np.maximum(longer, 0.0)
    limited = np.isfinite(strengthening.most)
    size = float((stretched / strengthening.costs)[~limited].max(initial=1.0 if limited.any() else 0.0))
    if not size > 0.0:
        return 0.0
    over = np.maximum(stretched / size - strengthening.costs, 0.0)[limited]
    return max(float(gain / size - strengthening.most[limited] @ over), 0.0)
