"""Program: the load factor as the optimum of a cone program, in non-dimensional form, with the way back."""

from mbla.program.assemble import assemble
from mbla.program.program import Program, Scaling

__all__ = ["Program", "Scaling", "assemble"]
