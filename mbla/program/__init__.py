"""Program: the load factor as the optimum of a cone program, in non-dimensional form, with the way back.

``assemble`` makes a ``Program`` of model, contacts and load case; ``reductions`` leaves out what need not be solved.
``kinematic`` and ``static`` write it as cone programs in velocities and in forces, ``yield_conditions``
what a joint bears; ``resultants`` has the conditions on the resultants of interfaces.
"""

from mbla.program.assemble import assemble
from mbla.program.program import Program, Scaling

__all__ = ["Program", "Scaling", "assemble"]
