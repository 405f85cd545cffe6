"""One load case with conditions on interfaces through the solver stage."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.build import CaseProgram
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.resultants.convex_associative import ConvexAssociative, solve_convex_associative
from mbla.solution.resultants.of_interfaces import convex_mechanics, of_interfaces, torsion_of_interfaces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Solution, Status
from mbla.solution.solve import recorded, solve_parts
from mbla.solution.standing.claim import as_it_stands
from mbla.solution.standing.standing import assess_dead_load, standing_without_equilibrium


def solve_with_interfaces(program: CaseProgram, settings: SolverSettings, log: Log | None = None) -> Solution:
    """Load factor of one load case with conditions on interfaces, by the flow rule of the analysis.

    Other flow than associative follows the path of elastic joints whose interfaces have these laws, on the programs of
    the contact points; associative flow says first whether there is equilibrium, and bounds its load factor.

    log : called once per iteration of a cone program, as it goes
    """
    convex = program.convex
    assert convex is not None
    associative = solve_convex(convex, settings, log)
    decided = associative.associative is not None or associative.status is Status.UNBOUNDED
    if settings.analysis.flow_rule == "associative" or not decided:
        return associative
    model, contacts, analysis = program.bodies.model, program.bodies.contacts, settings.analysis
    twisting = TwistingInterfaces.of(model, contacts)
    crushing = CrushingInterfaces.of(model, contacts) if associative.stress_blocks else None
    own = Interfaces(crushing, twisting if analysis.contact_model == "convex" else None)
    beside = Interfaces(crushing, twisting) if settings.by_torsion else NONE
    found = solve_parts(program.reduced, settings, log, own, beside)
    return _together(program, associative, found)


def _together(program: CaseProgram, associative: Solution, path: Solution) -> Solution:
    """The path with what associative flow says, of conditions on interfaces.

    Where associative flow bears every multiple of the live load and the path does not say otherwise, so it is.
    """
    if associative.status is Status.UNBOUNDED and path.status is Status.UNBOUNDED:
        return associative
    convex, count = program.convex, len(associative.programs)
    assert convex is not None
    mechanics, torsion = path.mechanics, path.torsion
    at_points = [replace(record, program=count + record.program, kind=_kind(record)) for record in path.programs]
    doubted = associative.associative is not None and associative.status is not Status.SOLVED
    return replace(
        path,
        status=associative.status if doubted and path.status is Status.SOLVED else path.status,
        reason=path.reason or associative.reason,
        mechanics=None if mechanics is None else of_interfaces(convex, mechanics, path.flow_rule),
        torsion=None if torsion is None else torsion_of_interfaces(program, torsion),
        associative=associative.associative,
        certificate=None,
        lock=associative.lock,
        contact_model=associative.contact_model,
        stress_blocks=associative.stress_blocks,
        programs=(*associative.programs, *at_points),
        iterations=(
            *associative.iterations,
            *(replace(each, program=count + each.program) for each in path.iterations),
        ),
        seconds=associative.seconds + path.seconds,
    )


def _kind(record: ProgramRecord) -> str:
    """What a program of the contact points is for, besides those of the interfaces."""
    return f"{record.kind}, points" if record.kind in ("associative", "reverse") else record.kind


def solve_convex(convex: ConvexProgram, settings: SolverSettings, log: Log | None = None) -> Solution:
    """Load factor of one load case by associative flow, or why there is none.

    log : called once per iteration of a cone program, as it goes
    """
    started, (iterations, record) = time.perf_counter(), recorded(log)
    associative = solve_convex_associative(convex, settings, record)
    mechanics = None
    if associative.state is not None:
        mechanics = convex_mechanics(convex, associative.state, convex.points.limits.friction)
    certificate, motions = _certificate(convex, associative)
    solution = Solution(
        flow_rule=settings.analysis.flow_rule,
        status=associative.status,
        mechanics=mechanics if settings.analysis.flow_rule == "associative" else None,
        associative=mechanics,
        certificate=certificate,
        reason=associative.reason,
        programs=associative.programs,
        iterations=(),
        seconds=0.0,
        certificate_motions=motions,
        contact_model=convex.contact_model,
        stress_blocks=bool(len(convex.crushing.interfaces)),
        solver=settings.solver,
        lock=None
        if associative.lock is None
        else convex.points.scaling.forces(associative.lock) / convex.points.scaling.live,
    )
    if settings.standing:
        solution = _with_standing(convex, solution)
    return replace(solution, iterations=tuple(iterations), seconds=time.perf_counter() - started)


def _with_standing(convex: ConvexProgram, solution: Solution) -> Solution:
    """The standing of the blocks on their contact points; torsion of interfaces is left out."""
    if solution.certificate is not None:
        velocities = convex.points.velocities(solution.certificate)
        return replace(solution, standing=standing_without_equilibrium(convex.points, velocities))
    decided = solution.associative is not None or solution.status is Status.UNBOUNDED
    standing = assess_dead_load(convex.points, True if decided else None)
    return replace(as_it_stands(solution, standing.verdict), standing=standing)


def _certificate(convex: ConvexProgram, result: ConvexAssociative) -> tuple[FloatArray | None, FloatArray | None]:
    """Motion of the blocks, largest entry 1, and the motions of the interfaces that belong to it."""
    if result.velocities is None or result.motions is None:
        return None, None
    scaling = convex.points.scaling
    motion = convex.points.mechanism(result.velocities)
    size = max(float(np.abs(motion).max(initial=0.0)), 1e-300)
    return motion / size, scaling.live / scaling.force * result.motions / size
