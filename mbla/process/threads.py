"""Threads of the linear algebra libraries, which take every core for products that are too small for it.

On a busy machine of two cores waking them made one scalar product of 14,000 numbers last 6 ms, and a solver that does
little else four times slower. The libraries read these variables when they are loaded, so they are set before.

What can use several is the factorisation by MKL Pardiso, and products of dense matrices; qdldl, SuperLU, CHOLMOD (with
the BLAS that its wheels bring), HiGHS and clarabel are serial.
"""

from __future__ import annotations

import contextlib
import os

MKL = "MKL_NUM_THREADS"
VARIABLES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", MKL)


def limit_threads(number: int) -> None:
    """At most so many threads, unless the user's own variables say otherwise; before numpy is imported."""
    for variable in VARIABLES:
        os.environ.setdefault(variable, str(number))


def mkl_threads() -> int:
    """Threads that MKL is given; one unless more are asked for."""
    with contextlib.suppress(ValueError):
        return max(int(os.environ.get(MKL, "1")), 1)
    return 1
