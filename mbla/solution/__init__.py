"""Solution: load factor, forces and mechanism of a program, and their verification.

``solve`` goes through the parts of a structure; ``part`` alone decides by which flow rule and scheme each is solved and
what is found in addition to its load factor, by one record of ``settings``. ``associative`` proves a factor from both
sides, conditions on interfaces included; ``law`` has the step of elastic joints, ``flow`` their path, ``standing`` the
state of the stress-free assembly; ``nonassociative`` has one file a scheme.

``sequence`` answers load cases that take several analyses: tilting tables, settling supports, the range of a
force. ``further`` and ``pushover`` find what is asked besides the load factor, and change nothing of it.

``verification`` recomputes everything from model, contacts and solution, without a solver. ``cone_solvers`` is the door
to those who solve cone programs: the interior-point method of this package, and clarabel, each behind its
adapter; ``linear_algebra`` factorises by the library that is there. Records of programs say who solved them.
"""
