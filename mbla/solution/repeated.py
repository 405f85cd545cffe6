"""The answer of a part as that of another one with the same program (:mod:`mbla.program.reductions.repeated`)."""

from __future__ import annotations

from dataclasses import replace

from mbla.program.program import Program
from mbla.solution.beside import standing_on_model
from mbla.solution.part import PartResult


def answer_for(program: Program, found: PartResult) -> PartResult:
    """What was found for a part, for another one with the same program; programs and remarks are told once.

    Who falls first of parts that are the same is the first of them, so that its block stays named.
    """
    state = found.at_dead_load
    return replace(
        found,
        program=program,
        associative=replace(found.associative, programs=()),
        sequence=None if found.sequence is None else replace(found.sequence, programs=(), remarks=()),
        range=None if found.range is None else replace(found.range, programs=()),
        standing=found.standing if state is None else standing_on_model(program, state),
        remarks=(),
        more=(),
    )
