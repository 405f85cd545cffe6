"""Whole numbers, each of them; drawn, all equally likely."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.way import Filled, Form, Vector, Way, plain, register
from mbla.sweeps.file.content import WholeRange


def _levels(section: WholeRange, vector: Vector | None) -> Filled:
    return plain(range(section.start, section.end + 1))


def _at(section: WholeRange, u: FloatArray, vector: Vector | None) -> Filled:
    count = section.end - section.start + 1
    return plain((section.start + np.floor(u[:, 0] * count).astype(np.int64)).tolist())


register("whole", Way(_levels, _at, random=True, forms=lambda section: (Form("int"),)))
