"""Uniform distribution."""

from __future__ import annotations

from mbla.sweeps.design.ways.linear import at_share
from mbla.sweeps.design.ways.way import Way, no_levels, register

register("uniform", Way(no_levels, at_share, random=True))
