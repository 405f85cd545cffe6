"""Solution: load factor, forces and mechanism of a program, and their verification.

``solve`` solves the ``parts`` of a structure one by one; ``parts.part`` alone decides, by one record of ``settings``,
with which flow rule and scheme a part is solved. ``associative`` proves a load factor from both sides, conditions on
interfaces included; ``law`` has the step of elastic joints, ``flow`` their path, ``standing`` the state of the
stress-free assembly; ``nonassociative`` has one file a scheme. ``full_model`` leads back to blocks and contact points.

``sequence`` answers load cases that take several analyses: tilting tables, settling supports, the range of a force.
``further`` and ``pushover`` answer the questions besides the load factor, without any effect on it.

``verification`` recomputes everything from model, contacts and solution, without a solver. ``cone_solvers`` is the
door to the solvers of cone programs, the interior-point method of this package and clarabel, each behind its adapter;
``linear_algebra`` factorises with the library that is installed. The record of a program names its solver.
"""
