"""MKL Pardiso: Cholesky, or LU, in an order by nested dissection. Called through its C interface, here alone.

The lower triangle by columns is the upper one by rows that Pardiso takes for symmetric matrices. Scaling and matching
are for indefinite ones and off; no refinement, which the caller makes. Not through the wrapper pypardiso: that copies
the matrix at every factorisation, counts its places from one in further copies, and compares it with the one it holds
at every solution.

One thread unless more are asked for, and the branch of MKL's code that does not depend on where an array lies in memory
nor, with the number of threads given to the analysis, on which of them comes first: reruns are identical to the bit. On
two threads a factorisation of 60,000 unknowns took 0.11 s in place of 0.20.
"""

from __future__ import annotations

import ctypes
import weakref
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mbla.arrays import FloatArray
from mbla.process.threads import mkl_threads
from mbla.solution.linear_algebra.mkl import layer_of_threads
from mbla.solution.linear_algebra.pattern import SymmetricPattern

ANALYSE, FACTORIZE, SOLVE, RELEASE = 11, 22, 33, -1  # phases
POSITIVE_DEFINITE, GENERAL = 2, 11  # types of matrix
LAYERS = {"INTEL": 0, "SEQUENTIAL": 1}  # of threads
REPRODUCIBLE = 2  # the best branch for the processor, whatever the alignment
OWN_SETTINGS, ORDER, SIDE, PERTURBATION, PERTURBED, THREADS, FROM_ZERO = 0, 1, 11, 9, 13, 33, 34
"""places in iparm, counted from 0"""
NESTED_DISSECTION = 2
TRANSPOSED = 2
LEAST_PIVOT = 13
"""Pivots below 10 to the minus this, relative to the matrix, are replaced and counted."""


class PardisoFactors:
    """Factors of matrices of one pattern; see ``Factorization``.

    runtime : MKL's runtime library
    """

    library = "pardiso"

    def __init__(self, pattern: SymmetricPattern, runtime: Path) -> None:
        self._n = pattern.n
        self._pardiso = Pardiso(runtime, pattern.n, pattern.pointers, pattern.indices, POSITIVE_DEFINITE)
        self._pardiso.analyse()

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite."""
        return self._pardiso.factorize(values)

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k)."""
        if len(rhs) != self._n:
            raise ValueError(f"a right-hand side of {len(rhs)} rows for a matrix of {self._n}")
        return self._pardiso.solve(rhs)


class Pardiso:
    """The C function with its memory for one pattern, which it gives back with this object.

    kind : POSITIVE_DEFINITE, the pattern the lower triangle by columns; or GENERAL, all of it by columns
    """

    def __init__(
        self, runtime: Path, n: int, pointers: NDArray[np.int32], indices: NDArray[np.int32], kind: int
    ) -> None:
        library = ctypes.CDLL(str(runtime))
        library.MKL_Set_Threading_Layer(LAYERS[layer_of_threads()])
        library.MKL_Set_Num_Threads(mkl_threads())
        library.MKL_CBWR_Set(REPRODUCIBLE)
        self._places = (np.array(pointers, dtype=np.int32), np.array(indices, dtype=np.int32))
        self._settings = settings = np.zeros(64, dtype=np.int32)
        settings[OWN_SETTINGS], settings[ORDER], settings[FROM_ZERO] = 1, NESTED_DISSECTION, 1
        settings[THREADS] = mkl_threads()
        if kind == GENERAL:  # it takes matrices by rows: ours is the transposed one to it
            settings[SIDE], settings[PERTURBATION] = TRANSPOSED, LEAST_PIVOT
        self._fixed = (library.pardiso, np.zeros(64, dtype=np.int64), settings, n, kind)
        self._values: FloatArray | None = None
        library.pardiso.restype = None
        weakref.finalize(self, _call, self._fixed, RELEASE, NOTHING, self._places, (NOTHING, NOTHING))

    def analyse(self) -> None:
        """Find the order; RuntimeError where that fails."""
        error = self.run(ANALYSE, np.ones(len(self._places[1])))
        if error:
            raise RuntimeError(f"the analysis by Pardiso failed with error {error}")

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the values are not finite or a pivot is not good enough."""
        held = np.array(values, dtype=np.float64)
        broken = not np.isfinite(held).all() or self.run(FACTORIZE, held) != 0 or self._settings[PERTURBED] > 0
        self._values = None if broken else held
        return not broken

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k), in a new array."""
        if self._values is None:
            raise ValueError("solve without a good factorisation")
        right = np.array(rhs, dtype=np.float64, order="F")
        answer = np.zeros_like(right)
        if not answer.size:
            return answer
        error = self.run(SOLVE, self._values, right, answer)
        if error:
            raise RuntimeError(f"the solution by Pardiso failed with error {error}")
        return answer

    def run(
        self, phase: int, values: FloatArray, right: FloatArray | None = None, answer: FloatArray | None = None
    ) -> int:
        """The error that Pardiso reports, 0 where there is none; right and answer by columns."""
        sides = (NOTHING if right is None else right, NOTHING if answer is None else answer)
        return _call(self._fixed, phase, values, self._places, sides)


NOTHING = np.zeros(1)


def _call(
    fixed: tuple[Any, NDArray[np.int64], NDArray[np.int32], int, int],
    phase: int,
    values: FloatArray,
    places: tuple[NDArray[np.int32], NDArray[np.int32]],
    sides: tuple[FloatArray, FloatArray],
) -> int:
    """``pardiso(pt, maxfct, mnum, mtype, phase, n, a, ia, ja, perm, nrhs, iparm, msglvl, b, x, error)``."""
    function, memory, settings, n, kind = fixed
    n_sides = sides[0].shape[1] if sides[0].ndim == 2 else 1
    error = ctypes.c_int32(0)
    function(
        *(_address(memory), _number(1), _number(1), _number(kind), _number(phase), _number(n)),
        *(_address(values), _address(places[0]), _address(places[1]), None, _number(n_sides)),
        *(_address(settings), _number(0), _address(sides[0]), _address(sides[1]), ctypes.byref(error)),
    )
    return error.value


def _number(value: int) -> Any:
    return ctypes.byref(ctypes.c_int32(value))


def _address(array: NDArray[Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)
