"""Ways of saying the values of a parameter, one per file; a new one is a file and a line here."""

from mbla.sweeps.design.ways import horizon, linear, log, lognormal, normal, sphere, triangular, uniform, values, whole
from mbla.sweeps.design.ways.way import WAYS

__all__ = [
    "WAYS",
    "horizon",
    "linear",
    "log",
    "lognormal",
    "normal",
    "sphere",
    "triangular",
    "uniform",
    "values",
    "whole",
]
