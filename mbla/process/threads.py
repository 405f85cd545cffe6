"""Threads of the linear algebra libraries, which take every core for products that are too small for it.

On a busy machine of two cores waking them made one scalar product of 14,000 numbers last 6 ms, and a solver that does
little else four times slower. The libraries read these variables when they are loaded, so they are set before.

What can use several are products of dense matrices; qdldl, SuperLU, CHOLMOD (with the BLAS that its wheels bring),
HiGHS and clarabel are serial.
"""

from __future__ import annotations

import os

VARIABLES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def limit_threads(number: int) -> None:
    """At most so many threads, unless the user's own variables say otherwise; before numpy is imported."""
    for variable in VARIABLES:
        os.environ.setdefault(variable, str(number))
