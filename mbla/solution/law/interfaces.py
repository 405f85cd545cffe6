"""Which interfaces of a model have a law of their own in its steps."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.program.program import Program
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.solution.law.crushing_interfaces import crushing_rows
from mbla.solution.law.interface_rows import InterfaceRows


@dataclass(frozen=True)
class Interfaces:
    """Interfaces of a model that crush as stress blocks; None where none do."""

    crushing: CrushingInterfaces | None = None

    def rows_of(self, program: Program) -> tuple[InterfaceRows, ...]:
        """Their rows in a program of the model, reduced or not."""
        found = () if self.crushing is None else (crushing_rows(program, self.crushing),)
        return tuple(rows for rows in found if rows is not None)


NONE = Interfaces()
"""Of a model whose contact points are all that has a law."""
