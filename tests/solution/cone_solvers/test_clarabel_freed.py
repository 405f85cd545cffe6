"""The solver is gone with the program that holds it: a sweep solves tens of thousands in one process."""

from __future__ import annotations

import gc
import weakref

import numpy as np
import scipy.sparse as sp

from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status


def test_a_program_that_was_solved_is_freed() -> None:
    matrix = sp.csc_array(np.array([[1.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]))
    cone_program = ConeProgram(np.array([1.0, 2.0]), matrix, np.array([1.0, 0.0, 0.0]), n_half_lines=2, n_cones=0)
    program = ClarabelProgram(cone_program, SolverSettings(tolerance=1e-8), lambda record: None)
    assert program.solve(1, 1.0).status is Status.SOLVED
    freed = weakref.ref(program)
    del program
    gc.collect()
    assert freed() is None
