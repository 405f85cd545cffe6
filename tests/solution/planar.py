"""A wall in the x-z plane as a planar program."""

from __future__ import annotations

from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from tests.line import Line


def planar_program(line: Line) -> Program:
    """Two force components a point, three unknowns a block."""
    (program,) = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False).parts
    assert program.components == 2
    return program
