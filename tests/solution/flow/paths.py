"""Paths of elastic joints of small decks, for tests."""

from __future__ import annotations

import numpy as np

from mbla.program.program import Program
from mbla.program.reductions import allowed_reductions, reduce_program
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.stiffness_shares import shares_of
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.path_of_part import PathOfPart, path_of_part
from mbla.solution.flow.settings import PathSettings
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.settings import SolverSettings
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
