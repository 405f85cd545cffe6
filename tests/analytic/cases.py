"""Load cases of a deck of the repository, with values of the deck changed, solved and verified."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mbla.assembly.assembly import Assembly
from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.deck.content import Expectation
from mbla.model import build_model
from mbla.program import assemble
from mbla.solution.proof.claim import with_proof
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.solve import solve_parts
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.decks.folder import BENCHMARKS
from tests.line import unreduced

ASSOCIATIVE = "analysis.flow_rule=associative"


@dataclass(frozen=True)
class Answer:
    """One load case; ``expected`` follows the deck's parameters where it is an expression."""

    name: str
    expected: Expectation
    solution: Solution
    checks: Checks
    status: Status

    @property
    def load_factor(self) -> float:
        """By the deck's flow rule; the case must be solved and verified."""
        assert self.status is Status.SOLVED, (self.name, self.status, self.solution.reason, self.checks.failures)
        assert self.solution.mechanics is not None
        return self.solution.mechanics.load_factor

    @property
    def associative(self) -> float:
        """By associative flow."""
        assert self.solution.associative is not None, (self.name, self.status, self.solution.reason)
        return self.solution.associative.load_factor


def answers(deck: str, *overrides: str) -> Iterator[Answer]:
    """Answers of all load cases of a benchmark deck."""
    read = read_deck(BENCHMARKS[deck], overrides)
    model = build_model(read)
    contacts = find_contacts(model, read.contacts)
    for load_case in model.load_cases:
        reduced = unreduced(assemble(model, contacts, load_case), contacts)
        solution = with_proof(model, contacts, load_case, solve_parts(reduced, solver_settings(read.analysis)))
        checks = verify(Assembly(model, contacts), load_case, solution)
        expected = read.content.expected[load_case.name]
        yield Answer(load_case.name, expected, solution, checks, verified_status(solution, checks))


def answer(deck: str, *overrides: str) -> Answer:
    """Answer of the only load case of a deck."""
    (only,) = answers(deck, *overrides)
    return only
