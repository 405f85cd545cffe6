"""Paths of elastic joints of small decks, for tests."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly import build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import LoadCase, select_cases
from mbla.program.build import build_program
from mbla.program.program import Program
from mbla.program.reductions import allowed_reductions, reduce_program
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.program.stiffness_shares import shares_of
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.path_of_part import PathOfPart, path_of_part
from mbla.solution.flow.settings import PathSettings
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.sequence.settlement import posed
from mbla.solution.settings import SolverSettings, solver_settings
from tests.asked import settlement_of
from tests.line import Line

SETTINGS = SolverSettings(tolerance=1e-8)
DEFAULT = PathSettings()


def reduced(line: Line) -> Program:
    """The program of the one part that is loaded, as it is solved without dilatancy."""
    switches = allowed_reductions(line.deck.analysis)
    parts = reduce_program(line.model, line.contacts, line.program, switches, associative=False).parts
    (program,) = (part for part in parts if np.any(part.live_load))
    return program


def path_of(
    line: Line, settings: PathSettings = DEFAULT, *, associative_flow: bool = False, interfaces: Interfaces = NONE
) -> PathOfPart:
    """Its path; with associative flow joints lift by their friction angle."""
    program = reduced(line)
    answer = solve_associative(program, SETTINGS, lambda record: None, stress_free=False)
    slope = program.limits.friction if associative_flow else None
    return path_of_part(program, answer, settings, slope, interfaces)


def load_factor_of(
    line: Line, settings: PathSettings = DEFAULT, *, associative_flow: bool = False, interfaces: Interfaces = NONE
) -> float:
    """Of the model."""
    found = path_of(line, settings, associative_flow=associative_flow, interfaces=interfaces)
    return float(line.program.scaling.live * found.load_factor)


def rest_of(line: Line, ratio: float = 0.4, interfaces: Interfaces = NONE) -> Gravity:
    """The structure under its dead load."""
    program = reduced(line)
    return gravity_step(ElasticJoints.of(program, shares_of(program), ratio, interfaces=interfaces.rows_of(program)))


def stress_blocks(line: Line, strength: float | None = None) -> Interfaces:
    """Its interfaces crush as their joint law says; or all alike with a strength, where they are not in pieces."""
    if strength is None:
        return Interfaces(CrushingInterfaces.of(line.model, line.contacts))
    every = np.full(len(line.contacts), strength)
    return Interfaces(CrushingInterfaces.with_strengths(line.contacts, every, 0.0 * every))


def torsion(line: Line) -> Interfaces:
    """Its interfaces twist under uniform pressure."""
    return Interfaces(twisting=TwistingInterfaces.of(line.model, line.contacts))


@dataclass(frozen=True)
class Case:
    """One load case of a deck as the program solves it, blocks glued, ties among the contacts."""

    load_case: LoadCase
    parts: tuple[Program, ...]
    settings: SolverSettings

    @property
    def loaded(self) -> Program:
        """The one part that is loaded."""
        (program,) = (part for part in self.parts if np.any(part.live_load))
        return program

    def associative(self) -> AssociativeResult:
        """Of the loaded part."""
        return solve_associative(self.loaded, self.settings, lambda record: None, stress_free=False)

    def path(self, settings: PathSettings = DEFAULT, slope: float = 0.0) -> PathOfPart:
        """Of the loaded part; joints dilate by a share of their friction."""
        program = self.loaded
        return path_of_part(program, self.associative(), settings, slope * program.limits.friction)

    def load_factor(self, settings: PathSettings = DEFAULT, slope: float = 0.0) -> float:
        """Of the model."""
        return self.loaded.scaling.load_factor(self.path(settings, slope).load_factor)

    def reaction(self, settings: PathSettings = DEFAULT, slope: float = 0.0) -> float:
        """That a support that gives way has at least."""
        settlement = settlement_of(self.load_case)
        return settlement.reference - self.load_factor(settings, slope) * settlement.unit


def case_of(deck: Path | str, name: str, *overrides: str, live: FloatArray | None = None) -> Case:
    """A load case of a deck, on the disk or as text; with another live load where one is given, (n_blocks, 6)."""
    with TemporaryDirectory() as folder:
        path = deck if isinstance(deck, Path) else Path(folder) / "deck.yaml"
        if isinstance(deck, str):
            path.write_text(deck, encoding="utf-8")
        read = read_deck(path, ("analysis.flow_rule=non_associative", *overrides))
        model = build_model(read)
    assembly, settings = build_assembly(read, model), replace(solver_settings(read.analysis), tolerance=1e-8)
    (case,) = select_cases(model, [name])
    case = posed(assembly, case, settings) if live is None else replace(case, live_load=live)
    return Case(case, build_program(assembly, case, settings.analysis).reduced.parts, settings)
