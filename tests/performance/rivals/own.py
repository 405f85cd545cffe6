"""mbla itself, from the contacts to the verified answer, and what of that a rival does."""

from __future__ import annotations

from mbla.assembly.assembly import Assembly
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program import assemble
from mbla.program.reductions import Reduced, allowed_reductions, reduce_program
from mbla.solution.proof.claim import with_proof
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Solution
from mbla.solution.solve import solve_parts
from mbla.solution.standing.standing import assess_dead_load
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.performance.rivals.structure import Answer, Structure


def whole(structure: Structure) -> Answer:
    """As ``mbla run`` solves it: load factor, proved bounds, standing, verification."""
    return _answer(structure, structure.deck.analysis)


def standing(structure: Structure) -> Answer:
    """Only whether it stands from the stress-free assembly, which is what coupled rigid-block analysis asks."""
    reduced = _reduced(structure, structure.deck.analysis)
    found = [assess_dead_load(program, None) for program in reduced.parts]
    return Answer("stands: " + ", ".join(sorted({str(result.verdict) for result in found})))


def reference(structure: Structure) -> tuple[float, float]:
    """Static and kinematic bound as close as mbla proves them, whatever that takes."""
    analysis = structure.deck.analysis.model_copy(update={"accuracy": "reference", "standing": False})
    checks = _verified(structure, analysis)[1]
    return checks.static_bound, checks.kinematic_bound


def _answer(structure: Structure, analysis: AnalysisSection) -> Answer:
    solution, checks = _verified(structure, analysis)
    factor = None if solution.mechanics is None else solution.mechanics.load_factor
    residual = max(checks.equilibrium_residual, checks.yield_violation, checks.tension_violation)
    bounds = (checks.static_bound, checks.kinematic_bound)
    return Answer(str(verified_status(solution, checks)), factor, residual, bounds)


def _verified(structure: Structure, analysis: AnalysisSection) -> tuple[Solution, Checks]:
    model, contacts, load_case = structure.model, structure.contacts, structure.load_case
    found = solve_parts(_reduced(structure, analysis), solver_settings(analysis))
    solution = with_proof(model, contacts, load_case, found)
    return solution, verify(Assembly(model, contacts), load_case, solution)


def _reduced(structure: Structure, analysis: AnalysisSection) -> Reduced:
    model, contacts = structure.model, structure.contacts
    program = assemble(model, contacts, structure.load_case)
    return reduce_program(model, contacts, program, allowed_reductions(analysis), associative=True)
