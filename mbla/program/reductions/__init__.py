"""Reductions: planar, mirrored and separate parts found by themselves, with the exact way back to the full model."""

from mbla.program.reductions.reduce import Reduced, reduce_program
from mbla.program.reductions.steps import ModelSize, ProgramSize, ReductionOutcome, ReductionStep, allowed_reductions

__all__ = [
    "ModelSize",
    "ProgramSize",
    "Reduced",
    "ReductionOutcome",
    "ReductionStep",
    "allowed_reductions",
    "reduce_program",
]
