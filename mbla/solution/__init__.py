"""Solution: load factor, forces and mechanism of a program, and their verification."""

from mbla.solution.solution import Checks, ContactMode, Mechanics, Solution, Status
from mbla.solution.solve import solve
from mbla.solution.verification import verify
from mbla.solution.verify import verified_status

__all__ = ["Checks", "ContactMode", "Mechanics", "Solution", "Status", "solve", "verified_status", "verify"]
