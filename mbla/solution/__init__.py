"""Solution: load factor, forces and mechanism of a program, and their verification.

``solve`` goes through the parts of a structure, ``part`` and ``flow`` through flow rule and scheme of one part,
``beside`` through what is asked for besides: standing, range, peak, least forces. The schemes (``proximal``,
``interior``, ``load_path``, ``lowest``, ``published``) work on states of the law of the joints (``law_state``,
``exact_law``). ``convex`` does the same with interface resultants.

``verify`` and the files that begin with its name recompute everything from model, contacts and solution, without a
solver. ``cone_solver`` is the door to those who solve cone programs: the interior-point method of this package
(``condensed``, whose matrices ``linear_algebra`` factorises by the library that is there), and clarabel and HiGHS, each
behind its adapter. Records of programs say who solved them.
"""

from mbla.solution.solution import Checks, ContactMode, Mechanics, Solution, Status
from mbla.solution.solve import solve, solve_parts
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status

__all__ = [
    "Checks",
    "ContactMode",
    "Mechanics",
    "Solution",
    "Status",
    "solve",
    "solve_parts",
    "verified_status",
    "verify",
]
