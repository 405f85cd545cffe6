"""MKL Pardiso for the factorisations of very large cone programs, where the ``mkl`` package is installed.

The cone solver loads MKL at run time from a directory with a file ``libmkl_rt.so``; the package has that file under a
name with a version. A directory of links gives it what it looks for. MKL ends the process where a part of it is
missing, so it is tried in a process of its own first.

The layer of threads is one for the whole process. With a threaded one Pardiso returned nonsense to the cone solver on a
wall of 3,630 blocks: it gets MKL on one thread only. Definite matrices, and those that are factorised on their diagonal
(:mod:`mbla.solution.linear_algebra.pardiso_factors`), are right on several.

On that wall (21,780 unknowns) it took 24 s of processor time, the solver's own factorisation 31; on 1,012 blocks 3.4
and 2.5. So it is used for the largest programs alone.
"""

from __future__ import annotations

import atexit
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from mbla.process.threads import mkl_threads

UNKNOWNS = 20_000
"""Unknowns of a program from which MKL pays."""

SECONDS = 60
"""For the trial, which takes one."""

TRIAL = """
import clarabel, numpy as np, scipy.sparse as sp
settings = clarabel.DefaultSettings()
settings.verbose, settings.direct_solve_method = False, "mkl"
matrix = sp.csc_matrix(-np.eye(2))
cones = [clarabel.NonnegativeConeT(2)]
solver = clarabel.DefaultSolver(sp.csc_matrix((2, 2)), np.ones(2), matrix, -np.ones(2), cones, settings)
assert abs(solver.solve().obj_val - 2.0) < 1e-6
"""
"""min x + y s.t. x, y ≥ 1."""


def factorization_for(n_unknowns: int) -> str:
    """The cone solver's factorisation for a program of that size: qdldl or mkl."""
    return "mkl" if n_unknowns >= UNKNOWNS and mkl_threads() == 1 and mkl_works() else "qdldl"


@cache
def mkl_works() -> bool:
    """Whether the cone solver finds MKL and gets a right answer with it; the search is made once."""
    library = mkl_library()
    if library is None:
        return False
    surroundings = {"MKL_PARDISO_PATH": str(_directory_of_links(library)), "MKL_THREADING_LAYER": layer_of_threads()}
    command = [sys.executable, "-c", TRIAL]
    try:
        trial = subprocess.run(
            command, env=os.environ | surroundings, capture_output=True, timeout=SECONDS, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    if trial.returncode != 0:
        return False
    os.environ.update(surroundings)
    return True


def layer_of_threads() -> str:
    """How MKL calls the layer that it is to take."""
    return "SEQUENTIAL" if mkl_threads() == 1 else "INTEL"


def mkl_library() -> Path | None:
    """The runtime library of the installed ``mkl`` package, ``libmkl_rt.so`` with a version; None without it."""
    if sys.platform != "linux" or platform.machine() != "x86_64":
        return None
    try:
        files = distribution("mkl").files or []
    except PackageNotFoundError:
        return None
    found = (Path(str(file.locate())).resolve() for file in files if file.name.startswith("libmkl_rt.so"))
    return next((path for path in found if path.is_file()), None)


def _directory_of_links(library: Path) -> Path:
    """A directory with links to the parts of MKL, removed at exit; it loads them from beside its runtime library."""
    directory = Path(tempfile.mkdtemp(prefix="mbla-mkl-"))
    atexit.register(shutil.rmtree, directory, ignore_errors=True)
    for part in (*library.parent.glob("libmkl_*.so*"), *library.parent.glob("libiomp5.so*")):
        (directory / part.name).symlink_to(part)
    link = directory / "libmkl_rt.so"
    if not link.exists():
        link.symlink_to(library)
    return directory
