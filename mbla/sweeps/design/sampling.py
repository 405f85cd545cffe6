"""Quantiles of drawn points: at random, by Latin hypercubes, or by a scrambled Sobol sequence.

The numbers depend on the seed and on the names of the columns alone, not on the order in which a file has them; at
random and in Latin hypercubes those of one column do not change with the other columns either.

M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21, 1979, doi:10.1080/00401706.1979.10489755;
A. B. Owen, Scrambling Sobol' and Niederreiter-Xing points, J. Complexity 14, 1998, doi:10.1006/jcom.1998.0487.
"""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Sequence
from typing import Any

import numpy as np

from mbla.arrays import FloatArray

LEAST = 2.0**-53
"""nearest to 0 and to 1 that a quantile comes: at 0 and 1 themselves a normal distribution has no value"""
SOBOL_BITS = 50
"""of each coordinate: the usual 30 would show as steps in fine quantiles"""


def quantiles(kind: str, points: int, seed: int, names: Sequence[str]) -> FloatArray:
    """Quantiles (points, len(names)) in the open interval (0, 1), one column for each name.

    kind : ``random``, ``latin_hypercube`` or ``sobol``
    """
    if kind == "sobol":
        drawn = _sobol(points, seed, names)
    elif kind == "latin_hypercube":
        drawn = np.column_stack([_latin_hypercube(points, _generator(seed, [name])) for name in names])
    else:
        drawn = np.column_stack([_generator(seed, [name]).random(points) for name in names])
    quantile: FloatArray = np.clip(drawn, LEAST, 1.0 - LEAST)
    return quantile


def _generator(seed: int, names: Sequence[str]) -> np.random.Generator:
    """Random numbers of their own for each seed and set of names."""
    digest = hashlib.sha256("\n".join(names).encode()).digest()
    words = np.frombuffer(digest, dtype="<u4").tolist()
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, *words])))


def _latin_hypercube(points: int, generator: np.random.Generator) -> FloatArray:
    """One coordinate: the columns of a Latin hypercube are drawn independently of each other."""
    from scipy.stats import qmc  # takes half a second to import, and is for drawn values only

    drawn: FloatArray = qmc.LatinHypercube(1, **_by(generator)).random(points)
    return drawn[:, 0]


def _sobol(points: int, seed: int, names: Sequence[str]) -> FloatArray:
    """The first points of a scrambled sequence, each moved to the middle of the cell that its bits name."""
    from scipy.stats import qmc

    order = sorted(range(len(names)), key=lambda i: names[i])
    sequence = qmc.Sobol(len(names), bits=SOBOL_BITS, **_by(_generator(seed, sorted(names))))
    exponent = max(0, (points - 1).bit_length())
    drawn = np.empty((points, len(names)))
    drawn[:, order] = sequence.random_base2(exponent)[:points] + 0.5 ** (SOBOL_BITS + 1)
    return drawn


def _by(generator: np.random.Generator) -> dict[str, Any]:
    """The argument that takes the generator: ``rng`` since scipy 1.15, ``seed`` before."""
    from scipy.stats import qmc

    name = "rng" if "rng" in inspect.signature(qmc.Sobol.__init__).parameters else "seed"
    return {name: generator}
