"""Which interfaces of a model have a law of their own in its steps."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.program.program import Program
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.law.crushing_interfaces import crushing_rows
from mbla.solution.law.interface_rows import InterfaceRows
from mbla.solution.law.torsion_interfaces import torsion_rows


@dataclass(frozen=True)
class Interfaces:
    """Interfaces of a model that crush as stress blocks, and that twist under uniform pressure; None where none do."""

    crushing: CrushingInterfaces | None = None
    twisting: TwistingInterfaces | None = None

    def rows_of(self, program: Program) -> tuple[InterfaceRows, ...]:
        """Their rows in a program of the model, reduced or not."""
        crushing = None if self.crushing is None else crushing_rows(program, self.crushing)
        twisting = None if self.twisting is None else torsion_rows(program, self.twisting)
        return tuple(rows for rows in (crushing, twisting) if rows is not None)


NONE = Interfaces()
"""Of a model whose contact points are all that has a law."""
