"""The cheapest capacities of ties: found by one cone program of all load cases, and what its mechanisms prove.

By associative flow: without dilatancy a structure needs more, which the analysis of the strengthened one shows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.program.strengthening import StrengtheningForm, strengthened_case, strengthening_form
from mbla.solution.cone_solvers.choice import cone_solver, interior_point_method, other_method
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.further.strengthening.strengthening import Cheapest, Strengthening
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.verification.strengthening import proved_least_cost

NEGLIGIBLE = 1e-6
"""Capacity over the greatest, and over the mean load of a block, that is rounding of the program."""


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
    velocities, forces = form.velocities(solution.x), form.forces(solution.z)
    motions = [case.motion(own) for case, own in zip(form.cases, velocities, strict=True)]
    carried = [case.program.scaling.forces(own) for case, own in zip(form.cases, forces, strict=True)]
    least = proved_least_cost(strengthening, motions, carried)
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
