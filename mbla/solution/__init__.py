"""Solution: load factor, forces and mechanism of a program, and their verification.

``solve`` goes through the parts of a structure, ``part`` and ``flow`` through flow rule and scheme of one part,
``beside`` through what is asked for besides: standing, range, peak. The schemes (``proximal``,
``interior``, ``load_path``, ``lowest``, ``published``) work on states of the law of the joints (``law_state``,
``exact_law``). ``convex`` does the same with interface resultants.

``verify`` and the files that begin with its name recompute everything from model, contacts and solution, without a
solver. ``cone_solver`` is the door to those who solve cone programs: the interior-point method of this package
(``condensed``, whose matrices ``linear_algebra`` factorises by the library that is there), and clarabel and HiGHS, each
behind its adapter. Records of programs say who solved them.
"""
